"""The process-wide cache of results: bounded by bytes, one computation for concurrent misses."""

from __future__ import annotations

import dataclasses
import logging
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_explorer.compute.budget import Abandoned, OverBudget, check

__all__ = ["CACHE", "ResultCache", "Task", "size_of"]

logger = logging.getLogger("hess_explorer")

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
        self.capacity = capacity
        self.bytes = 0
        self.hits = 0
        self.misses = 0
        self._lock = threading.Lock()
        self._entries: OrderedDict[Hashable, tuple[Future[Any], int]] = OrderedDict()

    def get(self, function: Callable[..., Any], *arguments: Hashable) -> tuple[Any, bool]:
        """The result of function(*arguments), and whether it was there already.  Raises as `budget.check`."""
        check()
        key = _key(function, arguments)
        with self._lock:
            entry = self._entries.get(key)
            if entry is not None:
                self.hits += 1
                self._entries.move_to_end(key)
                future = entry[0]
            else:
                self.misses += 1
                future = Future()
                self._entries[key] = (future, 0)
        if entry is not None:
            try:
                return future.result(), True
            except (Abandoned, OverBudget):
                # That was the end of another session's budget.
                return self.get(function, *arguments)
        try:
            value = function(*arguments)
        except BaseException as error:
            with self._lock:
                self._entries.pop(key, None)
            future.set_exception(error)
            raise
        size = size_of(value)
        with self._lock:
            # The entry may have been dropped during the computation: then it is not counted.
            if key in self._entries:
                self._entries[key] = (future, size)
                self.bytes += size
                self._shrink()
        future.set_result(value)
        return value, False

    def peek(self, function: Callable[..., Any], *arguments: Hashable) -> Any | None:
        """The result of function(*arguments) if it is there, which counts as a hit; else None."""
        key = _key(function, arguments)
        with self._lock:
            entry = self._entries.get(key)
            if entry is None or not entry[0].done() or entry[0].exception() is not None:
                return None
            self.hits += 1
            self._entries.move_to_end(key)
            return entry[0].result()

    @property
    def asked(self) -> int:
        """How many results have been asked for."""
        return self.hits + self.misses

    def metrics(self) -> dict[str, int]:
        """The counters, all of one moment."""
        with self._lock:
            return {"cache_hits": self.hits, "cache_misses": self.misses, "cache_entries": len(self._entries),
                    "cache_bytes": self.bytes}

    def _shrink(self) -> None:
        while self.bytes > self.capacity and self._entries:
            _, (_, size) = self._entries.popitem(last=False)
            self.bytes -= size


def _key(function: Callable[..., Any], arguments: tuple[Hashable, ...]) -> Hashable:
    return function.__module__, function.__qualname__, arguments


CACHE = ResultCache(64 * 2**20)

