"""A sweep on workers that dask-jobqueue starts as Slurm jobs: pip install dask-jobqueue 'hess-explorer[sweep]'."""

from dask_jobqueue import SLURMCluster
from distributed import Client

from hess_explorer.sweep import sweep

if __name__ == "__main__":
    with SLURMCluster(cores=1, processes=1, memory="2GB", walltime="01:00:00") as cluster, Client(cluster) as client:
        cluster.scale(jobs=40)
        chart = sweep(
            "rotation-number",
            over={"h": (-0.9, 2.0, 300), "f": (-1.5, 1.5, 200)},
            a=0.5,
            workers=client,
            store="rho.zarr",
        )
        print(chart)
