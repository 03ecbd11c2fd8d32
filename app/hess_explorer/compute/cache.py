"""The process-wide cache of results: bounded by bytes, one computation for concurrent misses."""

from __future__ import annotations

import dataclasses
import threading
from collections.abc import Callable, Hashable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from cachetools import LRUCache

from hess_explorer.compute.budget import Abandoned, OverBudget, check

__all__ = ["CACHE", "ResultCache", "Task", "size_of"]

_OVERHEAD, _NUMBER = 512, 64


def size_of(value: Any) -> int:
    """Bytes held by a result: its arrays, nested in dataclasses, mappings and tuples, and an overhead for each."""
    # First what there is most of.
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


@dataclass(frozen=True)
class Task:
    """A computation that can wait: function(*arguments), its result for the cache."""

    function: Callable[..., Any]
    arguments: tuple[Hashable, ...]

    def now(self) -> Any:
        """The result, computed here and now, whatever the cache has."""
        return self.function(*self.arguments)


class ResultCache:
    """Results by function and arguments; the least recently used are dropped first.

    Safe to use from several threads.  Functions must be pure, arguments hashable, results frozen.
    A computation that raises is not kept; all who waited for it get the error.
    """

    def __init__(self, capacity: int) -> None:
        self.hits = 0
        self.misses = 0
        self._lock = threading.Lock()
        self._results: LRUCache[Hashable, Any] = LRUCache(capacity, getsizeof=size_of)
        self._running: dict[Hashable, Future[Any]] = {}

    def get(self, function: Callable[..., Any], *arguments: Hashable) -> tuple[Any, bool]:
        """Return function(*arguments), and whether it was there already.  Raises as `budget.check`."""
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
            except (Abandoned, OverBudget):
                # That was the end of another session's budget.
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
            # A result larger than the whole cache is not kept.
            with suppress(ValueError):
                self._results[key] = value
        own.set_result(value)
        return value, False

    def peek(self, function: Callable[..., Any], *arguments: Hashable) -> Any | None:
        """Return function(*arguments) if it is there, which counts as a hit; else None."""
        key = _key(function, arguments)
        with self._lock:
            self.hits += key in self._results
            return self._results.get(key)

    @property
    def bytes(self) -> int:
        """How much is held."""
        return int(self._results.currsize)

    @property
    def asked(self) -> int:
        """How many results have been asked for."""
        return self.hits + self.misses

    def metrics(self) -> dict[str, int]:
        """The counters, all of one moment."""
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
