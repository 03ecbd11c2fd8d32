"""The scripts that are run by hand find what they measure, and the stored results of the benchmark are right."""

import importlib
from pathlib import Path

import numpy as np
import pytest
from pytest import approx

from manual import bench
from support.thorough import sample


@pytest.mark.parametrize(("name", "rows"), [("A", slice(20)), ("B", slice(77, 78)), ("D", slice(3))])
def test_stored_results_are_those_of_decimals(name, rows):
    work = bench.works()[name]
    found = bench.exact(work, 42, rows).astype(float)
    assert np.all(work.exact[rows] == approx(found, rel=0.0, abs=1e-16))


@pytest.mark.parametrize(
    ("method", "name"), sample([(method, name) for method in bench.installed().values() for name in bench.works()], 3)
)
def test_every_method_does_every_work(method, name):
    work = bench.works()[name]
    for ladder in map(list, method(work)):
        # About 1e-7.
        setting, run = ladder[len(ladder) // 2]
        assert work.error(run()) < 1e-2, setting


@pytest.mark.parametrize("name", sorted(one.stem for one in Path(bench.__file__).parent.glob("*.py")))
def test_each_script_finds_what_it_measures(name):
    """They run by hand only, so that a name that has moved would not be noticed."""
    importlib.import_module(f"manual.{name}")
