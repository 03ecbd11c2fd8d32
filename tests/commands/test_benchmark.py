"""The benchmark: its references, its choice of settings, its formats and its command.  Times are not asserted."""

import importlib
import json
import re
from pathlib import Path

import numpy as np
import pytest
from pytest import approx

from hess_mechanics import level, solve, systems
from manual import bench as bench_command
from manual import make_benchmark_references as maker
from manual.integrators import run as benchmark
from manual.integrators.explorer import METHOD as EXPLORER
from manual.integrators.method import OURS
from manual.integrators.peers import PEERS
from manual.integrators.works import works
from support import thorough
from support.command_line import typed

# References


def test_a_stored_ensemble_is_what_its_maker_makes():
    work, some = works()["B2"], [77]
    found = maker.ends(maker.FIELD_BODY, work.initial[some], maker.RUNS[0])
    assert found.astype(float) == approx(work.reference[some], abs=1e-30)


def test_the_stored_long_orbit_begins_as_its_maker_makes_it():
    work = works()["A"]
    states, crossings = maker.long_orbit(work.initial[0], work.times[work.rows[:20]], maker.LONG_RUNS[0])
    assert np.array_equal(states.astype(float), work.reference[:20])
    assert len(crossings) > 0
    assert np.array_equal(crossings.astype(float), works()["D"].reference[: len(crossings)])


@pytest.mark.parametrize("name, bound", [("A", 1e-11), ("A2", 1e-8)])
def test_models_agree_with_the_stored_long_orbit(name, bound):
    work = works()[name]
    orbit = solve(systems()["suslov"].at(work.parameters), work.initial[0], work.times, level("reference"))
    assert work.error(orbit.states) < bound


# What takes part


def test_a_peer_that_is_not_installed_is_named(monkeypatch):
    monkeypatch.setitem(PEERS, "no-such-peer", "no_such_peer")
    methods, missing = benchmark.participants()
    assert missing["no-such-peer"] == "not installed"
    assert {method.name for method in methods} | set(missing) == {OURS, *PEERS}


def installed_peers():
    return benchmark.participants()[0][1:]


def middle(method, work):
    """A setting of about 1e-7 in the middle of each ladder."""
    return [ladder[len(ladder) // 2] for ladder in method.ladders(work)]


@pytest.mark.parametrize(
    "method, name",
    thorough.sample([(method, name) for method in (EXPLORER, *installed_peers()) for name in works()], 3),
    ids=lambda one: getattr(one, "name", one),
)
def test_every_method_does_every_work_it_says_it_does(method, name):
    work = works()[name]
    if name not in method.without:
        for setting in middle(method, work):
            assert work.error(method.prepare(work, setting)()) < 1e-2, setting


# The command


@pytest.mark.thorough
def test_the_command_from_end_to_end(tmp_path, capsys):
    file = tmp_path / "bench.json"
    assert bench_command.main(typed(f"--quick --works C --targets 1e-3 --json {file}")) == 0
    text, err = capsys.readouterr()
    rows = [line for line in text.splitlines() if line.startswith("| C | 1e-3 |")]
    assert len(rows) == 1
    assert re.match(r"\| C \| 1e-3 \| [\d.]+ \(\d(\.\d)?e-\d+; \d+, (1|3\.2)e-\d+\) \|", rows[0])
    assert re.match(r"\d{4}-\d\d-\d\d, .+, \d+ cores, Python 3\.\d+\.\d+, Hess Explorer ", text)
    data = json.loads(file.read_text())
    errors = {row["method"]: row["error"] for row in data["works"][0]["chosen"]}
    assert errors.keys() >= {OURS, "SciPy"}
    assert max(errors.values()) <= 1e-3
    assert "settings of Hess Explorer" in err
    for name in data["missing"]:
        assert f"- {name}: not installed." in text


@pytest.mark.parametrize(
    "words, sentence",
    [
        (["--works", "A,X"], "'X' is not a work; choose from A,A2,B,B2,C,D"),
        (["--targets", "1e-3,0"], "'1e-3,0' has an error that is not positive"),
        (["--trade", "--computations", "orbit,nowhere"], "There is no computation 'nowhere'"),
        (["--picture", "bench.pdf"], "'bench.pdf' is not a picture; end the name in .svg or .png"),
    ],
)
def test_a_bad_option_gives_one_sentence(words, sentence, capsys):
    assert bench_command.main(words) == 2
    said = capsys.readouterr().err
    assert sentence in said
    assert said.count("\n") == 1


@pytest.mark.parametrize("name", sorted(one.stem for one in Path(bench_command.__file__).parent.glob("*.py")))
def test_each_script_finds_what_it_measures(name):
    """They run by hand only, so that a name that has moved would not be noticed."""
    try:
        importlib.import_module(f"manual.{name}")
    except ModuleNotFoundError as error:
        # A peer, which only the extra "bench" installs.
        assert error.name == "heyoka"
