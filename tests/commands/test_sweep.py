"""`hess-explorer sweep`: numbers, formats, stores; killed, interrupted and resumed runs; one-sentence errors."""

import os
import re
import signal
import subprocess
import sys
import time
import types

import pytest
from distributed import LocalCluster

from hess_explorer.__main__ import main
from hess_explorer.sweep import StoreStatus, explain, progress, read, store_status, sweep
from hess_mechanics import systems
from hess_mechanics.dynamics.lyapunov import lyapunov_exponent
from hess_mechanics.numerics.accuracy import PLANS, Kind
from support.command_line import replaced, strict_json, table, typed
from support.mechanics import ROOT

SWEEP = typed("sweep rotation-number --over h=-0.5,1,1.5 --over f=0:0.6:2 --set a=0.5")


def test_the_table_is_that_of_the_command_rotation_number(answer):
    found = answer(*SWEEP)
    assert found["h"] == [-0.5, -0.5, 1.0, 1.0, 1.5, 1.5]
    assert found["f"] == [0.0, 0.6] * 3
    alone = answer("rotation-number", "--a", "0.5", "--h", "-0.5,1,1.5", "--f", "0,0.6")
    assert found["rotation_number"] == alone["rotation_number"]
    assert found["status"] == ["ok", "no such motion", "separatrix", "ok", "ok", "ok"]
    assert [word == "ok" for word in found["status"]] == alone["possible"]
    assert found["status_counts"] == {"ok": 4, "no such motion": 1, "separatrix": 1}
    assert (found["level"], found["cells"], found["parameters"]) == ("precise", [3, 2], {"a": 0.5})


def test_a_store_is_kept_read_back_and_refused_to_others(answer, refusal, tmp_path, capsys):
    store = str(tmp_path / "rho.zarr")
    facts = answer(*SWEEP, "--store", store)
    assert "rotation_number" not in facts
    assert facts["status_counts"]["ok"] == 4
    assert main([*SWEEP, "--format", "csv"]) == 0
    wanted = capsys.readouterr().out
    for words in ([*SWEEP, "--store", store], ["sweep", "--read", store]):
        assert main([*words, "--format", "csv"]) == 0
        said = capsys.readouterr().out
        assert [line for line in said.splitlines() if "# store" not in line] == wanted.splitlines()
    assert main(["sweep", "--read", store, "--out", str(tmp_path / "rho.csv"), "--format", "csv"]) == 0
    assert (tmp_path / "rho.csv").read_text() == wanted
    assert "another sweep: it has a = 0.5, not 0.6" in refusal(*replaced(SWEEP, "--set", "a=0.6"), "--store", store)
    assert "does not contain a sweep" in refusal("sweep", "--read", str(tmp_path))
    assert "--read can be combined only with --format and --out" in refusal(*SWEEP, "--read", store)


def test_a_function_of_a_file_is_swept_and_written_as_a_table(answer, refusal, tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(
        "import collections\n"
        "Both = collections.namedtuple('Both', 'sum product')\n"
        "def both(x, y=2.0):\n    return Both(x + y, x * y)\n"
    )
    words = ["sweep", f"{file}:both", "--over", "x=1,3", "--set", "y=4", "--workers", "2"]
    found = answer(*words)
    assert (found["sum"], found["product"], found["x"]) == ([5.0, 7.0], [4.0, 12.0], [1.0, 3.0])
    assert (found["quantity"], found["parameters"]) == ("both", {"y": 4.0})
    assert "defines no function 'neither'" in refusal("sweep", f"{file}:neither", "--over", "x=1,3")
    assert "cannot be read (No such file" in refusal("sweep", f"{file}x:both", "--over", "x=1,3")
    assert "no parameter 'store' that --set can give" in refusal(*replaced(words, "--set", "store=1"))
    file.write_text("1 / 0")
    assert "stops with ZeroDivisionError" in refusal(*words)


FAILING = "def wanting(x, y=1.0):\n    return {1.0: 1.0, 2.0: 2.0}[x]\n"


@pytest.mark.parametrize("more", [[], ["--workers", "2"]], ids=["here", "workers"])
def test_failed_cells_are_counted_and_their_exceptions_kept(tmp_path, capsys, more):
    (tmp_path / "mine.py").write_text(FAILING)
    words = ["sweep", f"{tmp_path}/mine.py:wanting", "--over", "x=1,2,3,5", *more]
    said = "hess-explorer: 2 cells have failed of 4; x = 3.0: KeyError: 3.0.\n"
    failures = {"x = 3.0": "KeyError: 3.0", "x = 5.0": "KeyError: 5.0"}
    store = tmp_path / "mine.zarr"
    # Computed, computed into a store, and complete from the beginning.
    for line in (words, [*words, "--store", str(store)], [*words, "--store", str(store)]):
        assert main(line) == 1
        shown = capsys.readouterr()
        assert shown.err == said
        assert strict_json(shown.out)["failures"] == failures
        assert strict_json(shown.out)["status_counts"] == {"ok": 2, "failed": 2}
    assert main([*words, "--store", str(tmp_path / "parts.zarr"), "--part", "1/1"]) == 1
    assert capsys.readouterr().err == said
    # Also after a line that a killed run has left.
    with (store / "failures.jsonl").open("a") as file:
        file.write('["x = 3')
    assert explain(read(store), x=5.0) == "KeyError: 5.0"
    assert main(["sweep", "--read", str(store)]) == 0


def test_a_log_gets_lines_of_progress(monkeypatch, capsys):
    monkeypatch.setattr(progress, "_EVERY", 0.0)
    assert main(SWEEP) == 0
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "0 of 6 cells after 0 s"
    assert re.fullmatch(r"6 of 6 cells after \d+ s, about 0 s left", lines[-1])


def test_parts_share_a_store_whose_status_says_what_is_missing(answer, refusal, tmp_path):
    store = str(tmp_path / "rho.zarr")
    one = answer(*SWEEP, "--part", "1/2", "--store", store)
    assert one == answer("sweep", "--status", store)
    assert (one["cells"], one["parts"], one["missing_parts"]) == (6, 2, "2")
    assert 0 < one["missing"] < 6
    assert answer(*SWEEP, "--part", "2/2", "--store", store)["missing"] == 0
    assert answer("sweep", "--read", store)["status_counts"] == {"ok": 4, "no such motion": 1, "separatrix": 1}
    assert "was begun in 2 parts, not 3" in refusal(*SWEEP, "--part", "1/3", "--store", store)
    assert "need a store that they share" in refusal(*SWEEP, "--part", "1/3")
    assert "--status can be combined only with --out" in refusal(*SWEEP, "--status", store)


GUIDES = ROOT / "app/hess_explorer/docs/guides"


@pytest.mark.thorough
def test_the_script_for_slurm_computes_a_sweep_as_plain_processes(tmp_path):
    """Bash reads the lines for Slurm as comments; the variables are those of a job array."""
    script = (GUIDES / "array.sbatch").read_text()
    small = re.sub(r":\d+(?= )", ":12", script)
    assert small != script
    (tmp_path / "array.sbatch").write_text(small)
    command = tmp_path / "hess-explorer"
    command.write_text(f'#!/bin/sh\nexec {sys.executable} -m hess_explorer "$@"\n')
    command.chmod(0o755)
    known = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "SLURM_ARRAY_TASK_MAX": "2"}
    known["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))

    def job(number, **more):
        environment = {**known, "SLURM_ARRAY_TASK_ID": number, **more}
        subprocess.run(["bash", "array.sbatch"], cwd=tmp_path, env=environment, capture_output=True, check=True)

    job("1")
    assert store_status(tmp_path / "rho.zarr").missing_parts == (2,)
    # Again by the numbers that the status names, as the guide says.
    job("2", SLURM_ARRAY_TASK_MAX="1", PARTS="2")
    assert store_status(tmp_path / "rho.zarr").missing == 0
    found = read(tmp_path / "rho.zarr")
    over = {"h": (-0.9, 2.0, 12), "f": (-1.5, 1.5, 12)}
    assert found.rotation_number.equals(sweep("rotation-number", over, a=0.5).rotation_number)


@pytest.mark.thorough
def test_the_script_for_dask_jobqueue_computes_a_sweep(tmp_path, monkeypatch, capsys):
    """In place of jobs, processes of this machine: dask-jobqueue needs a queue."""

    class OnThisMachine(LocalCluster):
        def __init__(self, cores, processes, memory, walltime):
            quiet = {"dashboard_address": None, "silence_logs": "ERROR"}
            super().__init__(0, threads_per_worker=cores, host="127.0.0.1", protocol="tcp", processes=False, **quiet)

        def scale(self, jobs):
            super().scale(2)

    monkeypatch.setitem(sys.modules, "dask_jobqueue", types.SimpleNamespace(SLURMCluster=OnThisMachine))
    monkeypatch.chdir(tmp_path)
    script = re.sub(r"\b(300|200)\)", "6)", (GUIDES / "jobqueue.py").read_text())
    exec(compile(script, "jobqueue.py", "exec"), {"__name__": "__main__"})
    assert "rotation_number" in capsys.readouterr().out
    assert store_status(tmp_path / "rho.zarr") == StoreStatus(36, 0, 1, ())


def test_quantities_and_their_parameters_are_listed(capsys):
    assert main(["sweep", "--list"]) == 0
    said = capsys.readouterr().out
    assert "rotation-number\n    ρ: Rotation number" in said
    assert "lyapunov-euler-poisson" in said
    assert main(["sweep", "--list", "theta-plus"]) == 0
    listed = capsys.readouterr().out
    assert "theta = 1: The angle between ξ and γ on the circle that the motion leaves. (0 … 3.14159)" in listed


T = "1000"
LAMBDA = [
    "sweep",
    "lyapunov-suslov",
    "--over",
    "w1=0.2:1.4:8",
    "--over",
    "I22=1:2:8",
    "--set",
    f"t={T}",
    "--accuracy",
    "draft",
]


def begun(store):
    """Return the number of cells that are done."""
    if not store.exists():
        return 0
    found = store_status(store)
    return found.cells - found.missing


def test_a_sweep_that_is_killed_goes_on_and_is_the_loop_by_hand(tmp_path, answer):
    store = tmp_path / "lambda.zarr"
    process = subprocess.Popen(
        [sys.executable, "-m", "hess_explorer", *LAMBDA, "--store", str(store)],
        cwd=ROOT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    deadline = time.monotonic() + 120
    while begun(store) == 0 and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.005)
    process.kill()
    assert process.wait(60) == -signal.SIGKILL
    done = int((read(store).status.values > 0).sum())
    assert 0 < done == begun(store) < 64
    found = answer(*LAMBDA, "--store", str(store), "--format", "json")
    assert found["status_counts"] == {"ok": 64}
    suslov, exact = systems()["suslov"], PLANS[Kind.EXPONENT]["draft"].level
    state, parameters = suslov.example
    for i in (0, 21, 42, 63):
        body = suslov.at((parameters[0], found["I22"][i], *parameters[2:]))
        by_hand = lyapunov_exponent(body, (found["w1"][i], *state[1:]), float(T), exact)
        assert found["lyapunov_suslov"][i] == by_hand.value


def test_ctrl_c_without_a_store_writes_what_is_done(capsys, monkeypatch, tmp_path):
    import hess_explorer.sweep.run as running
    from hess_explorer.sweep import work
    from hess_explorer.sweep import workers as working

    calls = []

    def interrupted(piece):
        calls.append(piece)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return work.compute(piece)

    monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: 1)
    monkeypatch.setattr(working, "compute", interrupted)
    assert main([*SWEEP, "--format", "csv", "--out", str(tmp_path / "part.csv")]) == 130
    assert capsys.readouterr().err == "hess-explorer: stopped after 2 of 6 cells.\n"
    _, header, rows = table((tmp_path / "part.csv").read_text())
    assert [row[header.index("status")] for row in rows] == ["ok", "no such motion", *["not computed"] * 4]


@pytest.mark.parametrize(
    "words, said",
    [
        (["sweep"], "run hess-explorer sweep --list to see all of them"),
        (replaced(SWEEP, "--set", "a"), "is not a parameter; write it like h=1.5"),
        ([*SWEEP, "--set", "a=0.6"], "--set names a parameter twice"),
        (replaced(SWEEP, "--over", "h=0:1"), "is not a range"),
        (replaced(SWEEP, "--over", "h=0:1:1000000"), "at most 1000000 rows: use --store FOLDER"),
        ([*SWEEP, "--part", "3"], "'3' is not a part; write it like 3/40"),
        ([*SWEEP, "--store", "/proc/nowhere/at/all"], "cannot be written"),
        ([*SWEEP, "--store", "1" * 300], "cannot be read (File name too long)"),
        (["sweep", "--read", "1" * 300], "cannot be read (File name too long)"),
        (["sweep", "--status", "1" * 300], "does not contain a sweep"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)
