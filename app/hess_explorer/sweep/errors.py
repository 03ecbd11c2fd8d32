"""Exceptions of sweeps; each message names the problem and a remedy."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hess_mechanics.catalogue import NoValue
from hess_mechanics.errors import ModelError

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Interrupted", "NoValue", "OtherSweep", "StoreError", "WorkersLost"]


class OtherSweep(ModelError):
    """The store contains a different sweep."""


class StoreError(ModelError):
    """The store cannot be read or written."""


class WorkersLost(ModelError):
    """A cluster cannot be reached, its workers run another version, or they died on some pieces."""


class Interrupted(KeyboardInterrupt):
    """The sweep was stopped by Ctrl-C.

    Parameters
    ----------
    message : str
        How many cells are finished, and how to continue.
    dataset : xarray.Dataset
        The finished cells; all other cells have the status 0, "not computed".
    """

    def __init__(self, message: str, dataset: xr.Dataset) -> None:
        super().__init__(message)
        self.dataset = dataset
