"""Workers of a sweep: this thread, processes of this machine, or the workers of a Dask cluster.

Processes and cluster share one code path.  A local cluster in place of processes would add a scheduler process and more
overhead per piece than a pipe.
"""

from __future__ import annotations

import os
import queue
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError, Future
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Protocol, TypeAlias, TypeGuard

from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.grid import Box
from hess_explorer.sweep.processes import processes
from hess_explorer.sweep.work import Chunk, ChunkResult, compute
from hess_mechanics.errors import InvalidParameter, MissingLibrary

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["WorkerCount", "Workers", "crew"]

WorkerCount: TypeAlias = "str | int | Client | None"
"""None for this thread, "all" for a process per core, a number of processes, or the address or a client of a Dask
scheduler."""

Chunks = Iterable[tuple[Box, Chunk]]

_WAIT = 60.0
"""Timeout in seconds for the cluster to respond with at least one worker."""
_LOOK = 0.2
"""Interval in seconds for checking the stop flag."""
_COUNT_AGAIN = 5.0
"""Interval in seconds for counting the workers."""
_AHEAD = 3
"""Queued pieces per worker, so that no worker is idle."""


class Workers(Protocol):
    """A group of workers."""

    @property
    def size(self) -> int:
        """The number of workers."""

    def run(self, pieces: Chunks, stopped: Callable[[], bool]) -> Iterator[tuple[Box, ChunkResult]]:
        """Yield the results of the pieces in any order, until `stopped`.  Raises `WorkersLost`."""


class _ThisThread:
    """This thread as the only worker."""

    size = 1

    def run(self, pieces: Chunks, stopped: Callable[[], bool]) -> Iterator[tuple[Box, ChunkResult]]:
        for box, piece in pieces:
            if stopped():
                return
            yield box, compute(piece)


class _ExternalWorkers:
    """Workers outside of this process; submit : queues a piece; count : returns the number of workers."""

    def __init__(self, submit: Callable[[Chunk], Future[ChunkResult]], count: Callable[[], int]) -> None:
        self._submit, self._count = submit, count
        self.size = max(1, count())

    def run(self, pieces: Chunks, stopped: Callable[[], bool]) -> Iterator[tuple[Box, ChunkResult]]:
        waiting: dict[Future[ChunkResult], Box] = {}
        finished: queue.SimpleQueue[Future[ChunkResult]] = queue.SimpleQueue()
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
                # Several workers died on this piece, or a worker could not read it; the other pieces go on.
                except Exception as error:
                    lost.append(error)
                    continue
                yield box, done
        finally:
            for future in waiting:
                future.cancel()
        if lost:
            raise WorkersLost(f"{len(lost)} pieces failed; reason of the first: {_sentence(lost[0])}")


def _sentence(error: BaseException) -> str:
    message = " ".join(str(error).split()).rstrip(".")
    return f"{type(error).__name__}: {message[:300]}."


def _gone() -> WorkersLost:
    return WorkersLost("The cluster has stopped responding: restart it.")


@contextmanager
def crew(workers: WorkerCount, stopped: Callable[[], bool]) -> Iterator[Workers]:
    """Yield the workers, after waiting for them until `stopped`.  Raises `InvalidParameter`, `WorkersLost`."""
    wanted = _cores() if workers == "all" else workers
    if wanted is None or wanted == 1:
        yield _ThisThread()
        return
    with ExitStack() as stack:
        if isinstance(wanted, int) and not isinstance(wanted, bool):
            if not 1 <= wanted <= 4 * _cores():
                raise InvalidParameter(
                    f"This machine has {_cores()} cores: choose 1 to {4 * _cores()} workers, or "
                    "the address of a Dask cluster."
                )
            count = wanted
            yield _ExternalWorkers(stack.enter_context(processes(count)), lambda: count)
            return
        if isinstance(wanted, str):
            client = _connected(stack, wanted)
        elif _is_client(wanted):
            client = wanted
        else:
            raise InvalidParameter(
                f"{wanted!r} are no workers: give a number, all, the address of a Dask scheduler, or a Client that is "
                "not asynchronous."
            )
        _wait_for_a_worker(client, stopped)
        executor = client.get_executor(pure=False)
        stack.callback(executor.shutdown, wait=False)
        yield _ExternalWorkers(lambda piece: executor.submit(compute, piece), lambda: _threads(client))


def _threads(client: Client) -> int:
    try:
        return sum(client.nthreads().values())
    except (OSError, TimeoutError) as error:
        raise _gone() from error


def _connected(stack: ExitStack, address: str) -> Client:
    """Return a client of a scheduler.  Raises `InvalidParameter`, `MissingLibrary`, `WorkersLost`."""
    if "://" not in address:
        raise InvalidParameter(
            f"{address!r} is not the address of a Dask scheduler: write it like tcp://host:8786, or all."
        )
    try:
        from distributed import Client
    except ImportError as error:
        raise MissingLibrary("A cluster needs Dask: pip install 'hess-explorer[sweep]'.") from error
    try:
        return stack.enter_context(Client(address, timeout=_WAIT, set_as_default=False))
    # Without certificates Dask raises these for tls://.
    except (TypeError, RuntimeError) as error:
        raise InvalidParameter(
            f"{address} cannot be used ({error}): set the certificates in Dask's configuration, or pass a Client."
        ) from error
    except (OSError, TimeoutError, ValueError) as error:
        raise _none_answered(address) from error


def _is_client(workers: object) -> TypeGuard[Client]:
    # A client exists only if Dask has been imported.
    dask = sys.modules.get("distributed")
    return dask is not None and isinstance(workers, dask.Client) and not workers.asynchronous


def _wait_for_a_worker(client: Client, stopped: Callable[[], bool]) -> None:
    """Wait until the scheduler has a worker, or until `stopped`.  Raises `WorkersLost`."""
    latest = time.monotonic() + _WAIT
    try:
        while not client.nthreads() and not stopped():
            if time.monotonic() > latest:
                raise TimeoutError
            time.sleep(_LOOK)
    except (OSError, TimeoutError, ValueError) as error:
        raise _none_answered(client.scheduler.address) from error


def _none_answered(address: str) -> WorkersLost:
    return WorkersLost(
        f"No Dask scheduler with a worker answered at {address} within {_WAIT:g} s: "
        "start one with `dask scheduler`, and workers with `dask worker`."
    )


def _cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
