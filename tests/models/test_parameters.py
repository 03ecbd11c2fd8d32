"""The table of parameters: each description is consistent, and a value outside its bounds is refused."""

import re
from math import inf, nan, nextafter

import pytest

from hess_mechanics import parameters
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.parameters import Parameter

TABLE = {name: value for name, value in vars(parameters).items() if isinstance(value, Parameter)}
each = pytest.mark.parametrize("known", TABLE.values(), ids=TABLE)


@each
def test_a_slider_spans_allowed_values_and_holds_the_default(known):
    assert known.bounds[0] <= known.softbounds[0] <= known.default <= known.softbounds[1] <= known.bounds[1]
    assert 0 < known.step < known.softbounds[1] - known.softbounds[0]


@each
def test_both_bounds_are_allowed_and_nothing_beyond_them(known):
    low, high = known.bounds
    assert [known.check(low), known.check(high)] == [low, high]
    for wrong in (nextafter(low, -inf), nextafter(high, inf), inf, -inf, nan):
        with pytest.raises(InvalidParameter) as refused:
            known.check(wrong)
        said = re.search(r"between (\S+) and (\S+):", str(refused.value))
        assert [*map(float, said.groups())] == pytest.approx([low, high], rel=1e-5)


def test_a_whole_number_is_required_where_only_such_ones_mean_something():
    assert parameters.SHEET.check(1.0) == 1.0
    with pytest.raises(InvalidParameter, match="is not a whole number between 0 and 2"):
        parameters.SHEET.check(0.5)
