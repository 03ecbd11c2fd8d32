"""What ends a sweep early, each with a sentence: what is wrong, what is allowed, what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hess_mechanics.errors import ModelError

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Interrupted", "NoValue", "OtherSweep", "StoreError", "WorkersLost"]


class NoValue(ModelError):
    """A cell whose motion does not have the quantity, as the period of one that never returns."""


class OtherSweep(ModelError):
    """A store that holds another sweep than the one that was asked for."""


class StoreError(ModelError):
    """A store that cannot be read or written."""


class WorkersLost(ModelError):
    """A cluster that cannot be reached, whose workers are of another version, or die of some chunks."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C.  `dataset` has what was computed, the status of all other cells is 0: "not computed"."""

    def __init__(self, said: str, dataset: xr.Dataset) -> None:
        super().__init__(said)
        self.dataset = dataset
