"""Who computes: this thread, processes of this machine, or the workers of a Dask cluster.

The last two are the same: a cluster at an address.  That of this machine has a scheduler in this process, and workers
in processes of their own that come back when they die, and end by themselves when this process is gone.
"""

from __future__ import annotations

import os
import queue
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError, Future
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Protocol

from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.grid import Box
from hess_explorer.sweep.work import Done, Piece, compute
from hess_mechanics.errors import InvalidParameter

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["Crew", "Workers", "crew", "here", "local_cluster"]

Workers = str | int | None
"""None: this thread; "all": a process for each core; a number of processes; the address of a Dask scheduler."""

Pieces = Iterable[tuple[Box, Piece]]

_WAIT = 60.0
"""Seconds that a cluster has to answer, and a worker to appear."""
_LOOK = 0.2
"""Seconds after which it is asked whether to stop."""
_COUNT_AGAIN = 5.0
"""Seconds after which the workers are counted again."""
_AHEAD = 3
"""Pieces that a cluster knows of, for each of its threads: the next one is there when one is done."""


class Crew(Protocol):
    """Those who compute pieces."""

    @property
    def size(self) -> int:
        """How many at a time."""

    def run(self, pieces: Pieces, stopped: Callable[[], bool]) -> Iterator[tuple[Box, Done]]:
        """Each piece's outcome as it is done, in any order, until `stopped`.  Raises `WorkersLost`."""


class _Here:
    size = 1

    def run(self, pieces: Pieces, stopped: Callable[[], bool]) -> Iterator[tuple[Box, Done]]:
        for box, piece in pieces:
            if stopped():
                return
            yield box, compute(piece)


def here() -> Crew:
    """This thread alone."""
    return _Here()


class _Cluster:
    def __init__(self, client: Client) -> None:
        self._client = client
        self.size = max(1, self._threads())

    def _threads(self) -> int:
        try:
            return sum(self._client.nthreads().values())
        except (OSError, TimeoutError) as error:
            raise _gone() from error

    def run(self, pieces: Pieces, stopped: Callable[[], bool]) -> Iterator[tuple[Box, Done]]:
        waiting: dict[Future[Done], Box] = {}
        finished: queue.SimpleQueue[Future[Done]] = queue.SimpleQueue()
        executor = self._client.get_executor(pure=False)
        left = iter(pieces)
        counted = time.monotonic()
        lost: list[BaseException] = []
        try:
            while not stopped():
                if time.monotonic() > counted + _COUNT_AGAIN:
                    self.size, counted = self._threads() or self.size, time.monotonic()
                while len(waiting) < _AHEAD * self.size and (following := next(left, None)) is not None:
                    future = executor.submit(compute, following[1])
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
            executor.shutdown(wait=False)
        if lost:
            raise WorkersLost(f"{len(lost)} pieces were given up, the first because: {_sentence(lost[0])}")


def _sentence(error: BaseException) -> str:
    said = " ".join(str(error).split()).rstrip(".")
    return f"{type(error).__name__}: {said[:300]}."


def _gone() -> WorkersLost:
    return WorkersLost("The cluster does not answer any more: start it again.")


@contextmanager
def local_cluster(processes: int) -> Iterator[str]:
    """The address of a cluster of so many workers on this machine, of one thread each; 0: a scheduler alone."""
    from distributed import LocalCluster

    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
                   # One thread each, in their libraries too.
                   **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")}
    # It listens to this machine alone, its pages too, which by default are for all hosts.
    quiet = {"dashboard": False, "dashboard_address": "127.0.0.1:0"}
    with LocalCluster(n_workers=0, host="127.0.0.1", scheduler_kwargs=quiet, silence_logs="ERROR") as cluster:
        # Not workers of LocalCluster: those import the main script again, which must be written for that.  In a session
        # of their own Ctrl-C does not reach them.
        command = [sys.executable, "-m", "dask", "worker", cluster.scheduler_address, "--nworkers", str(processes),
                   "--nthreads", "1", "--memory-limit", "0", "--host", "127.0.0.1", "--no-dashboard",
                   "--dashboard-address", "127.0.0.1:0", "--death-timeout", "30"]
        if not processes:
            yield cluster.scheduler_address
            return
        workers = subprocess.Popen(command, env=environment, start_new_session=True, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            yield cluster.scheduler_address
        finally:
            workers.terminate()
            try:
                workers.wait(timeout=10.0)
            except subprocess.TimeoutExpired:
                workers.kill()
                workers.wait()


@contextmanager
def crew(workers: Workers, stopped: Callable[[], bool]) -> Iterator[Crew]:
    """Who computes; it waits for workers until `stopped`.  Raises `InvalidParameter`, `WorkersLost`."""
    if workers is None or workers == 1:
        yield here()
        return
    with ExitStack() as stack:
        address, wanted = workers, 1
        if workers == "all":
            wanted = _cores()
            address = stack.enter_context(local_cluster(wanted))
        elif isinstance(workers, int) and not isinstance(workers, bool):
            if not 1 <= workers <= 4 * _cores():
                raise InvalidParameter(f"This machine has {_cores()} cores: choose 1 to {4 * _cores()} workers, or "
                                       "the address of a Dask cluster.")
            wanted = workers
            address = stack.enter_context(local_cluster(wanted))
        yield _Cluster(_connected(stack, str(address), wanted, stopped))


def _connected(stack: ExitStack, address: str, wanted: int, stopped: Callable[[], bool]) -> Client:
    """A client of the scheduler there, when so many workers have come.  Raises `InvalidParameter`, `WorkersLost`."""
    from distributed import Client

    if "://" not in address:
        raise InvalidParameter(f"{address!r} is no address of a Dask scheduler: write it like tcp://host:8786, or all.")
    latest = time.monotonic() + _WAIT
    try:
        client = stack.enter_context(Client(address, timeout=_WAIT, set_as_default=False))
        while len(client.nthreads()) < wanted and not stopped():
            if time.monotonic() > latest:
                raise TimeoutError
            time.sleep(_LOOK)
    except (OSError, TimeoutError, ValueError) as error:
        raise WorkersLost(f"At {address} no Dask scheduler with {wanted} or more workers answers within {_WAIT:g} s: "
                          "start one with `dask scheduler`, and workers with `dask worker`.") from error
    return client


def _cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
