"""Workers of a sweep: this thread, processes of this machine, or the workers of a Dask cluster."""

from __future__ import annotations

import signal
from collections.abc import Generator, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from itertools import islice
from textwrap import shorten
from typing import TYPE_CHECKING, Any

from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.piece import PieceResult, compute, compute_sent, serialize
from hess_explorer.sweep.plan import Region, SweepPlan, version
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.arguments import as_integer

if TYPE_CHECKING:
    from distributed import Client, Worker

_WAIT = 60.0
"""Timeout in seconds for the cluster to respond with at least one worker."""
_AHEAD = 3
"""Queued pieces per worker, so that no worker is idle."""


def dask_setup(worker: Worker) -> None:
    """Let a worker of this machine ignore Ctrl-C in the terminal; the sweep stops it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def size(client: Client | None) -> int:
    """Return the number of worker threads of a cluster, at least 1; 1 without a cluster."""
    return 1 if client is None else max(1, sum(client.nthreads().values()))


def results(client: Client | None, plan: SweepPlan, regions: Iterable[Region]) -> Generator[tuple[Region, PieceResult]]:
    """Yield the regions and results of the pieces, in any order.

    Raises `WorkersLost` at once if a worker has another version, and at the end if some pieces failed;
    `InvalidParameter` if the plan cannot be pickled.
    """
    if client is None:
        for region in regions:
            yield region, compute(plan.part(region))
        return
    from distributed import as_completed

    content, left, lost = serialize(plan), iter(regions), []
    waiting: dict[Any, Region] = {}
    finished = as_completed(loop=client.loop)

    def submit() -> None:
        for region in islice(left, max(0, _AHEAD * size(client) - len(waiting))):
            future = client.submit(compute_sent, content, version(), plan.part(region).axes, pure=False)
            waiting[future] = region
            finished.add(future)

    submit()
    try:
        for future in finished:
            region = waiting.pop(future)
            submit()
            try:
                yield region, future.result()
            except WorkersLost:
                raise
            # Several workers died on this piece, or a worker could not read it; continue with the other pieces.
            except Exception as error:
                lost.append(f"{type(error).__name__}: {shorten(str(error), 200, placeholder=' …')}")
    finally:
        client.cancel(list(waiting))
    if lost:
        raise WorkersLost(f"{len(lost)} pieces failed; reason of the first: {lost[0]}")


@contextmanager
def connection(workers: str | int | None, scheduler: str | Client | None) -> Iterator[Client | None]:
    """Yield a client of the workers; None to compute in this thread.

    Parameters
    ----------
    workers : None, "all" or int
        Number of local processes, up to 1000; None or 1 for this thread, "all" for one per core.
    scheduler : str or Client, optional
        Address of a Dask scheduler, or a Client, which is yielded itself; `workers` is then not used.

    Raises
    ------
    WorkersLost
        If no worker responds.
    InvalidParameter
        If the number of workers is not allowed, or the workers cannot be used.
    """
    # Without a number, Dask starts one worker for each core of this process.
    count = None if workers == "all" else as_integer("workers", workers or 1, 1, 1000)
    if scheduler is None and count == 1:
        yield None
        return
    import dask.config
    from distributed import Client, LocalCluster

    if isinstance(scheduler, Client):
        yield scheduler
        return
    # Start no dashboard, because its port may be in use.
    quiet = {"dashboard": False, "dashboard_address": "127.0.0.1:0"}
    with ExitStack() as stack:
        # Disable Dask's profiler, which samples each worker a hundred times a second.
        stack.enter_context(dask.config.set({"distributed.worker.profile.enabled": False}))
        try:
            at = scheduler or stack.enter_context(
                LocalCluster(
                    n_workers=count,
                    threads_per_worker=1,
                    host="127.0.0.1",
                    memory_limit=0,
                    scheduler_kwargs=quiet,
                    silence_logs="CRITICAL",
                    preload=[__name__],
                )
            )
            client = stack.enter_context(Client(at, timeout=_WAIT, set_as_default=False))
            client.wait_for_workers(1, timeout=_WAIT)
        except (OSError, TimeoutError) as error:
            raise WorkersLost(
                f"No Dask scheduler with a worker responded at {scheduler} within {_WAIT:g} s: start one with "
                "`dask scheduler`, and workers with `dask worker`."
                if scheduler
                else f"The local workers did not start within {_WAIT:g} s: choose fewer workers, or workers=1."
            ) from error
        # Dask raises these errors in a script without `if __name__ == "__main__"`, and for tls:// without certificates.
        except (TypeError, RuntimeError) as error:
            raise InvalidParameter(
                f"The workers cannot be used ({error}): in a script, call `sweep` below `if __name__ == '__main__':`; "
                "for tls://, set the certificates in Dask's configuration or pass a Client."
            ) from error
        yield client
