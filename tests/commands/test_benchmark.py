"""The benchmark: its references, its choice of settings, its formats and its command.  Times are not asserted."""

import importlib
import json
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from math import inf, pi
from pathlib import Path

import numpy as np
import pytest
from pytest import approx

from benchmarks import bench as bench_command
from benchmarks import make_benchmark_references as maker
from benchmarks.integrators import run as benchmark
from benchmarks.integrators.explorer import METHOD as EXPLORER
from benchmarks.integrators.measure import (
    FULL,
    QUICK,
    Chosen,
    MeasuredWorkload,
    MethodSample,
    Timing,
    cheapest,
    climb,
    measure,
    race,
)
from benchmarks.integrators.method import OURS, Method, named
from benchmarks.integrators.peers import PEERS
from benchmarks.integrators.peers.scipy_peer import METHOD as SCIPY
from benchmarks.integrators.report import BenchmarkReport, as_json, as_text
from benchmarks.integrators.scaling import Scaling, scaling
from benchmarks.integrators.works import works
from hess_explorer.__main__ import main
from hess_explorer.commands import CommandError
from hess_explorer.commands import bench as bench_of_the_wheel
from hess_explorer.scenes import scenes
from hess_mechanics import LEVELS, level, solve, systems
from support import thorough
from support.command_line import typed
from support.mechanics import ROOT, scipy_states
from support.processes import interruptible

# References


@pytest.mark.parametrize("name, body", [("B", maker.FREE_BODY), ("B2", maker.FIELD_BODY)])
def test_the_stored_ensembles_are_what_their_maker_makes(name, body):
    work, some = works()[name], [0, 77, 511]
    found = maker.ends(body, work.initial[some], maker.RUNS[0])
    assert found.astype(float) == approx(work.reference[some], abs=1e-30)


def test_the_stored_angles_are_what_their_maker_makes():
    work = works()["C"]
    assert np.array_equal(maker.angles(work.phi[::50], maker.RUNS[0]), work.reference[::50])


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


def test_the_stored_crossings_lie_on_the_section_and_on_the_level_of_the_orbit():
    work = works()["D"]
    integrals = systems()["suslov"].integrals
    assert np.all(work.reference[:, 4] == 0.0)
    w1, w2, g1, g2, _ = work.reference.T
    assert np.all(g1 * w2 - g2 * w1 > 0.0)
    start = integrals(work.initial[0], work.parameters)
    along = integrals(work.reference.T, work.parameters)
    for name in start:
        assert np.max(np.abs(along[name] - start[name])) < 1e-14


# Errors


@pytest.mark.parametrize("name", list(works()))
def test_the_error_of_a_result_is_its_largest_deviation(name):
    work = works()[name]
    exact = np.zeros(work.shape)
    exact[work.rows] = work.reference
    wrong = exact.copy()
    wrong[np.arange(len(exact))[work.rows][-1]] += 0.125
    assert (work.error(exact), work.error(wrong)) == (0.0, approx(0.125, rel=0, abs=1e-14))
    wrong[0] = np.nan
    assert work.error(exact[:-1]) == work.error(wrong) == inf
    # An angle is compared modulo a turn.
    assert name != "C" or work.error(work.reference + 2 * pi * np.arange(256)) < 1e-12


# Choice of settings, times


def constant(name, results, ladders):
    """A method that gives each setting's own result at once."""
    return Method(name, "1", lambda work: ladders, lambda work, setting, threads=1: lambda: results[setting])


def sample(error, seconds, setting=("a",)):
    return MethodSample(setting, error, seconds, run=lambda: None)


def test_the_cheapest_setting_is_the_fastest_that_keeps_the_error():
    exact, quick, wrong = sample(1e-9, 3.0), sample(1e-7, 2.0), sample(1e-2, 1.0)
    samples = [exact, quick, wrong, sample(inf, 0.5)]
    for error, one in ((1e-2, wrong), (1e-3, quick), (1e-7, quick), (1e-8, exact), (1e-10, None)):
        assert cheapest(samples, error) is one


def test_a_method_with_a_wrong_result_is_not_admitted_and_one_setting_is_timed_once():
    work = works()["C"]
    exact = constant("exact", {(1.0,): work.reference}, [((1.0,),)])
    wrong = constant("wrong", {(1.0,): work.reference + 1e-2}, [((1.0,),)])
    lazy = replace(constant("lazy", {}, []), without={"C": "it would rather not"})
    found = measure(work, [exact, wrong, lazy], [0.1, 1e-3], QUICK, lambda text: None)
    first, second = (found.chosen["exact"][target].timing for target in (0.1, 1e-3))
    assert first is second
    assert set(found.chosen["wrong"]) == {0.1}
    assert found.samples["wrong"][0].error == approx(1e-2)
    assert (found.notes, "lazy" in found.samples) == (["lazy, work C: it would rather not."], False)


@pytest.mark.parametrize("limit, left_out", [("slow", ["a, 2"]), ("budget", ["a, 2", "b, 1"])])
def test_settings_over_a_limit_are_left_out_with_a_sentence(limit, left_out):
    work = works()["C"]
    settings = [("a", 1), ("a", 2), ("b", 1)]
    method = constant("m", dict.fromkeys(settings, work.reference), [settings[:2], settings[2:]])
    samples, notes = climb(work, method, replace(FULL, **{limit: 0.0}))
    assert [one.setting for one in samples] == [one for one in settings if named(one) not in left_out]
    assert [note.split(", as")[0] for note in notes] == [f"m, work C: left out {one} to {one}" for one in left_out]


def test_runs_are_timed_in_turn_until_one_had_its_share():
    order = []
    slow, quick = race([lambda: time.sleep(0.01), lambda: order.append(1)], replace(QUICK, turns=3, share=0.005))
    assert (slow.runs, quick.runs, order) == (1, 3, [1, 1, 1])
    assert 0.0 <= quick.minimum <= quick.median


def test_two_threads_are_compared_with_one_at_the_finest_setting():
    work = works()["C"]
    prepared = []

    def prepare(work, setting, threads=1):
        prepared.append((setting, threads))
        return lambda: work.reference

    method = Method("m", "1", lambda work: [((1.0,), (2.0,))], prepare, threaded=frozenset({"C"}))
    alone = replace(method, name="alone", threaded=frozenset())
    found = measure(work, [method, alone], [1e-3], QUICK, lambda text: None)
    setting = found.chosen["m"][1e-3].sample.setting
    prepared.clear()
    (one,) = scaling([found], [method, alone], QUICK, lambda text: None)
    assert (one.method, one.setting) == ("m", setting)
    assert prepared == [(setting, 1), (setting, 2)]


# What takes part


def test_a_peer_that_is_not_installed_is_named(monkeypatch):
    monkeypatch.setitem(PEERS, "no-such-peer", "no_such_peer")
    methods, missing = benchmark.participants()
    assert missing["no-such-peer"] == "not installed"
    assert {method.name for method in methods} | set(missing) == {OURS, *PEERS}
    report = made_up(missing={"no-such-peer": "not installed"})
    assert "- no-such-peer: not installed." in as_text(report)
    assert as_json(report)["missing"] == {"no-such-peer": "not installed"}


def test_a_peer_that_cannot_be_imported_is_named_with_the_reason(monkeypatch):
    def broken(name):
        raise ImportError("its library is gone")

    monkeypatch.setattr(benchmark, "load", broken)
    methods, missing = benchmark.participants()
    assert methods == [EXPLORER]
    assert missing["heyoka"] == "installed, but it cannot be imported (its library is gone)"


def installed_peers():
    return benchmark.participants()[0][1:]


def middle(method, work):
    """A setting of about 1e-7 in the middle of each ladder."""
    return [ladder[len(ladder) // 2] for ladder in method.ladders(work)]


@pytest.mark.parametrize(
    "method, name",
    thorough.sample([(method, name) for method in (EXPLORER, *installed_peers()) for name in works()], 5),
    ids=lambda one: getattr(one, "name", one),
)
def test_every_method_does_every_work_it_says_it_does(method, name):
    work = works()[name]
    if name not in method.without:
        for setting in middle(method, work):
            assert work.error(method.prepare(work, setting)()) < 1e-2, setting


@pytest.mark.parametrize("method", [EXPLORER, *installed_peers()], ids=lambda method: method.name)
def test_a_run_can_be_repeated_and_shared(method):
    for name in ("B2", "C"):
        work = works()[name]
        setting = middle(method, work)[0]
        run = method.prepare(work, setting)
        once = np.array(run())
        assert np.array_equal(run(), once)
        if name in method.threaded:
            assert np.array_equal(method.prepare(work, setting, 2)(), once)


def test_finer_settings_of_scipy_are_more_exact():
    work = works()["C"]
    for ladder in SCIPY.ladders(work):
        errors = [work.error(SCIPY.prepare(work, setting)()) for setting in (ladder[0], ladder[4], ladder[-1])]
        assert errors[0] > 10 * errors[1] > 100 * errors[2]


# Formats


def chosen(error, minimum, setting):
    return Chosen(sample(error, minimum, setting), Timing(minimum, 1.5 * minimum, 20))


def made_up(missing=None, threads=()):
    work = works()["C"]
    picked = {
        OURS: {1e-3: chosen(2.5e-4, 1e-3, (10, 1e-5)), 1e-6: chosen(2.5e-7, 2e-3, (14, 1e-8))},
        "peer": {1e-3: chosen(1e-4, 4e-3, ("fast", 1e-5))},
    }
    samples = {name: [one.sample for one in by_target.values()] for name, by_target in picked.items()}
    samples["peer"].append(sample(inf, 7.0, ("fast", 1e-9)))
    facts = {"date": "2026-01-02", "processor": "Made-up 1", "cores": 2, "python": "3.11"}
    return BenchmarkReport(
        facts,
        {OURS: "0.1", "peer": "7"},
        missing or {},
        (1e-3, 1e-6),
        [MeasuredWorkload(work, samples, picked, ["peer, work C: a sentence."])],
        threads,
    )


def test_table_and_json_have_times_errors_settings_and_ratios():
    one = Scaling("B2: orbits", OURS, (18, 1e-11), Timing(4e-3, 5e-3, 9), Timing(2e-3, 3e-3, 9))
    report = made_up(threads=[one])
    text, data = as_text(report), json.loads(json.dumps(as_json(report), allow_nan=False))
    for line in (
        "2026-01-02, Made-up 1, 2 cores, Python 3.11, Hess Explorer 0.1, peer 7.",
        "| work | error | Hess Explorer | peer |",
        "| C | 1e-3 | 1.00 (2.5e-4; 10, 1e-5) | 4.00 (4.0 ×) |",
        "| C | 1e-6 | 2.00 (2.5e-7; 14, 1e-8) | – |",
        "- peer, work C: a sentence.",
        "| B2: orbits | Hess Explorer | 18, 1e-11 | 4.00 | 2.00 | 2.00 × |",
    ):
        assert line in text
    assert "Two cores" not in as_text(made_up())
    times = {"one_thread": 4e-3, "two_threads": 2e-3, "factor": 2.0}
    assert data["two_cores"] == [{"work": "B2: orbits", "method": OURS, "setting": "18, 1e-11", **times}]
    assert (data["processor"], data["targets"]) == ("Made-up 1", [1e-3, 1e-6])
    (work,) = data["works"]
    assert work["samples"]["peer"][-1] == {"setting": "fast, 1e-9", "seconds": 7.0, "error": None}
    peer = {"method": "peer", "target": 1e-3, "setting": "fast, 1e-5", "error": 1e-4}
    assert {**peer, "minimum": 4e-3, "median": 6e-3, "runs": 20, "ratio": 4.0} in work["chosen"]


@pytest.mark.parametrize("suffix, begin", [(".svg", b"<?xml"), (".png", b"\x89PNG")])
def test_the_picture_is_a_picture(suffix, begin):
    from benchmarks.integrators.picture import draw

    assert draw(made_up(), suffix).startswith(begin)


# The command


def bench(*words):
    return [sys.executable, "-m", "hess_explorer", "bench", *words]


def test_the_command_from_end_to_end(tmp_path):
    file = tmp_path / "bench.json"
    done = subprocess.run(
        bench("--quick", "--works", "C", "--targets", "1e-3", "--json", str(file)),
        cwd=ROOT,
        capture_output=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr.decode()
    text = done.stdout.decode()
    rows = [line for line in text.splitlines() if line.startswith("| C | 1e-3 |")]
    assert len(rows) == 1
    assert re.match(r"\| C \| 1e-3 \| [\d.]+ \(\d(\.\d)?e-\d+; \d+, (1|3\.2)e-\d+\) \|", rows[0])
    assert re.match(r"\d{4}-\d\d-\d\d, .+, \d+ cores, Python 3\.\d+\.\d+, Hess Explorer ", text)
    data = json.loads(file.read_text())
    errors = {row["method"]: row["error"] for row in data["works"][0]["chosen"]}
    assert errors.keys() >= {OURS, "SciPy"}
    assert max(errors.values()) <= 1e-3
    assert "settings of Hess Explorer" in done.stderr.decode()
    for name in data["missing"]:
        assert f"- {name}: not installed." in text


@pytest.mark.parametrize(
    "words, sentence",
    [
        (["--works", "A,X"], "'X' is not a work; choose from A,A2,B,B2,C,D"),
        (["--works", ""], "'' is not a work"),
        (["--targets", "1e-3,0"], "'1e-3,0' has an error that is not positive"),
        (["--targets", "small"], "'small' is not a number"),
        (["--trade", "--scenes", "kharlamova,nowhere"], "'nowhere' is not a scene; choose from suslov-hess,"),
        (["--picture", "bench.pdf"], "'bench.pdf' is not a picture; end the name in .svg or .png"),
    ],
)
def test_a_bad_option_gives_one_sentence(words, sentence, capsys):
    assert main(["bench", *words]) == 2
    said = capsys.readouterr().err
    assert sentence in said
    assert said.count("\n") == 1


def test_a_picture_without_matplotlib_is_refused_before_measuring(monkeypatch):
    monkeypatch.setattr(bench_command, "find_spec", lambda name: None)
    with pytest.raises(CommandError, match=r"--picture needs Matplotlib"):
        bench_command._require_matplotlib()


def test_without_the_sources_the_command_says_what_to_do(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(bench_of_the_wheel, "_TESTS", tmp_path)
    assert main(["bench"]) == 2
    assert capsys.readouterr().err == (
        "hess-explorer: The benchmark is not part of the package: run pip install -e '.[bench]' in a source checkout "
        "and try again.\n"
    )


def test_the_trade_of_a_scene_is_measured_and_printed(capsys):
    """Errors are compared with SciPy's orbit; times are not checked."""
    assert main(typed("bench --trade --quick --scenes kharlamova --format json")) == 0
    said = capsys.readouterr()
    assert said.err.splitlines() == ["kharlamova: orbit …"]
    data = json.loads(said.out)
    assert [(one["scene"], one["kind"], one["level"]) for one in data] == [
        ("kharlamova", "orbit", name) for name in LEVELS
    ]
    scene = scenes()["kharlamova"]
    motion = scene.of(scene.defaults()).motion()
    times = np.linspace(0.0, motion.span, 400)
    exact = scipy_states(motion.system, motion.state, motion.parameters, times)
    found = solve(motion, motion.state, times, level("draft")).states
    away = np.abs(found - exact) * motion.weights
    pixels = max(np.linalg.norm(away[:, :2], axis=1).max(), np.linalg.norm(away[:, 2:], axis=1).max())
    assert data[0]["error"] == approx(pixels, rel=1e-3)
    assert data[0]["error"] > data[1]["error"] > data[2]["error"] > data[3]["error"]
    assert all(one["ms"] > 0.0 and one["enough"] == "draft" for one in data)


def test_ctrl_c_ends_it_cleanly():
    with (
        interruptible(),
        subprocess.Popen(bench("--works", "C"), cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process,
    ):
        process.stderr.readline()
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert out == b""
    assert err.decode().splitlines()[-1] == "hess-explorer: interrupted."


@pytest.mark.parametrize("name", sorted(one.stem for one in Path(bench_command.__file__).parent.glob("*.py")))
def test_each_script_finds_what_it_measures(name):
    """They run by hand only, so that a name that has moved would not be noticed."""
    try:
        importlib.import_module(f"benchmarks.{name}")
    except ModuleNotFoundError as error:
        # A peer, which only the extra "bench" installs.
        assert error.name == "heyoka"
