"""Composition over inheritance: the number of the project's own base classes of a class."""

import importlib
import inspect
import pkgutil

import pytest

import hess_explorer
import hess_mechanics

OWN = (hess_mechanics, hess_explorer)


def modules(package):
    """Every module of a package but the program itself, which runs when it is imported."""
    return [
        importlib.import_module(one.name)
        for one in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
        if not one.name.endswith("__main__")
    ]


def own_bases(cls):
    """The own bases of a class, however distant, but protocols, which only name what a class has.

    A scene with a section stands on three: `State`, `SectionState` and `FilledState`, whose fields are its parameters.
    """
    mine = [one for one in cls.__mro__[1:] if one.__module__.partition(".")[0] in {part.__name__ for part in OWN}]
    return [one.__name__ for one in mine if not one.__dict__.get("_is_protocol")]


@pytest.mark.parametrize("package", OWN, ids=lambda one: one.__name__)
def test_no_class_stands_on_more_than_three_own_classes(package):
    classes = [
        cls
        for module in modules(package)
        for _, cls in inspect.getmembers(module, inspect.isclass)
        if cls.__module__ == module.__name__
    ]
    assert len(classes) > 100
    assert {cls.__qualname__: own_bases(cls) for cls in classes if len(own_bases(cls)) > 3} == {}
