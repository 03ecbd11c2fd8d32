"""Every accuracy argument accepts a level or its name."""

import importlib
import inspect
import pkgutil

import hess_mechanics as hm
from hess_mechanics.numerics.accuracy import DRAFT, Kind, Level, plan
from hess_mechanics.numerics.arguments import as_level

SUSLOV = hm.systems()["suslov"]
STATE, PARAMETERS = SUSLOV.example


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


INTERNAL = {"integrated", "longest_step", "measured", "no_chaos", "computation_of", "tangent"}
"""Functions that take a level that is already read, or its name in a store."""


def test_every_public_function_says_that_it_takes_either():
    """The type checker verifies that each function resolves it before it reads order or tolerance."""
    found = {name: taken(one) for name, one in public() if taken(one)}
    assert len(found) > 60
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
