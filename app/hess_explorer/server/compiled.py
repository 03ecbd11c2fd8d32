"""Mark in the kernel cache when the kernels of all scenes are compiled.  This module imports only Numba."""

from __future__ import annotations

import hashlib
from contextlib import suppress
from pathlib import Path

import hess_mechanics
from hess_mechanics.numerics.jit import CACHE_FOLDER, source_hash

__all__ = ["KEEPS_KERNELS", "all_compiled", "mark_all_compiled"]

KEEPS_KERNELS = CACHE_FOLDER is not None
"""False if no cache folder is writable; then every start compiles the kernels that it needs."""

# Numba stores kernels under the path of their source, so a second copy of this version compiles its own.
_PLACE = hashlib.sha256(str(Path(hess_mechanics.__file__).parent).encode()).hexdigest()[:16]
_MARK = None if CACHE_FOLDER is None else CACHE_FOLDER / f"complete-{_PLACE}-{source_hash()}"


def all_compiled() -> bool:
    """Return True if the kernels of all scenes are on disk."""
    return _MARK is not None and _MARK.exists()


def mark_all_compiled() -> None:
    """Record that all kernels are on disk for this version of `hess_mechanics` and Numba."""
    if _MARK is not None:
        # If the disk is full, the next start tries again.
        with suppress(OSError):
            _MARK.touch()
