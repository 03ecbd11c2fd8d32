"""Parameter sweeps: compute a quantity over one to three parameters, on one core or a cluster, resumable.

>>> from hess_explorer.sweep import sweep
>>> sweep("cos-chi", over={"I11": (1.0, 3.0, 5)}).cos_chi.shape
(5,)

`QUANTITIES` lists the quantities; a function of your own is swept in the same way.  Requires the extra "sweep": pip
install 'hess-explorer[sweep]'.
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
from hess_explorer.sweep.run import explain, sweep
from hess_explorer.sweep.store import StoreStatus, read, store_status
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
    "StoreStatus",
    "WorkersLost",
    "explain",
    "read",
    "store_status",
    "sweep",
]
