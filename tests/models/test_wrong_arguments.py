"""Arguments of a wrong kind or size are refused with a sentence, and every result prints on ten lines.

The calls are those of the examples in the docstrings, with one argument replaced at a time.
"""

import doctest
import inspect
import math
import pickle
from contextlib import redirect_stdout, suppress
from dataclasses import is_dataclass
from functools import cache
from io import StringIO

import numpy as np
from pytest import mark, raises

import hess_mechanics as hm
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import DRAFT, Kind, Level, plan
from hess_mechanics.numerics.labelled import Result, ShortRepr

WRONG = (0, -1, 5e-324, 1e300, 10**400, math.nan, math.inf, "x", "", None, True, 1j, [], [[1.0]], {}, object())
CHEAP = {"accuracy": "draft", "level": "draft", "most_work": 1e5}
FUNCTIONS = [name for name in hm.__all__ if inspect.isfunction(getattr(hm, name))]


class Recorded(Exception):
    """Raised instead of computing."""


@cache
def example(name):
    """The arguments with which the example of a function, or of a class, calls it; None if there is no such call."""
    real, calls = getattr(hm, name), []

    def record(*args, **named):
        calls.append(inspect.signature(real).bind(*args, **named))
        raise Recorded

    names = {}
    vars(hm)[name] = record
    try:
        with suppress(Recorded, AttributeError), redirect_stdout(StringIO()):
            for one in doctest.DocTestParser().get_examples(real.__doc__ or ""):
                exec(compile(one.source, name, "single"), names)
    finally:
        vars(hm)[name] = real
    return calls[0] if calls else None


def replaced(name):
    """Yield the calls of an example with one argument replaced, or its first part, or its length."""
    given = example(name)
    cheap = {key: value for key, value in CHEAP.items() if key in given.signature.parameters}
    for key, good in given.arguments.items():
        parts = list(good) if isinstance(good, (list, tuple)) else []
        firsts = [[one, *parts[1:]] for one in WRONG] if parts else []
        lengths = [[*parts, *parts], parts[1:]] if parts else []
        for value in (*WRONG, *firsts, *lengths):
            call = inspect.BoundArguments(given.signature, {**given.arguments, **cheap, key: value})
            yield f"{key} = {str(value)[:60] if value != WRONG[4] else '10**400'}", call


CLASSES = [name for name in hm.__all__ if inspect.isclass(getattr(hm, name)) and example(name) is not None]


@mark.parametrize("name", [*FUNCTIONS, *CLASSES])
def test_a_wrong_argument_is_refused_with_a_sentence(name):
    wrong = []
    for words, call in replaced(name):
        try:
            getattr(hm, name)(*call.args, **call.kwargs)
        except ModelError as error:
            if str(error)[-1:] not in (".", "…"):
                wrong.append(f"{words}: {error}")
        except Exception as error:
            wrong.append(f"{words}: {error!r}")
    assert not wrong


def test_a_missing_argument_is_named():
    body, state = hm.systems()["suslov"].example_motion
    with raises(InvalidParameter, match="missing a required argument: 'duration'"):
        hm.section(body, state, hm.Plane((0, 0, 0, 0, 1)))
    assert str(hm.ensemble(body, [state], [1.0]).status) == "ok"


def test_numbers_of_every_kind_are_numbers():
    """As are those of NumPy; a number that a float cannot hold is one for exact arithmetic."""
    of_floats = hm.circle_map(0.5, 2.0, 0.5, "draft").trace
    assert hm.circle_map(np.float32(0.5), 2, np.array(0.5), "draft").trace == of_floats
    assert str(hm.prove(0, 10**6 + 1, "1/3").h).startswith("1000001")


def test_functions_of_the_package_can_be_sent_to_another_process():
    assert all(pickle.loads(pickle.dumps(getattr(hm, name))) is getattr(hm, name) for name in FUNCTIONS)


@mark.parametrize("name", FUNCTIONS)
def test_a_result_prints_on_ten_lines(name):
    call = example(name)
    result = getattr(hm, name)(*call.args, **call.kwargs)
    # Arrays, dictionaries and numbers print as they always do.
    if isinstance(result, (Result, ShortRepr)):
        lines = str(result).splitlines()
        assert 1 <= len(lines) <= 10
        assert max(map(len, lines)) <= 120
        assert lines[0].startswith(f"{type(result).__name__}:")
    else:
        assert not is_dataclass(result) or len(str(result)) < 1000


def test_a_level_of_ones_own_is_used_as_it_is():
    own = Level("own", 1e-5, 1e-7, 14)
    assert plan(Kind.BASINS, own).level is own
    assert plan(Kind.BASINS, DRAFT) is plan(Kind.BASINS, "draft")
    assert hm.solve(*hm.systems()["suslov"].example_motion, [2.0], own).level == "own"
