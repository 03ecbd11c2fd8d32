"""Workers of a sweep: this thread, or those of a Dask cluster, by default one of processes of this machine."""

from __future__ import annotations

import os
import queue
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.piece import PieceResult, compute, compute_sent, sendable
from hess_explorer.sweep.plan import Plan, Region, version
from hess_mechanics.errors import InvalidParameter, MissingLibrary

if TYPE_CHECKING:
    from distributed import Client, Future

__all__ = ["connected", "results", "size"]

_WAIT = 60.0
"""Timeout in seconds for the cluster to respond with at least one worker."""
_LOOK = 0.2
"""Interval in seconds for checking the stop flag."""
_AHEAD = 3
"""Queued pieces per worker, so that no worker is idle."""


def size(client: Client | None) -> int:
    """Return the number of workers of a cluster, 1 for this thread.  Raises `WorkersLost`."""
    try:
        return 1 if client is None else max(1, sum(client.nthreads().values()))
    except (OSError, TimeoutError) as error:
        raise WorkersLost("The cluster has stopped responding: restart it.") from error


def results(
    client: Client | None, plan: Plan, regions: Iterable[Region], stopped: Callable[[], bool]
) -> Iterator[tuple[Region, PieceResult]]:
    """Yield the results of the pieces in any order, until `stopped`.  Raises `WorkersLost`."""
    if client is None:
        for region in regions:
            if stopped():
                return
            yield region, compute(plan.part(region))
        return
    content, left = sendable(plan), iter(regions)
    waiting: dict[Future[PieceResult], Region] = {}
    finished: queue.SimpleQueue[Future[PieceResult]] = queue.SimpleQueue()
    lost: list[str] = []
    try:
        while not stopped():
            while len(waiting) < _AHEAD * size(client) and (region := next(left, None)) is not None:
                future = client.submit(compute_sent, content, version(), plan.part(region).axes, pure=False)
                waiting[future] = region
                future.add_done_callback(finished.put)
            if not waiting:
                break
            try:
                future = finished.get(timeout=_LOOK)
            except queue.Empty:
                continue
            region = waiting.pop(future)
            try:
                done = future.result()
            except WorkersLost:
                raise
            # Several workers died on this piece, or a worker could not read it; the other pieces go on.
            except Exception as error:
                lost.append(f"{type(error).__name__}: {' '.join(str(error).split()).rstrip('.')[:300]}.")
                continue
            yield region, done
    finally:
        client.cancel(list(waiting))
    if lost:
        raise WorkersLost(f"{len(lost)} pieces failed; reason of the first: {lost[0]}")


@contextmanager
def connected(workers: str | int | None, scheduler: str | Client | None) -> Iterator[Client | None]:
    """Yield a client of the workers, None for this thread.  Raises `InvalidParameter`, `WorkersLost`."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    count = cores if workers == "all" else 1 if workers is None else workers
    if isinstance(count, bool) or not isinstance(count, int) or not 1 <= count <= 4 * cores:
        raise InvalidParameter(f"This machine has {cores} cores: choose all or 1 to {4 * cores} workers.")
    if scheduler is None and count == 1:
        yield None
        return
    if scheduler is not None and workers is not None:
        raise InvalidParameter("A scheduler has workers of its own: leave out workers.")
    try:
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise MissingLibrary("Workers need Dask: pip install 'hess-explorer[sweep]'.") from error
    if isinstance(scheduler, Client):
        yield scheduler
        return
    if scheduler is not None and "://" not in str(scheduler):
        raise InvalidParameter(f"{scheduler!r} is not a Dask scheduler: write its address like tcp://host:8786.")
    with ExitStack() as stack:
        try:
            at = scheduler or stack.enter_context(
                LocalCluster(
                    n_workers=count,
                    threads_per_worker=1,
                    host="127.0.0.1",
                    memory_limit=0,
                    dashboard_address=None,
                    silence_logs="CRITICAL",
                )
            )
            client = stack.enter_context(Client(at, timeout=_WAIT, set_as_default=False))
            client.wait_for_workers(1, timeout=_WAIT)
        except (OSError, TimeoutError, ValueError) as error:
            raise WorkersLost(
                f"No Dask scheduler with a worker answered at {scheduler} within {_WAIT:g} s: start one with "
                "`dask scheduler`, and workers with `dask worker`."
            ) from error
        # Without certificates Dask raises these for tls://.
        except (TypeError, RuntimeError) as error:
            raise InvalidParameter(
                f"The workers cannot be used ({error}): in a script call `sweep` below `if __name__ == '__main__':`, "
                "for tls:// set the certificates in Dask's configuration or pass a Client."
            ) from error
        yield client
