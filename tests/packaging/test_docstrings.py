"""The examples in docstrings run and give the stated results; every function exported by a package has one."""

import doctest
import inspect

import pytest

import hess_explorer
import hess_explorer.sweep
import hess_mechanics
from hess_explorer.export import columns

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE | doctest.IGNORE_EXCEPTION_DETAIL
PACKAGES = {package.__name__: package for package in (hess_mechanics, hess_explorer, hess_explorer.sweep)}
NAMES = [(package, name) for package in PACKAGES.values() for name in package.__all__]
FUNCTIONS = [(package.__name__, name) for package, name in NAMES if inspect.isfunction(getattr(package, name))]
BODIES = [name for name in hess_mechanics.__all__ if name.endswith("Body")]


def ran(thing, name):
    """Run a module's examples and return their number; all must pass."""
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    tests = doctest.DocTestFinder().find(thing, name, globs={})
    said = []
    for test in tests:
        runner.run(test, out=said.append)
    assert not said, "".join(said)
    return sum(len(test.examples) for test in tests)


@pytest.mark.parametrize(("package", "name"), FUNCTIONS)
def test_every_function_has_an_example_that_is_right(package, name):
    assert ran(getattr(PACKAGES[package], name), name) > 1


@pytest.mark.parametrize("name", BODIES)
def test_every_body_has_an_example_that_is_right(name):
    assert ran(getattr(hess_mechanics, name), name) > 1


def test_packages_states_and_tables_have_examples_that_are_right():
    for thing, name in (
        (hess_mechanics, "hess_mechanics"),
        (hess_explorer, "hess_explorer"),
        (hess_explorer.SceneState, "SceneState"),
        (columns.Table, "Table"),
    ):
        assert ran(thing, name) > 1
