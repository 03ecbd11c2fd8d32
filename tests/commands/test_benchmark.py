"""The scripts that are run by hand: they find what they measure, and the stored results of the benchmark are right."""

import importlib
from pathlib import Path

import numpy as np
import pytest
from pytest import approx

from manual import bench
from manual import make_benchmark_references as maker
from manual.integrators.works import works
from support import thorough


def test_a_stored_ensemble_is_what_its_maker_makes():
    work, some = works()["B2"], [77]
    found = maker.ends(work.initial[some], maker.RUNS[0])
    assert found.astype(float) == approx(work.reference[some], abs=1e-30)


def test_the_stored_long_orbit_begins_as_its_maker_makes_it():
    work = works()["A"]
    states, crossings = maker.long_orbit(work.initial[0], work.times[work.rows[:20]], maker.LONG_RUNS[0])
    assert np.array_equal(states.astype(float), work.reference[:20])
    assert len(crossings) > 0
    assert np.array_equal(crossings.astype(float), works()["D"].reference[: len(crossings)])


def test_a_peer_that_is_not_installed_is_named(monkeypatch, capsys):
    monkeypatch.setitem(bench.PEERS, "no-such-peer", "no_such_peer")
    assert bench.participants()
    assert "no-such-peer is left out" in capsys.readouterr().err


@pytest.mark.parametrize(
    "method, name",
    thorough.sample([(method, name) for method in bench.participants() for name in works()], 3),
    ids=lambda one: getattr(one, "name", one),
)
def test_every_method_does_every_work_it_says_it_does(method, name):
    work = works()[name]
    for ladder in method.ladders(work):
        # About 1e-7.
        setting = ladder[len(ladder) // 2]
        assert work.error(method.prepare(work, setting)()) < 1e-2, setting


@pytest.mark.thorough
def test_the_table_says_what_each_method_takes(capsys):
    bench.main(["--works", "A", "--targets", "1e-3"])
    text = capsys.readouterr().out
    assert "| A | 1e-3 | " in text


@pytest.mark.parametrize("name", sorted(one.stem for one in Path(bench.__file__).parent.glob("*.py")))
def test_each_script_finds_what_it_measures(name):
    """They run by hand only, so that a name that has moved would not be noticed."""
    importlib.import_module(f"manual.{name}")
