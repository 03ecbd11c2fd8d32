"""Functions of the user: the same stores, workers and statuses as computations of the catalogue."""

import functools
import math
import threading
from typing import NamedTuple

import numpy as np
import pytest

from hess_explorer.sweep import OtherSweep, Outcome, explain, sweep
from hess_mechanics import circle_map
from hess_mechanics.errors import InvalidParameter, NoField
from support.refusals import refused

OVER = {"x": (-1.0, 1.0, 7), "y": [0.5, 2.0, 3.0]}


class Both(NamedTuple):
    product: float
    ratio: float


def both(x, y, scale=2.0):
    """Product and ratio.

    More words.
    """
    return Both(scale * x * y, x / y)


def product_of(x, y):
    return x * y


def test_fields_become_variables_and_a_number_one_of_the_name_of_the_function():
    found = sweep(both, OVER)
    x, y = np.linspace(-1.0, 1.0, 7), np.array([0.5, 2.0, 3.0])
    assert list(found.data_vars) == ["product", "ratio", "status"]
    assert np.array_equal(found["product"], 2.0 * x[:, None] * y)
    assert np.array_equal(found["ratio"], x[:, None] / y)
    assert (found["ratio"].dims, found.attrs["parameters"]) == (("x", "y"), '{"scale": 2.0}')
    assert found["ratio"].attrs["long_name"] == "Product and ratio."
    single = sweep(product_of, OVER)
    assert list(single.data_vars) == ["product_of", "status"]
    assert np.array_equal(single.product_of, x[:, None] * y)


def test_a_function_may_take_any_names_other_values_and_the_level():
    def rotation(h, accuracy, **others):
        return circle_map(h=h, accuracy=accuracy, **others).rotation_number

    tori = {"over": {"h": (1.2, 1.6, 3)}, "a": 0.5, "f": 0.3}
    assert np.allclose(sweep(rotation, **tori).rotation, sweep("circle-map", **tori).rotation_number)

    def chosen(x, name="sin"):
        return getattr(math, name)(x)

    assert sweep(functools.partial(chosen, name="cos"), {"x": [0.5]}).chosen.item() == math.cos(0.5)


def test_a_cell_without_a_number_has_a_status():
    errors = {0.0: ZeroDivisionError(), 1.0: NoField("No field at x = 1."), 2.0: KeyError("a mistake")}

    def partial(x):
        if x in errors:
            raise errors[x]
        return {3.0: math.nan, 4.0: math.inf}.get(x, 1.0 / x)

    found = sweep(partial, {"x": (0.0, 5.0, 6)})
    words = ["BEYOND_RANGE", "NO_FIELD", "FAILED", "NO_VALUE", "BEYOND_RANGE", "OK"]
    assert [Outcome(code).name for code in found.status.values] == words
    assert found.partial.values[-1] == 0.2
    with pytest.raises(InvalidParameter, match="your own function: call it"):
        explain(found, x=1.0)


def test_the_store_of_another_function_is_refused(tmp_path):
    def own(x):
        return x

    sweep(own, {"x": [1.0, 2.0]}, store=tmp_path / "own.zarr")

    def own(x):
        return 2.0 * x

    with pytest.raises(OtherSweep, match=r"has source = def own.*not def own"):
        sweep(own, {"x": [1.0, 2.0]}, store=tmp_path / "own.zarr")


LOCK = threading.Lock()


def locked(x, lock=LOCK):
    return x


test_what_is_wrong_is_one_sentence = refused(
    (lambda: sweep(math.hypot, {"x": [1.0]}), "takes no keyword arguments.*it must accept its parameters by name"),
    (lambda: sweep(product_of, {"x": [1.0]}), "missing 1 required positional argument: 'y'"),
    (lambda: sweep(lambda x: (x, x), {"x": [1.0]}), "not 'tuple'.*return a number or a named tuple of numbers"),
    (lambda: sweep(lambda x: {}[x], {"x": [1.0, 2.0]}), r"failed at all cells .*first: KeyError: 1\.0\)"),
    (lambda: sweep(functools.partial(locked, lock=LOCK), {"x": [1.0]}, workers=2), "cannot be sent to other processes"),
)


def test_a_number_may_have_the_name_of_another_variable_and_numbers_are_chosen_by_name():
    class Taken(NamedTuple):
        status: float
        x: float

    def both(x):
        return Taken(x, 2.0 * x)

    found = sweep(both, {"x": [1.0, 3.0]})
    assert (found.status_value.values.tolist(), found.x_value.values.tolist()) == ([1.0, 3.0], [2.0, 6.0])
    assert list(sweep(both, {"x": [1.0]}, numbers=["x"]).data_vars) == ["x_value", "status"]
