"""Whether the kernels of all scenes are on disk: a mark beside them says so.  Imports no more than Numba."""

from __future__ import annotations

import hashlib
from contextlib import suppress
from pathlib import Path

import hess_mechanics
from hess_mechanics.numerics.jit import CACHE_FOLDER, source_hash

__all__ = ["KEEPS_KERNELS", "all_compiled", "mark_all_compiled"]

KEEPS_KERNELS = CACHE_FOLDER is not None
"""False where no folder can be written: then every start compiles what it needs."""

# Numba files kernels under the path of their source: a second copy of this version has to compile its own.
_PLACE = hashlib.sha256(str(Path(hess_mechanics.__file__).parent).encode()).hexdigest()[:16]
_MARK = None if CACHE_FOLDER is None else CACHE_FOLDER / f"complete-{_PLACE}-{source_hash()}"


def all_compiled() -> bool:
    """Whether a start only has to load kernels."""
    return _MARK is not None and _MARK.exists()


def mark_all_compiled() -> None:
    """Say so from now on, for this version of the mechanics and of Numba."""
    if _MARK is not None:
        # On a full disk the next start looks again.
        with suppress(OSError):
            _MARK.touch()
