"""The cache of results: one computation per key, bounded in bytes, errors are not kept."""

import threading
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hess_explorer.compute.cache import ResultCache, size_of
from hess_explorer.scenes import scenes
from hess_mechanics.numerics.results import as_read_only

KILOBYTE = 1024
WAIT = 30


@dataclass(frozen=True)
class Result:
    name: str
    array: np.ndarray


class Counted:
    """Function that records its calls; it has a name, since cache keys contain the name of a function."""

    __module__ = __name__

    def __init__(self, name="counted", size=KILOBYTE):
        self.__qualname__ = name
        self.calls = []
        self.size = size

    def __call__(self, *arguments):
        self.calls.append(arguments)
        return Result(str(arguments), as_read_only(np.zeros(self.size, np.uint8)))


def test_a_second_question_gets_the_same_object_and_is_told_so():
    cache, function = ResultCache(2**20), Counted()
    first, was_there = cache.get(function, 1.0, "draft")
    assert not was_there
    second, was_there = cache.get(function, 1.0, "draft")
    assert was_there
    assert second is first
    assert function.calls == [(1.0, "draft")]
    # Other arguments and other functions are other questions.
    assert cache.get(function, 2.0, "draft")[0] is not first
    assert cache.get(Counted("other"), 1.0, "draft")[0] is not first
    counted = cache.metrics()
    assert [counted[f"cache_{name}"] for name in ("hits", "misses", "entries")] == [1, 3, 3]


class Slow(Counted):
    """Function that computes when released; `asked` is set when it has started."""

    def __init__(self, error=None):
        super().__init__("slow")
        self.error = error
        self.begun, self.may_end = threading.Event(), threading.Event()

    def __call__(self, *arguments):
        result = super().__call__(*arguments)
        self.begun.set()
        assert self.may_end.wait(WAIT)
        if self.error is not None:
            raise self.error
        return result


def ask_together(cache, function, count):
    """Return the futures of `count` threads, all of which have made their request before the function may return."""
    pool = ThreadPoolExecutor(count)
    futures = [pool.submit(cache.get, function, 1.0)]
    assert function.begun.wait(WAIT)
    arrived = threading.Semaphore(0)

    def late():
        arrived.release()
        return cache.get(function, 1.0)

    futures += [pool.submit(late) for _ in range(count - 1)]
    for _ in range(count - 1):
        assert arrived.acquire(timeout=WAIT)
    function.may_end.set()
    pool.shutdown()
    return futures


def test_concurrent_misses_are_computed_once():
    cache, function = ResultCache(2**20), Slow()
    results = [future.result(WAIT) for future in ask_together(cache, function, 8)]
    assert len(function.calls) == 1
    assert len({id(result) for result, _ in results}) == 1
    assert sorted(was_there for _, was_there in results) == [False] + [True] * 7


def test_an_error_reaches_everyone_who_waited_and_is_not_kept():
    error = ValueError("no motion")
    cache, function = ResultCache(2**20), Slow(error)
    for future in ask_together(cache, function, 4):
        assert future.exception(WAIT) is error
    function.error = None
    _, was_there = cache.get(function, 1.0)
    assert not was_there
    assert cache.get(function, 1.0)[1]
    assert cache.bytes == size_of(Result("", np.zeros(KILOBYTE, np.uint8)))


def test_the_least_recently_used_go_first():
    function = Counted()
    cache = ResultCache(3 * size_of(function(0)))
    for i in (1, 2, 3):
        cache.get(function, i)
    assert cache.get(function, 1)[1]
    cache.get(function, 4)
    assert [cache.get(function, i)[1] for i in (4, 3, 1)] == [True] * 3
    assert not cache.get(function, 2)[1]


@given(st.integers(0, 20 * KILOBYTE), st.lists(st.tuples(st.integers(0, 9), st.integers(0, 8 * KILOBYTE)), max_size=40))
def test_what_is_held_is_what_is_counted_and_never_exceeds_the_capacity(capacity, questions):
    cache, function = ResultCache(capacity), Counted()
    last = {}
    for key, size in questions:
        function.size = size
        result, was_there = cache.get(function, key)
        assert not was_there or result is last[key]
        last[key] = result
        assert cache.bytes <= capacity
    assert cache.bytes == sum(size_of(last[key]) for key in last if cache.peek(function, key) is not None)


def arrays_in(value):
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, (tuple, list)):
        for item in value:
            yield from arrays_in(item)
    elif isinstance(value, Mapping):
        yield from arrays_in(list(value.values()))
    elif hasattr(value, "__dataclass_fields__"):
        for name in value.__dataclass_fields__:
            yield from arrays_in(getattr(value, name))


# The scenes that look into another one are of one class.
@pytest.mark.parametrize("name", [name for name, one in scenes().items() if one.origin in (None, "suslov-hess")])
def test_every_array_that_a_scene_shares_is_counted_and_read_only(name, monkeypatch):
    cache = ResultCache(2**30)
    scene = scenes()[name]
    monkeypatch.setattr("hess_explorer.scenes.framework.work.CACHE", cache)
    state = scene.compute(scene.defaults(), scene.pictures, False)
    held = {id(array): array.nbytes for result in cache._results.values() for array in arrays_in(result)}
    assert sum(held.values()) <= cache.bytes <= 2 * sum(held.values()) + 192 * KILOBYTE
    if not cache._results:
        # Scenes of costs compare levels in the background; *Your own body* compiles its equations first.
        for task in state.work.todo:
            cache.get(task.function, *task.arguments)
        scene.compute(scene.defaults(), scene.pictures, False)
    arrays = [array for result in cache._results.values() for array in arrays_in(result)]
    assert len(arrays) > 1
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0
