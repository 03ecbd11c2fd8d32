"""Requests run outside the serving thread: one at a time per session, in turn, within a budget."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numba
import pytest

from hess_explorer.compute import scheduler
from hess_explorer.compute.budget import Abandoned, OverBudget, check, limited
from hess_explorer.compute.cache import ResultCache
from hess_explorer.compute.scheduler import MOST, RequestQueue
from hess_mechanics.dynamics.trade import measure
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.parallel import share

PATIENCE = 60.0


def square(n):
    return n * n


def waited(event):
    assert event.wait(PATIENCE)


def test_a_session_does_one_thing_at_a_time_in_order_and_elsewhere():
    session, done, ended, begun = RequestQueue(), [], threading.Event(), []

    def work(n):
        begun.append(n)
        assert threading.current_thread().name.startswith("request")
        # This session starts nothing before its previous request has ended.
        assert begun == [*done, n]
        done.append(n)
        if n == 9:
            ended.set()

    for n in range(10):
        assert session.put(lambda n=n: work(n))
    waited(ended)
    assert done == list(range(10))


def test_of_too_much_that_waits_the_newest_is_done():
    session, go, ended, done = RequestQueue(), threading.Event(), threading.Event(), []
    started = threading.Event()
    session.put(lambda: (started.set(), go.wait(PATIENCE)))
    waited(started)
    for n in range(MOST + 5):
        assert session.put(lambda n=n: done.append(n)) == (n < MOST)
    session.put(ended.set)
    go.set()
    waited(ended)
    assert done == list(range(6, MOST + 5))


def test_sessions_take_turns_and_an_error_ends_none(caplog):
    sessions, ended = [RequestQueue() for _ in range(3)], threading.Semaphore(0)

    def fail():
        raise ZeroDivisionError("secret")

    for session in sessions:
        session.put(fail)
        session.put(ended.release)
    for _ in sessions:
        assert ended.acquire(timeout=PATIENCE)
    assert [record.exc_info[0] for record in caplog.records] == [ZeroDivisionError] * 3


def test_turns_are_fair_in_seconds_and_not_in_number(monkeypatch):
    monkeypatch.setattr(scheduler, "_pool", ThreadPoolExecutor(1, "request"))
    began, done, everything = threading.Event(), [], threading.Semaphore(0)
    dear, cheap = RequestQueue(), [RequestQueue() for _ in range(4)]

    def work(name, seconds):
        busy(seconds)
        done.append(name)
        everything.release()

    dear.put(began.wait)
    for _ in range(3):
        dear.put(lambda: work("dear", 0.1))
    for session in cheap:
        for _ in range(5):
            session.put(lambda: work("cheap", 0.001))
    began.set()
    for _ in range(23):
        assert everything.acquire(timeout=PATIENCE)
    # One of the dear things may come before the cheap ones: until then it has cost nothing.
    assert done[-2:] == ["dear", "dear"]
    # Later requests have no priority over waiting ones; the expensive one runs when no other is waiting.
    assert done.count("cheap") == 20


def test_requests_do_not_compute_at_the_same_time(monkeypatch):
    # Longer than any request on a slow machine.
    monkeypatch.setattr(scheduler, "TURN", PATIENCE)
    running, most, ended = [], [], threading.Semaphore(0)

    def work():
        running.append(None)
        time.sleep(0.002)
        most.append(len(running))
        running.pop()
        ended.release()

    for session in [RequestQueue() for _ in range(6)]:
        for _ in range(5):
            session.put(work)
    for _ in range(30):
        assert ended.acquire(timeout=PATIENCE)
    assert set(most) == {1}


def test_a_long_request_keeps_others_waiting_for_one_turn_and_no_longer():
    long, other, began, ended = RequestQueue(), RequestQueue(), threading.Event(), threading.Event()
    long.put(lambda: (waited(began), ended.set()))
    other.put(began.set)
    waited(ended)


def test_what_nobody_waits_for_is_not_begun_and_what_runs_ends_at_its_next_computation():
    session, go, started, found, ended = RequestQueue(), threading.Event(), threading.Event(), [], threading.Event()
    cache = ResultCache(2**20)

    def work():
        try:
            found.append(cache.get(square, 2))
            started.set()
            waited(go)
            found.append(cache.get(square, 3))
        finally:
            ended.set()

    session.put(work)
    session.put(lambda: found.append("the next"))
    waited(started)
    session.end()
    go.set()
    waited(ended)
    assert session.put(lambda: found.append("later"))
    other = threading.Event()
    RequestQueue().put(other.set)
    waited(other)
    assert found == [(4, False)]


def test_what_costs_more_than_its_budget_is_refused_with_a_sentence():
    nobody = threading.Event()
    check()
    with limited(nobody, seconds=0.02), pytest.raises(OverBudget, match=r"more than 0\.02 s to compute"):
        busy(0.05)
        check()
    with limited(nobody, wait=0.0), pytest.raises(OverBudget, match="too busy"):
        time.sleep(0.001)
        check()
    nobody.set()
    with limited(nobody), pytest.raises(Abandoned):
        check()
    check()


def busy(seconds):
    end = time.thread_time() + seconds
    while time.thread_time() < end:
        pass


def test_what_other_threads_work_for_an_answer_counts_and_ends_between_two_parts():
    done = []

    def part(i):
        busy(0.02)
        done.append(i)

    with limited(threading.Event(), seconds=0.05), pytest.raises(OverBudget):
        share(part, 40, threads=2)
    # Those of two threads that had begun, and no others.
    assert 2 <= len(done) <= 6
    share(part, 2, threads=2)


def test_a_long_computation_ends_between_its_parts_when_nobody_waits():
    left, run = threading.Event(), []

    def one(plan):
        run.append(plan)
        left.set()
        return 0.0

    with limited(left), pytest.raises(Abandoned):
        measure(Kind.ORBIT, one, lambda found, truth: 0.0)
    assert len(run) == 1


def test_what_is_compiled_meanwhile_is_no_part_of_the_budget():
    compiled = numba.njit(lambda x: x + 1.0)
    with limited(threading.Event(), seconds=0.02):
        begun = time.thread_time()
        assert compiled(1.0) == 2.0
        assert time.thread_time() - begun > 0.02
        check()


def test_the_end_of_one_budget_is_not_that_of_others_who_wait_for_the_same():
    cache, started, go, calls = ResultCache(2**20), threading.Event(), threading.Event(), []
    gone = threading.Event()

    def dear(n):
        calls.append(n)
        if len(calls) == 1:
            started.set()
            waited(go)
            check()
        return n

    def first():
        with limited(gone), pytest.raises(Abandoned):
            cache.get(dear, 5)

    found = []
    leaving = threading.Thread(target=first)
    leaving.start()
    waited(started)
    waiting = threading.Thread(target=lambda: found.append(cache.get(dear, 5)[0]))
    waiting.start()
    gone.set()
    go.set()
    leaving.join(PATIENCE)
    waiting.join(PATIENCE)
    assert found == [5]
    assert calls == [5, 5]
