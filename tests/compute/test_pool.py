"""Requests run outside the serving thread, one at a time per session, in rotation, within a budget; then the tasks."""

import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from threading import Event, current_thread

import numba
import pytest

from hess_explorer.compute import pool
from hess_explorer.compute.budget import ClientGone, OverBudget, check, time_budget
from hess_explorer.compute.cache import ResultCache
from hess_explorer.compute.pool import MAX_REQUESTS, Pool, RequestQueue
from hess_mechanics.dynamics.trade import measure
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.parallel import run_in_threads

PATIENCE = 60.0


def square(n):
    return n * n


def waited(event):
    assert event.wait(PATIENCE)


@pytest.fixture
def own(monkeypatch):
    """Return a pool for this test alone, with one core."""
    found = Pool(1)
    monkeypatch.setattr(pool, "POOL", found)
    return found


def occupied(own, task=False):
    """Occupy a thread of the pool; return the event that frees it again."""
    begun, end = Event(), Event()

    def work():
        begun.set()
        waited(end)

    (own.add_task if task else RequestQueue().put)(work)
    waited(begun)
    return end


def test_requests_of_a_session_run_in_order_one_at_a_time_and_of_too_many_the_newest():
    session, go, ended, done = RequestQueue(), Event(), Event(), []
    started = Event()
    session.put(lambda: (started.set(), waited(go)))
    waited(started)
    for n in range(MAX_REQUESTS + 5):
        session.put(lambda n=n: done.append((n, current_thread().name[:7])))
    session.put(ended.set)
    go.set()
    waited(ended)
    assert done == [(n, "request") for n in range(6, MAX_REQUESTS + 5)]


def test_the_session_that_was_served_least_recently_is_next_and_an_error_ends_none(own, caplog):
    def fail():
        raise ZeroDivisionError("secret")

    done, ended = [], Event()
    sessions = [RequestQueue() for _ in range(3)]
    ends = [occupied(own) for _ in range(2)]
    for i, session in enumerate(sessions):
        session.served = -i
        for request in (lambda i=i: done.append(i), fail, lambda i=i: done.append(i)):
            session.put(request)
    sessions[0].put(ended.set)
    ends[0].set()
    waited(ended)
    ends[1].set()
    assert done == [2, 1, 0, 2, 1, 0]
    assert [record.exc_info[0] for record in caplog.records] == [ZeroDivisionError] * 3


def test_tasks_wait_while_requests_occupy_the_cores_and_never_hold_up_a_request(own, monkeypatch):
    monkeypatch.setattr(pool, "PATIENCE", PATIENCE)
    begun, request = Event(), occupied(own)
    own.add_task(begun.set)
    assert not begun.wait(0.05)
    request.set()
    waited(begun)
    tasks = occupied(own, task=True)
    occupied(own).set()
    tasks.set()


def test_under_any_load_tasks_go_on_but_no_more_at_a_time_than_cores(own, monkeypatch):
    monkeypatch.setattr(pool, "PATIENCE", 0.01)
    requests = [occupied(own) for _ in range(2)]
    task, second = occupied(own, task=True), Event()
    own.add_task(second.set)
    assert not second.wait(0.1)
    task.set()
    waited(second)
    for one in requests:
        one.set()
    own.set_cores(0)
    assert own.cores == 1


def test_a_program_that_ends_meanwhile_says_nothing():
    program = """
import time
from hess_explorer.compute.background import Background
from hess_explorer.compute.cache import Task
from hess_explorer.compute.pool import RequestQueue
Background().follow([Task(time.sleep, 0.2 + 0.001 * n) for n in range(9)])
for _ in range(9):
    RequestQueue().put(lambda: time.sleep(0.2))
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")


def test_what_nobody_waits_for_is_not_begun_and_what_runs_ends_at_its_next_computation():
    session, go, started, found, ended = RequestQueue(), Event(), Event(), [], Event()
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
    session.put(lambda: found.append("later"))
    other = Event()
    RequestQueue().put(other.set)
    waited(other)
    assert found == [(4, False)]


def test_what_costs_more_than_its_budget_is_refused_with_a_sentence():
    nobody = Event()
    check()
    with time_budget(nobody, seconds=0.02), pytest.raises(OverBudget, match=r"more than 0\.02 s to compute"):
        busy(0.05)
        check()
    with time_budget(nobody, wait=0.0), pytest.raises(OverBudget, match="too busy"):
        time.sleep(0.001)
        check()
    nobody.set()
    with time_budget(nobody), pytest.raises(ClientGone):
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

    with time_budget(Event(), seconds=0.05), pytest.raises(OverBudget):
        run_in_threads(part, 40, threads=2)
    # Those of two threads that had begun, and no others.
    assert 2 <= len(done) <= 6
    run_in_threads(part, 2, threads=2)


def test_a_long_computation_ends_between_its_parts_when_nobody_waits():
    left, run = Event(), []

    def one(plan):
        run.append(plan)
        left.set()
        return 0.0

    with time_budget(left), pytest.raises(ClientGone):
        list(measure(Kind.ORBIT, one, lambda found, truth: 0.0))
    assert len(run) == 1


def test_what_is_compiled_meanwhile_is_no_part_of_the_budget():
    compiled = numba.njit(lambda x: x + 1.0)
    with time_budget(Event(), seconds=0.02):
        begun = time.thread_time()
        assert compiled(1.0) == 2.0
        assert time.thread_time() - begun > 0.02
        check()


def test_the_end_of_one_budget_is_not_that_of_others_who_wait_for_the_same():
    cache, started, go, gone, calls = ResultCache(2**20), Event(), Event(), Event(), []

    def dear(n):
        calls.append(n)
        if len(calls) == 1:
            started.set()
            waited(go)
            check()
        return n

    def first():
        with time_budget(gone), pytest.raises(ClientGone):
            cache.get(dear, 5)

    with ThreadPoolExecutor(2) as threads:
        leaving = threads.submit(first)
        waited(started)
        waiting = threads.submit(cache.get, dear, 5)
        gone.set()
        go.set()
        leaving.result(PATIENCE)
        assert waiting.result(PATIENCE)[0] == 5
    assert calls == [5, 5]
