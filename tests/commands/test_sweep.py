"""`hess-explorer sweep`: numbers, formats, stores; killed, interrupted and resumed runs; one-sentence errors."""

import re
import signal
import subprocess
import sys
import types

import numpy as np
import pytest
from distributed import LocalCluster

from hess_explorer.__main__ import main
from hess_explorer.sweep import StoreError, explain, read
from hess_explorer.sweep import piece as pieces
from hess_explorer.sweep import run as running
from hess_explorer.sweep import workers as working
from hess_mechanics.catalogue import find
from support.asynchronous import wait_until
from support.command_line import replaced, strict_json, table, typed
from support.mechanics import ROOT

SWEEP = typed("sweep circle-map --over h=-0.5,1,1.5 --over f=0:0.6:2 --set a=0.5")


def test_a_store_is_kept_read_back_and_refused_to_others(refusal, tmp_path, capsys):
    store, file = str(tmp_path / "rho.zarr"), tmp_path / "rho.csv"
    assert main([*SWEEP, "--store", store]) == 0
    assert "\n0.6 " not in capsys.readouterr().out
    assert main([*SWEEP, "--format", "csv"]) == 0
    wanted = capsys.readouterr().out
    for words in (SWEEP, ["sweep"]):
        assert main([*words, "--store", store, "--out", str(file), "--format", "csv"]) == 0
        assert file.read_text() == wanted
    others = replaced(SWEEP, "--set", "a=0.6")
    assert 'another sweep: it has parameters = {"a": 0.5, ' in refusal(*others, "--store", store)
    assert "does not contain a sweep" in refusal("sweep", "--store", str(tmp_path))


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
    assert (found["computation"], found["parameters"]) == ("both", {"y": 4.0})
    assert "defines no function 'neither'" in refusal("sweep", f"{file}:neither", "--over", "x=1,3")
    assert "--set cannot set 'store'" in refusal(*replaced(words, "--set", "store=1"))
    file.write_text("1 / 0")
    assert "failed with ZeroDivisionError" in refusal(*words)


FAILING = "def wanting(x, y=1.0):\n    return {1.0: 1.0, 2.0: 2.0}[x]\n"


@pytest.mark.parametrize("more", [[], ["--workers", "2"]], ids=["here", "workers"])
def test_failed_cells_are_counted_and_their_exceptions_kept(tmp_path, capsys, more):
    (tmp_path / "mine.py").write_text(FAILING)
    store = tmp_path / "mine.zarr"
    words = ["sweep", f"{tmp_path}/mine.py:wanting", "--over", "x=1,2,3,5", "--store", str(store), *more]
    failures = {"x = 3.0": "KeyError: 3.0", "x = 5.0": "KeyError: 5.0"}
    # Computed, and complete from the beginning.
    for _ in range(2):
        assert main([*words, "--format", "json"]) == 1
        shown = capsys.readouterr()
        assert shown.err == "hess-explorer: 2 of 4 cells failed; x = 3.0: KeyError: 3.0.\n"
        assert strict_json(shown.out)["failures"] == failures
        assert strict_json(shown.out)["status_counts"] == {"ok": 2, "failed": 2}
    assert explain(read(store), x=5.0) == "KeyError: 5.0"
    assert main(["sweep", "--store", str(store)]) == 0


LAMBDA = typed("sweep lyapunov suslov --over w1=0.2:1.4:20 --over I22=1:2:30 --set duration=400 --accuracy draft")


def test_a_sweep_that_is_killed_twice_is_bit_for_bit_the_loop_by_hand(tmp_path):
    store, done = tmp_path / "lambda.zarr", [0]

    def count():
        """Return how many cells are done, 0 before the store exists."""
        try:
            return int((read(store).status > 0).sum())
        except StoreError:
            return 0

    words = [sys.executable, "-m", "hess_explorer", *LAMBDA, "--workers", "2", "--store", str(store)]
    for _ in range(2):
        process = subprocess.Popen(words, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until(lambda process=process: count() != done[-1] or process.poll() is not None, 120.0)
        process.kill()
        assert process.wait(60) == -signal.SIGKILL
        done.append(count())
    assert 0 < done[1] < done[2] < 600
    assert main([*LAMBDA, "--store", str(store)]) == 0
    found, of = read(store), find("lyapunov suslov")
    assert (found.status == 1).all()
    for i, j in [*np.ndindex(found.status.shape)][::7]:
        by_hand = of.compute({"w1": float(found.w1[i]), "I22": float(found.I22[j]), "duration": 400.0}, "draft")
        assert found.lyapunov.values[i, j] == by_hand.value


def test_ctrl_c_without_a_store_writes_what_is_done(capsys, monkeypatch, tmp_path):
    calls = []

    def interrupted(piece):
        calls.append(piece)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return pieces.compute(piece)

    monkeypatch.setattr(running, "piece_size", lambda *_: 1)
    monkeypatch.setattr(working, "compute", interrupted)
    assert main([*SWEEP, "--format", "csv", "--out", str(tmp_path / "part.csv")]) == 130
    assert capsys.readouterr().err == "hess-explorer: stopped after 2 of 6 cells.\n"
    _, header, rows = table((tmp_path / "part.csv").read_text())
    assert [row[header.index("status")] for row in rows] == ["ok", "no such motion", *["not computed"] * 4]


@pytest.mark.thorough
def test_the_snippet_for_dask_jobqueue_computes_a_sweep(tmp_path, monkeypatch):
    """In place of jobs, processes of this machine: dask-jobqueue needs a queue."""

    class OnThisMachine(LocalCluster):
        def __init__(self, cores, processes, memory, walltime):
            quiet = {"dashboard_address": None, "silence_logs": "ERROR"}
            super().__init__(0, threads_per_worker=cores, host="127.0.0.1", protocol="tcp", processes=False, **quiet)

        def scale(self, jobs):
            super().scale(2)

    guide = (ROOT / "app/hess_explorer/docs/guides/cluster.md").read_text()
    snippet = next(one for one in re.findall(r"```python\n(.*?)```", guide, re.S) if "SLURMCluster(" in one)
    monkeypatch.setitem(sys.modules, "dask_jobqueue", types.SimpleNamespace(SLURMCluster=OnThisMachine))
    monkeypatch.chdir(tmp_path)
    exec(compile(re.sub(r"\b(300|200)\)", "6)", snippet), "snippet", "exec"), {"__name__": "__main__"})
    assert (read(tmp_path / "rho.zarr").status > 0).all()


@pytest.mark.parametrize(
    "words, said",
    [
        (["sweep"], "hess-explorer --help lists all"),
        (replaced(SWEEP, "--set", "a"), "--set: invalid assignment value: 'a'"),
        (replaced(SWEEP, "--over", "h=0:1"), "--over: invalid assignment value: 'h=0:1'"),
        (replaced(SWEEP, "--over", "h=0:1:10000000"), "at most 10000000 are allowed"),
        ([*SWEEP, "--store", "/proc/nowhere/at/all"], "cannot be written"),
        ([*SWEEP, "--store", "1" * 300], "cannot be used: File name too long"),
        (["sweep", "--store", "1" * 300], "does not contain a sweep"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)
