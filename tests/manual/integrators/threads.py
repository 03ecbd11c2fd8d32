"""Threads: libraries use one each; only deliberate work is shared between threads."""

import os
from concurrent.futures import ThreadPoolExecutor

_ONE_THREAD = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "PJRT_NPROC": "1",  # the pool of XLA
    "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false",
}


def one_each():
    """Tell the libraries to use one thread each.  They read this only when they are first imported."""
    os.environ.update(_ONE_THREAD)


def shared(part, threads):
    """A function that calls part(0), …, part(threads − 1), each in its own thread; directly if there is only one."""
    if threads == 1:
        return lambda: part(0)
    pool = ThreadPoolExecutor(threads)

    def run():
        list(pool.map(part, range(threads)))

    return run
