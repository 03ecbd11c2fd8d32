"""The examples in docstrings run and give the stated results; every function exported by a package has one."""

import doctest
import inspect

import pytest

import hess_explorer
import hess_explorer.sweep
import hess_mechanics
from hess_explorer.export import columns

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE | doctest.IGNORE_EXCEPTION_DETAIL
EXPORTED = [
    getattr(package, name)
    for package in (hess_mechanics, hess_explorer, hess_explorer.sweep)
    for name in package.__all__
    if name.endswith("Body") or inspect.isfunction(getattr(package, name))
]


def ran(thing, name):
    """Run a module's examples and return their number; all must pass."""
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    tests = doctest.DocTestFinder().find(thing, name, globs={})
    said = []
    for test in tests:
        runner.run(test, out=said.append)
    assert not said, "".join(said)
    return sum(len(test.examples) for test in tests)


@pytest.mark.parametrize(
    "thing",
    [*EXPORTED, hess_mechanics, hess_explorer, hess_explorer.SceneState, columns.Table],
    ids=lambda one: one.__name__,
)
def test_every_function_and_body_has_an_example_that_is_right(thing):
    assert ran(thing, thing.__name__) > 1
