"""Parameter sweeps: compute a quantity over one to three parameters, on one core or a cluster, resumable.

>>> from hess_explorer.sweep import sweep
>>> sweep("cos-chi", over={"I11": (1.0, 3.0, 5)}).cos_chi.shape
(5,)

`QUANTITIES` lists the quantities.  Requires the extra "sweep": pip install 'hess-explorer[sweep]'.
"""

from hess_explorer.sweep.errors import (
    Interrupted,
    NoValue,
    OtherSweep,
    StoreError,
    WorkersLost,
)
from hess_explorer.sweep.progress import Progress
from hess_explorer.sweep.quantities import QUANTITIES
from hess_explorer.sweep.quantity import Outcome, Quantity
from hess_explorer.sweep.result import read
from hess_explorer.sweep.run import explain, sweep
from hess_mechanics.errors import MissingLibrary

__all__ = [
    "QUANTITIES",
    "Interrupted",
    "MissingLibrary",
    "NoValue",
    "OtherSweep",
    "Outcome",
    "Progress",
    "Quantity",
    "StoreError",
    "WorkersLost",
    "explain",
    "read",
    "sweep",
]
