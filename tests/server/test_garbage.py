"""Full garbage collections, which stop all threads, run when the server is idle, or when they are overdue."""

import gc
import threading
import time
import weakref

import pytest

from hess_explorer.server.garbage import Garbage

PATIENCE = 60.0


class Circle:
    """Refers to itself, so only a collection frees it."""

    def __init__(self):
        self.me = self


@pytest.fixture
def started():
    """Run `collect_when_quiet` with these arguments, and stop it afterwards."""
    end, threads = threading.Event(), []

    def start(garbage, asked, **more):
        threads.append(
            threading.Thread(target=garbage.collect_when_quiet, args=(asked, end), kwargs={"pause": 0.01, **more})
        )
        threads[-1].start()

    yield start
    end.set()
    for thread in threads:
        thread.join(PATIENCE)
    gc.unfreeze()


class Rounds:
    """Count the results requested so far, and the number of times this count was read."""

    def __init__(self):
        self.looked, self.busy = 0, True

    def __call__(self):
        self.looked += 1
        return self.looked if self.busy else 0

    def wait(self, count):
        ends, before = time.monotonic() + PATIENCE, self.looked
        while self.looked < before + count:
            assert time.monotonic() < ends
            time.sleep(0.005)


def set_aside(rounds):
    """Create a circle that survives a collection, drop it, and return a weak reference to it."""
    circle = Circle()
    found = weakref.ref(circle)
    rounds.wait(3)
    del circle
    return found


def test_what_a_page_left_is_collected_as_soon_as_nobody_asks(started):
    garbage, rounds = Garbage(), Rounds()
    started(garbage, rounds)
    found = set_aside(rounds)
    garbage.page_gone(None)
    rounds.wait(3)
    # Others ask: not now, and what has survived is no longer gone through by anybody.
    gc.collect()
    assert found() is not None
    rounds.busy = False
    rounds.wait(4)
    assert found() is None


def test_where_no_page_has_gone_nothing_is_collected(started):
    garbage, rounds = Garbage(), Rounds()
    rounds.busy = False
    started(garbage, rounds)
    found = set_aside(rounds)
    rounds.wait(4)
    assert found() is not None


def test_under_any_load_all_is_collected_when_that_is_overdue(started):
    garbage, rounds = Garbage(), Rounds()
    started(garbage, rounds, overdue=0.5)
    found = set_aside(rounds)
    ends = time.monotonic() + PATIENCE
    while found() is not None:
        assert time.monotonic() < ends
        time.sleep(0.01)
    assert rounds.busy
