"""Who computes: this thread, processes of this machine, or the workers of a Dask cluster.

The last two are one code path from the pieces to what is kept.  A cluster on this machine would be one more process
that computes nothing, and takes longer over a piece than a pipe to a process does.
"""

from __future__ import annotations

import os
import queue
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError, Future
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Protocol

from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.grid import Box
from hess_explorer.sweep.processes import processes
from hess_explorer.sweep.work import Chunk, Done, compute
from hess_mechanics.errors import InvalidParameter, MissingLibrary

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["Crew", "WorkerCount", "crew"]

WorkerCount = str | int | None
"""None: this thread; "all": a process for each core; a number of processes; the address of a Dask scheduler."""

Chunks = Iterable[tuple[Box, Chunk]]

_WAIT = 60.0
"""Seconds that a cluster has to answer, and a worker to appear."""
_LOOK = 0.2
"""Seconds after which it is asked whether to stop."""
_COUNT_AGAIN = 5.0
"""Seconds after which the workers are counted again."""
_AHEAD = 3
"""Pieces that are handed out, for each who computes: the next one is there when one is done."""


class Crew(Protocol):
    """Those who compute pieces."""

    @property
    def size(self) -> int:
        """How many at a time."""

    def run(self, pieces: Chunks, stopped: Callable[[], bool]) -> Iterator[tuple[Box, Done]]:
        """Each piece's outcome as it is done, in any order, until `stopped`.  Raises `WorkersLost`."""


class _Here:
    """This thread alone."""

    size = 1

    def run(self, pieces: Chunks, stopped: Callable[[], bool]) -> Iterator[tuple[Box, Done]]:
        for box, piece in pieces:
            if stopped():
                return
            yield box, compute(piece)


class _Others:
    """`count` says how many there are, `submit` has a piece computed."""

    def __init__(self, submit: Callable[[Chunk], Future[Done]], count: Callable[[], int]) -> None:
        self._submit, self._count = submit, count
        self.size = max(1, count())

    def run(self, pieces: Chunks, stopped: Callable[[], bool]) -> Iterator[tuple[Box, Done]]:
        waiting: dict[Future[Done], Box] = {}
        finished: queue.SimpleQueue[Future[Done]] = queue.SimpleQueue()
        left = iter(pieces)
        counted = time.monotonic()
        lost: list[BaseException] = []
        try:
            while not stopped():
                if time.monotonic() > counted + _COUNT_AGAIN:
                    self.size, counted = self._count() or self.size, time.monotonic()
                while len(waiting) < _AHEAD * self.size and (following := next(left, None)) is not None:
                    future = self._submit(following[1])
                    waiting[future] = following[0]
                    future.add_done_callback(finished.put)
                if not waiting:
                    break
                try:
                    future = finished.get(timeout=_LOOK)
                except queue.Empty:
                    continue
                box = waiting.pop(future)
                try:
                    done = future.result()
                except WorkersLost:
                    raise
                except CancelledError as error:
                    raise _gone() from error
                # A piece that several workers died of, or that a worker could not even read; the others go on.
                except Exception as error:
                    lost.append(error)
                    continue
                yield box, done
        finally:
            for future in waiting:
                future.cancel()
        if lost:
            raise WorkersLost(f"{len(lost)} pieces were given up, the first because: {_sentence(lost[0])}")


def _sentence(error: BaseException) -> str:
    said = " ".join(str(error).split()).rstrip(".")
    return f"{type(error).__name__}: {said[:300]}."


def _gone() -> WorkersLost:
    return WorkersLost("The cluster does not answer any more: start it again.")


@contextmanager
def crew(workers: WorkerCount, stopped: Callable[[], bool]) -> Iterator[Crew]:
    """Who computes; it waits for workers until `stopped`.  Raises `InvalidParameter`, `WorkersLost`."""
    wanted = _cores() if workers == "all" else workers
    if wanted is None or wanted == 1:
        yield _Here()
        return
    with ExitStack() as stack:
        if isinstance(wanted, int) and not isinstance(wanted, bool):
            if not 1 <= wanted <= 4 * _cores():
                raise InvalidParameter(
                    f"This machine has {_cores()} cores: choose 1 to {4 * _cores()} workers, or "
                    "the address of a Dask cluster."
                )
            count = wanted
            yield _Others(stack.enter_context(processes(count)), lambda: count)
            return
        client = _connected(stack, str(wanted), stopped)
        executor = client.get_executor(pure=False)
        stack.callback(executor.shutdown, wait=False)
        yield _Others(lambda piece: executor.submit(compute, piece), lambda: _threads(client))


def _threads(client: Client) -> int:
    try:
        return sum(client.nthreads().values())
    except (OSError, TimeoutError) as error:
        raise _gone() from error


def _connected(stack: ExitStack, address: str, stopped: Callable[[], bool]) -> Client:
    """A client of the scheduler there, when a worker has come.

    Raises `InvalidParameter`, `MissingLibrary`, `WorkersLost`.
    """
    if "://" not in address:
        raise InvalidParameter(f"{address!r} is no address of a Dask scheduler: write it like tcp://host:8786, or all.")
    try:
        from distributed import Client
    except ImportError as error:
        raise MissingLibrary("A cluster needs Dask: pip install 'hess-explorer[sweep]'.") from error
    latest = time.monotonic() + _WAIT
    try:
        client = stack.enter_context(Client(address, timeout=_WAIT, set_as_default=False))
        while not client.nthreads() and not stopped():
            if time.monotonic() > latest:
                raise TimeoutError
            time.sleep(_LOOK)
    except (OSError, TimeoutError, ValueError) as error:
        raise WorkersLost(
            f"At {address} no Dask scheduler with a worker answers within {_WAIT:g} s: "
            "start one with `dask scheduler`, and workers with `dask worker`."
        ) from error
    return client


def _cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
