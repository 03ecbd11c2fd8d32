"""Parameter sweeps: compute numbers over one to three parameters, on one core or a cluster, resumable.

>>> from hess_explorer.sweep import sweep
>>> sweep("circle-map", over={"h": (1.2, 1.6, 5)}).rotation_number.shape
(5,)

The catalogue of `hess_mechanics` has the computations; a function of your own is swept in the same way.  Requires the
extra "sweep": pip install 'hess-explorer[sweep]'.
"""

from hess_explorer.compute.cells import Outcome
from hess_explorer.sweep.errors import Interrupted, NoValue, OtherSweep, StoreError, WorkersLost
from hess_explorer.sweep.progress import Progress
from hess_explorer.sweep.run import explain, sweep
from hess_explorer.sweep.store import read
from hess_mechanics.errors import MissingLibrary

__all__ = [
    "Interrupted",
    "MissingLibrary",
    "NoValue",
    "OtherSweep",
    "Outcome",
    "Progress",
    "StoreError",
    "WorkersLost",
    "explain",
    "read",
    "sweep",
]
