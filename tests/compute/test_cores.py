"""Pending answers take priority over background work, which still progresses under load and ends cleanly."""

import subprocess
import sys
import threading

from hess_explorer.compute import scheduler
from hess_explorer.compute.background import Background
from hess_explorer.compute.cache import Task
from hess_explorer.compute.cores import CORES, Cores
from hess_explorer.compute.scheduler import RequestQueue
from hess_mechanics.numerics.parallel import THREADS

PATIENCE = 60.0


def waited(event):
    assert event.wait(PATIENCE)


def filling(cores, patience=PATIENCE):
    """Run a piece in its own thread; return the events of its start and its end, and the thread."""
    begun, end = threading.Event(), threading.Event()

    def one():
        with cores.fill(patience):
            begun.set()
            waited(end)

    thread = threading.Thread(target=one, daemon=True)
    thread.start()
    return begun, end, thread


def test_what_is_filled_in_has_the_cores_that_are_left():
    cores = Cores(2)
    cores.answer(True)
    first, end_first, _ = filling(cores)
    waited(first)
    second, end_second, _ = filling(cores)
    assert not second.wait(0.05)
    # Another who asks is not kept waiting, and holds up the next piece.
    cores.answer(True)
    end_first.set()
    assert not second.wait(0.05)
    cores.answer(False)
    waited(second)
    end_second.set()


def test_under_any_load_it_goes_on():
    cores = Cores(1)
    cores.answer(True)
    begun, end, thread = filling(cores, patience=0.02)
    waited(begun)
    end.set()
    thread.join(PATIENCE)
    # And it gives back what it has taken.
    cores.answer(False)
    again, end, _ = filling(cores)
    waited(again)
    end.set()


def test_processes_share_the_cores_and_fill_no_more_than_their_share():
    cores = Cores(4)
    cores.shared_by(3)
    assert cores.count == 1
    first, end_first, _ = filling(cores)
    waited(first)
    # However long it has waited.
    second, end_second, _ = filling(cores, patience=0.01)
    assert not second.wait(0.1)
    end_first.set()
    waited(second)
    end_second.set()


def test_pieces_of_one_session_wait_while_others_are_answered():
    go, computed = threading.Event(), threading.Event()
    busy = [threading.Event() for _ in range(THREADS)]
    sessions = [RequestQueue() for _ in busy]
    for session, begun in zip(sessions, busy, strict=True):
        session.put(lambda begun=begun: (begun.set(), waited(go)))
    for begun in busy:
        waited(begun)
    assert scheduler._pool._max_workers > THREADS
    work = Background()
    work.follow([Task(computed.set)])
    assert not computed.wait(0.05)
    go.set()
    waited(computed)
    assert CORES.count == THREADS


def test_a_program_that_ends_meanwhile_says_nothing():
    ended = subprocess.run(
        [
            sys.executable,
            "-c",
            (
                "import time\n"
                "from hess_explorer.compute.background import run_in_steps\n"
                "from hess_explorer.compute.scheduler import RequestQueue\n"
                "run_in_steps(lambda: time.sleep(0.2) is None)\n"
                "RequestQueue().put(lambda: time.sleep(0.2))\n"
            ),
        ],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")
