"""Local processes, and workers of a Dask cluster: the same numbers, and no loss when one dies."""

import os
import signal
import subprocess
import threading
import time
from contextlib import suppress

import psutil
import pytest

from hess_explorer.sweep import WorkersLost, sweep
from hess_explorer.sweep import run as running
from hess_explorer.sweep import workers as working
from hess_mechanics.errors import InvalidParameter
from support.cluster import local_cluster
from support.processes import interruptible


def motions(**options):
    """The exponents of some motions; the options are those of `sweep`."""
    return sweep("lyapunov-suslov", {"w1": (0.2, 1.4, 6), "I22": (1.0, 2.0, 5)}, level="draft", t=15.0, **options)


@pytest.fixture(scope="module")
def cluster():
    """Yield the address of a cluster with two workers."""
    with local_cluster(2) as address:
        yield address


@pytest.fixture
def client(cluster):
    from distributed import Client

    with Client(cluster, set_as_default=False) as found:
        found.wait_for_workers(2, timeout=60)
        yield found


@pytest.fixture
def pairs(monkeypatch):
    """Pieces of two cells."""
    monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: 2)


@pytest.fixture(scope="module")
def alone():
    """Return the results of a single thread."""
    return motions()


@pytest.mark.thorough
def test_workers_find_the_same_and_one_that_is_killed_is_no_loss(cluster, client, pairs, alone, tmp_path):
    before = client.run(os.getpid)
    killed = []

    def kill_one(now):
        if now.done and not killed:
            killed.append(next(iter(before.values())))
            os.kill(killed[0], signal.SIGKILL)

    found = motions(
        workers=cluster,
        progress=kill_one,
        store=tmp_path / "lambda.zarr",
    )
    assert killed
    assert found.identical(alone)
    # Another one has taken its place.
    client.wait_for_workers(2, timeout=60)
    assert set(client.run(os.getpid).values()) - set(before.values())


def test_a_client_is_used_and_stays_open(client):
    def scaled(w1, I22=1.0):
        return 2.0 * w1 * I22

    assert sweep(scaled, {"w1": [0.2, 0.3]}, workers=client).scaled.values.tolist() == [0.4, 0.6]
    assert client.submit(sum, [1, 2]).result() == 3


@pytest.mark.thorough
def test_a_scheduler_answers_over_tls(tmp_path, pairs, alone):
    import dask
    from distributed import LocalCluster, Security

    certificate, key = str(tmp_path / "certificate.pem"), str(tmp_path / "key.pem")
    words = ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=localhost", "-days", "2"]
    subprocess.run(["openssl", *words, "-keyout", key, "-out", certificate], check=True, capture_output=True)
    client = {"ca-file": certificate, "client.cert": certificate, "client.key": key}
    roles = {
        f"tls_{role}_{end}": file
        for role in ("scheduler", "worker", "client")
        for end, file in (("cert", certificate), ("key", key))
    }
    security = Security(tls_ca_file=certificate, require_encryption=True, **roles)
    quiet = {"dashboard_address": None, "silence_logs": "ERROR"}
    with LocalCluster(1, processes=False, host="tls://127.0.0.1", security=security, **quiet) as cluster:
        with pytest.raises(InvalidParameter, match="set the certificates in Dask's configuration, or pass a Client"):
            motions(workers=cluster.scheduler_address)
        with dask.config.set({f"distributed.comm.tls.{name}": file for name, file in client.items()}):
            assert motions(workers=cluster.scheduler_address).identical(alone)


def children():
    """Return the child processes of this process that compute."""
    found = []
    for one in psutil.Process().children():
        # One may end meanwhile.
        with suppress(psutil.NoSuchProcess, psutil.ZombieProcess):
            found += [one] if any("sweep" in word and "processes" in word for word in one.cmdline()) else []
    return found


def test_all_cores_find_the_same_one_that_is_killed_is_no_loss_and_none_is_left(pairs, alone, monkeypatch, tmp_path):
    monkeypatch.setattr(working, "_cores", lambda: 2)
    seen, killed = [], []

    def kill_one(now):
        seen.append(children())
        if now.done and not killed:
            killed.append(seen[-1][0])
            killed[0].kill()

    found = motions(
        workers="all",
        progress=kill_one,
        store=tmp_path / "lambda.zarr",
    )
    assert found.identical(alone)
    # Two, and another one that has taken the place of one.
    assert len({one.pid for some in seen for one in some}) == 3
    assert children() == []


def test_processes_are_ended_with_the_sweep_whatever_they_compute(monkeypatch):
    monkeypatch.setattr(running, "_cells_of_a_piece", lambda *_: 1)
    stop = threading.Event()
    threading.Timer(1.5, stop.set).start()
    begun = time.monotonic()
    # Minutes.
    found = sweep("lyapunov-suslov", {"w1": [0.2, 0.3, 0.4]}, t=1e5, workers=2, stop=stop)
    assert time.monotonic() - begun < 20.0
    assert found.status.values.tolist() == [0, 0, 0]
    assert children() == []


@pytest.mark.thorough
def test_a_piece_that_process_after_process_dies_of_is_said_and_the_others_are_kept(pairs, alone, monkeypatch):
    from hess_explorer.sweep import processes

    monkeypatch.setattr(processes, "_DEATHS", 2)
    # One piece, whoever gets it.
    monkeypatch.setattr(
        processes,
        "_PROGRAM",
        """
import os
from hess_explorer.sweep import processes
compute = processes.compute
def dies(piece):
    if 0.2 in piece.axes["w1"] and 2.0 in piece.axes["I22"]:
        os._exit(1)
    return compute(piece)
processes.compute = dies
processes.serve()""",
    )
    seen = []
    with pytest.raises(WorkersLost, match=r"1 pieces failed; .*2 worker processes crashed on it\."):
        motions(workers=2, progress=seen.append)
    assert 30 - seen[-1].done in (1, 2)


def test_a_piece_that_no_worker_can_do_is_said_and_the_others_are_kept(
    cluster, client, pairs, alone, tmp_path, monkeypatch
):
    from hess_explorer.sweep.work import compute

    # Not at the top of this module, which the workers do not have.
    def breaks(piece):
        if 0.2 in piece.axes["w1"]:
            raise RuntimeError("this machine has no such thing")
        return compute(piece)

    store = tmp_path / "lambda.zarr"
    monkeypatch.setattr(working, "compute", breaks)
    with pytest.raises(WorkersLost, match=r"pieces failed.*no such thing\..*run the same sweep again to continue"):
        motions(workers=cluster, store=store)
    monkeypatch.setattr(working, "compute", compute)
    seen = []
    found = motions(store=store, progress=seen.append)
    assert seen[0].done >= 20
    assert found.identical(alone)


def test_workers_of_another_version_are_refused(cluster, client, pairs, monkeypatch):
    monkeypatch.setattr(running, "version", lambda: "9.9")
    with pytest.raises(WorkersLost, match=r"needs 9\.9: install the same version on all workers"):
        motions(workers=cluster)


def test_a_cluster_that_is_not_there_is_one_sentence(monkeypatch):
    monkeypatch.setattr(working, "_WAIT", 0.5)
    with pytest.raises(WorkersLost, match=r"No Dask scheduler .* answered at tcp://127\.0\.0\.1:9 within 0\.5 s"):
        sweep("rotation-number", {"h": [0.5]}, a=0.5, f=0.1, workers="tcp://127.0.0.1:9")


def test_a_cluster_without_workers_is_waited_for_until_ctrl_c_or_not_for_ever(monkeypatch):
    with local_cluster(0) as empty:
        timer = threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with interruptible(), pytest.raises(KeyboardInterrupt, match=r"stopped before anything was computed\."):
            sweep("rotation-number", {"h": [0.5]}, a=0.5, f=0.1, workers=empty)
        timer.join()
        monkeypatch.setattr(working, "_WAIT", 0.5)
        with pytest.raises(WorkersLost, match="with a worker answered"):
            sweep("rotation-number", {"h": [0.5]}, a=0.5, f=0.1, workers=empty)
