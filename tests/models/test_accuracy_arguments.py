"""Every accuracy argument accepts a level or its name."""

import importlib
import inspect
import pkgutil

import numpy as np
import pytest

import hess_mechanics as hm
from hess_mechanics import level
from hess_mechanics.dynamics.section import Plane
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import DRAFT, Kind, Level, plan
from hess_mechanics.numerics.arguments import as_level

SUSLOV = hm.systems()["suslov"]
STATE, PARAMETERS = SUSLOV.example
BODY = hm.SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0)
FREE_BALL = hm.BallBody(2.0, 1.0, 0.5, 0.7, 0.0)
EQUATOR = Plane((0.0, 0.0, 0.0, 0.0, 1.0))

# Some functions of the package that take an accuracy, called with the least work.
CALLS = {
    "cloud": lambda one: hm.cloud(FREE_BALL, 2.0, 1.0, count=3, accuracy=one).omega,
    "rotation_numbers": lambda one: hm.rotation_numbers(0.5, 0.2, 0.6, one).rho,
    "return_map": lambda one: hm.return_map(BODY, E=1.842, accuracy=one).image((0.3, 1.2)),
    "solve": lambda one: hm.solve(SUSLOV.at(PARAMETERS), STATE, [2.0], one).states,
    "ensemble": lambda one: hm.ensemble(SUSLOV.at(PARAMETERS), [STATE, STATE], [2.0], one).states,
    "section": lambda one: hm.section(SUSLOV.at(PARAMETERS), STATE, EQUATOR, 20.0, one).states,
    "lyapunov_spectrum": lambda one: hm.lyapunov_spectrum(SUSLOV.at(PARAMETERS), STATE, 50.0, one).values,
    "circle_map": lambda one: hm.circle_map(0.5, 1.5, 0.6, one).trace,
    "lock_boundary": lambda one: hm.lock_boundary(0.5, one, 4),
}


def taken(function):
    """Return the accuracy parameters of a function, by their annotations."""
    kinds = {name: str(one.annotation) for name, one in inspect.signature(function).parameters.items()}
    return {
        name: kind
        for name, kind in kinds.items()
        if kind in ("Level", "Accuracy") or (name in ("level", "accuracy") and "str" in kind)
    }


def public():
    """All public functions, and methods of public classes, of both packages, by their full names."""
    for package in (hm, importlib.import_module("hess_explorer.sweep")):
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            module = importlib.import_module(found.name)
            own = (getattr(module, name) for name in getattr(module, "__all__", ()))
            for one in own:
                if getattr(one, "__module__", None) == module.__name__:
                    for member in vars(one).values() if inspect.isclass(one) else [one]:
                        if inspect.isfunction(member) and not member.__name__.startswith("_"):
                            yield f"{module.__name__}.{member.__qualname__}", member


@pytest.mark.parametrize("name", CALLS)
def test_a_level_and_its_name_mean_the_same_and_a_name_that_no_level_has_is_refused(name):
    by_name, by_level = (np.asarray(CALLS[name](one)) for one in ("draft", level("draft")))
    assert by_name.size
    assert np.array_equal(by_name, by_level, equal_nan=True)
    with pytest.raises(InvalidParameter, match="choose one of draft, standard, precise, reference"):
        CALLS[name]("exact")


INTERNAL = {
    "cost_of_a_cell", "create", "empty", "evaluate", "integrated", "longest_step", "measured", "no_chaos", "opened",
    "quantity_of", "require",
}  # fmt: skip
"""Functions that take a level that is already read, or its name in a store."""


def test_every_public_function_says_that_it_takes_either():
    """The type checker verifies that each function resolves it before it reads order or tolerance."""
    found = {name: taken(one) for name, one in public() if taken(one)}
    assert len(found) > 80
    wrong = {
        name: kinds
        for name, kinds in found.items()
        if name.rpartition(".")[2] not in INTERNAL and set(kinds.values()) != {"Accuracy"}
    }
    assert not wrong


def test_a_level_of_ones_own_is_used_as_it_is():
    own = Level("own", 1e-5, 1e-7, 14)
    assert as_level(own) is own
    assert plan(Kind.BASINS, own).level is own
    assert plan(Kind.BASINS, DRAFT) is plan(Kind.BASINS, "draft")
    assert hm.solve(SUSLOV.at(PARAMETERS), STATE, [2.0], own).level == "own"
