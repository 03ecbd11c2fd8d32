"""A Dask cluster on this machine, as an address."""

import os
import subprocess
import sys
from contextlib import contextmanager

from distributed import LocalCluster


@contextmanager
def local_cluster(processes):
    """Yield the address of a cluster with this many single-threaded workers; 0: a scheduler alone."""
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
        **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"),
    }
    quiet = {"dashboard": False, "dashboard_address": "127.0.0.1:0"}
    with LocalCluster(n_workers=0, host="127.0.0.1", scheduler_kwargs=quiet, silence_logs="ERROR") as cluster:
        if not processes:
            yield cluster.scheduler_address
            return
        # As on a cluster they are programs of their own; those of LocalCluster import the main script again.
        command = [
            sys.executable,
            "-m",
            "dask",
            "worker",
            cluster.scheduler_address,
            "--nworkers",
            str(processes),
            "--nthreads",
            "1",
            "--memory-limit",
            "0",
            "--host",
            "127.0.0.1",
            "--no-dashboard",
            "--dashboard-address",
            "127.0.0.1:0",
            "--death-timeout",
            "30",
        ]
        workers = subprocess.Popen(
            command,
            env=environment,
            start_new_session=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            yield cluster.scheduler_address
        finally:
            workers.terminate()
            try:
                workers.wait(timeout=10.0)
            except subprocess.TimeoutExpired:
                workers.kill()
                workers.wait()
