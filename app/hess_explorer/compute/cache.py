"""Process-wide cache of results, bounded in bytes; concurrent misses of one key share a computation."""

from __future__ import annotations

import dataclasses
import threading
from collections.abc import Callable, Hashable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Generic, ParamSpec, TypeVar, cast

import numpy as np
from cachetools import LRUCache

from hess_explorer.compute.budget import ClientGone, OverBudget, check

P = ParamSpec("P")
T_co = TypeVar("T_co", covariant=True)

_OVERHEAD, _NUMBER = 512, 64


def size_of(value: Any) -> int:
    """Return the size of a result in bytes: arrays in dataclasses, mappings, tuples and lists, plus overhead."""
    # Test for the most frequent type first.
    if type(value) is float:
        return _NUMBER
    if isinstance(value, np.ndarray):
        return value.nbytes + _OVERHEAD
    if isinstance(value, (tuple, list)):
        return _OVERHEAD + sum(size_of(item) for item in value)
    if isinstance(value, Mapping):
        return _OVERHEAD + sum(size_of(item) for item in value.values())
    if dataclasses.is_dataclass(value):
        return _OVERHEAD + sum(size_of(getattr(value, field.name)) for field in dataclasses.fields(value))
    return _NUMBER


@dataclass(frozen=True, init=False)
class Task(Generic[T_co]):
    """A deferred computation function(*arguments), whose result goes into the cache.

    Attributes
    ----------
    function : callable
        Pure function, which the cache identifies by its module and qualified name.
    arguments : tuple of hashable
        Positional arguments.
    """

    function: Callable[..., T_co]
    arguments: tuple[Hashable, ...]

    def __init__(self, function: Callable[P, T_co], *arguments: P.args, **none: P.kwargs) -> None:
        object.__setattr__(self, "function", function)
        object.__setattr__(self, "arguments", arguments)

    def compute(self) -> T_co:
        """Compute and return the result, bypassing the cache."""
        return self.function(*self.arguments)

    def get(self) -> T_co:
        """Return the result from the cache, computed now if it is not there.  Raises as `budget.check`."""
        return cast(T_co, CACHE.get(self.function, *self.arguments)[0])


class ResultCache:
    """Thread-safe LRU cache of results by function and arguments.

    Functions must be pure, arguments hashable and results frozen.  Errors are not cached.  They are raised in all
    threads that wait for the same result, except `ClientGone` and `OverBudget`: those threads then compute it again.

    Parameters
    ----------
    capacity : int
        Largest total size of the results, in bytes.

    Attributes
    ----------
    hits, misses : int
        Numbers of lookups that found a result, finished or under way, and of those that had to compute it.
    """

    def __init__(self, capacity: int) -> None:
        self.hits = 0
        self.misses = 0
        self._lock = threading.Lock()
        self._results: LRUCache[Hashable, Any] = LRUCache(capacity, getsizeof=size_of)
        self._running: dict[Hashable, Future[Any]] = {}

    def get(self, function: Callable[..., Any], *arguments: Hashable) -> tuple[Any, bool]:
        """Return (function(*arguments), hit); hit is False if this call computed the result.

        Raises as `budget.check` and as the function.
        """
        check()
        key = _key(function, arguments)
        with self._lock:
            if key in self._results:
                self.hits += 1
                return self._results[key], True
            own: Future[Any] = Future()
            running = self._running.setdefault(key, own)
            self.misses += running is own
            self.hits += running is not own
        if running is not own:
            try:
                return running.result(), True
            except (ClientGone, OverBudget):
                # The budget of another session ended, so compute the result here.
                return self.get(function, *arguments)
        try:
            value = function(*arguments)
        except BaseException as error:
            with self._lock:
                del self._running[key]
            own.set_exception(error)
            raise
        with self._lock:
            del self._running[key]
            # LRUCache raises ValueError for a result larger than the whole cache.
            with suppress(ValueError):
                self._results[key] = value
        own.set_result(value)
        return value, False

    def peek(self, function: Callable[..., Any], *arguments: Hashable) -> Any | None:
        """Return the cached result of function(*arguments), a hit, or None, which does not count as a miss."""
        key = _key(function, arguments)
        with self._lock:
            self.hits += key in self._results
            return self._results.get(key)

    @property
    def bytes(self) -> int:
        """The total size of the cached results in bytes."""
        return int(self._results.currsize)

    @property
    def lookups(self) -> int:
        """The number of hits and misses so far."""
        return self.hits + self.misses

    def metrics(self) -> dict[str, int]:
        """Return a consistent snapshot of the counters."""
        with self._lock:
            return {
                "cache_hits": self.hits,
                "cache_misses": self.misses,
                "cache_entries": len(self._results),
                "cache_bytes": self.bytes,
            }


def _key(function: Callable[..., Any], arguments: tuple[Hashable, ...]) -> Hashable:
    return function.__module__, function.__qualname__, arguments


CACHE = ResultCache(64 * 2**20)
