"""Workers of a Dask cluster: the same numbers, no loss when one dies, and no process that is left behind."""

import os
import re
import signal
import subprocess
import sys
from contextlib import contextmanager, suppress

import psutil
import pytest
from distributed import LocalCluster

from hess_explorer.sweep import WorkersLost, sweep
from hess_explorer.sweep import workers as working
from support.asynchronous import wait_until
from support.command_line import typed
from support.processes import interruptible


@contextmanager
def local_cluster(processes):
    """Yield the address of a cluster with this many single-threaded workers; 0: a scheduler alone."""
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
        **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"),
    }
    quiet = {"dashboard": False, "dashboard_address": "127.0.0.1:0"}
    with LocalCluster(n_workers=0, host="127.0.0.1", scheduler_kwargs=quiet, silence_logs="ERROR") as cluster:
        if not processes:
            yield cluster.scheduler_address
            return
        # As on a cluster they are programs of their own; those of LocalCluster import the main script again.
        command = [
            sys.executable,
            "-m",
            "dask",
            "worker",
            cluster.scheduler_address,
            "--nworkers",
            str(processes),
            "--nthreads",
            "1",
            "--memory-limit",
            "0",
            "--host",
            "127.0.0.1",
            "--no-dashboard",
            "--dashboard-address",
            "127.0.0.1:0",
            "--death-timeout",
            "30",
        ]
        workers = subprocess.Popen(
            command,
            env=environment,
            start_new_session=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            yield cluster.scheduler_address
        finally:
            workers.terminate()
            try:
                workers.wait(timeout=10.0)
            except subprocess.TimeoutExpired:
                workers.kill()
                workers.wait()


def motions(**options):
    """The exponents of some motions; the options are those of `sweep`."""
    return sweep(
        "lyapunov suslov", {"w1": (0.2, 1.4, 6), "I22": (1.0, 2.0, 5)}, accuracy="draft", duration=15.0, **options
    )


@pytest.fixture(scope="module")
def client():
    """Yield a client of a cluster with two workers."""
    from distributed import Client

    with local_cluster(2) as address, Client(address, set_as_default=False) as found:
        found.wait_for_workers(2, timeout=60)
        yield found


@pytest.fixture
def pairs(in_pieces):
    """Pieces of two cells."""
    in_pieces(2)


@pytest.fixture(scope="module")
def alone():
    """Return the results of a single thread."""
    return motions()


def workers(parent):
    """Return the worker processes of a process that are still alive."""
    found = []
    for one in parent.children():
        # A child of another kind may have ended since, as may a worker.
        with suppress(psutil.NoSuchProcess):
            if "spawn_main" in " ".join(one.cmdline()):
                found.append(one)
    return found


def test_processes_find_the_same_one_that_is_killed_is_no_loss_and_none_is_left(pairs, alone, tmp_path):
    this, seen = psutil.Process(), []
    before = {*workers(this)}

    def kill_one(now):
        seen.append({*workers(this)} - before)
        if now.done and len(seen) == 2:
            next(iter(seen[0])).kill()

    found = motions(workers=2, progress=kill_one, store=tmp_path / "lambda.zarr")
    assert found.identical(alone)
    assert len(seen[0]) == 2
    assert not {*workers(this)} - before


def test_a_cluster_finds_the_same_and_its_client_stays_open(client, pairs, alone):
    assert motions(scheduler=client).identical(alone)
    assert motions(scheduler=client.scheduler.address).identical(alone)
    assert client.submit(sum, [1, 2]).result() == 3


SWEEP = typed("sweep lyapunov suslov --over w1=0.2:1.4:4000 --set duration=1e5 --accuracy draft --workers 2")


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL], ids=lambda one: one.name)
def test_no_process_is_left_whatever_they_compute(end):
    """Cells of seconds; Ctrl-C reaches all processes of a terminal."""
    words = [sys.executable, "-m", "hess_explorer", *SWEEP]
    with interruptible():
        process = psutil.Popen(
            words, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )

    def have_begun():
        """Whether both workers have used more of a processor than their start takes, on whatever machine."""
        own = workers(process)
        return len(own) == 2 and all(sum(one.cpu_times()[:2]) > 6.0 for one in own)

    # Workers that have not started yet would say more.
    wait_until(have_begun, 300.0)
    children = process.children(recursive=True)
    os.killpg(process.pid, end) if end == signal.SIGINT else process.kill()
    _, said = process.communicate(timeout=120.0)
    assert process.returncode == (130 if end == signal.SIGINT else -signal.SIGKILL)
    # After SIGKILL Python itself says that it cleans up.
    assert end == signal.SIGKILL or re.fullmatch(
        r"hess-explorer: (interrupted|stopped after \d+ of 4000 cells)\.\n", said
    )
    assert psutil.wait_procs(children, timeout=60.0)[1] == []


def test_a_piece_that_no_worker_can_do_is_said_and_the_others_are_kept(client, pairs, alone, tmp_path, monkeypatch):
    # Not at the top of this module, which the workers do not have.
    from hess_explorer.sweep.piece import compute_sent

    def breaks(content, version, axes):
        if 0.2 in axes["w1"]:
            raise RuntimeError("this machine has no such thing")
        return compute_sent(content, version, axes)

    store = tmp_path / "lambda.zarr"
    with monkeypatch.context() as now:
        now.setattr(working, "compute_sent", breaks)
        with pytest.raises(WorkersLost, match=r"pieces failed.*no such thing.*run the same sweep again to continue"):
            motions(scheduler=client, store=store)
    seen = []
    assert motions(store=store, progress=seen.append).identical(alone)
    assert seen[0].done >= 20


def test_workers_of_another_version_are_refused(client, pairs, monkeypatch):
    monkeypatch.setattr(working, "version", lambda: "9.9")
    with pytest.raises(WorkersLost, match=r"needs 9\.9: install the same version on all workers"):
        motions(scheduler=client)


def test_a_cluster_that_is_not_there_is_one_sentence(monkeypatch):
    monkeypatch.setattr(working, "_WAIT", 0.5)
    with pytest.raises(WorkersLost, match=r"No Dask scheduler .* responded at tcp://127\.0\.0\.1:9 within 0\.5 s"):
        motions(scheduler="tcp://127.0.0.1:9")


def test_a_script_without_the_condition_is_said(tmp_path):
    (tmp_path / "mine.py").write_text(
        "from hess_explorer.sweep import sweep\nsweep(lambda x: x, {'x': [1.0, 2.0]}, workers=2)\n"
    )
    words = [sys.executable, tmp_path / "mine.py"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=60.0, check=False)
    assert "in a script, call `sweep` below `if __name__ == '__main__':`" in done.stderr.splitlines()[-1]
