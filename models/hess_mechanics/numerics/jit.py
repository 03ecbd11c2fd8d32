"""How kernels are compiled: one decorator, and a cache that cannot go stale.

Numba looks only at the file of the compiled function when it decides whether its
cache is still valid.  Our kernels are assembled from several files, so the cache
folder is named by a hash of all of them (and of Numba's version): whatever changes,
the old cache is simply not looked at.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba

__all__ = ["CACHE_FOLDER", "inner", "kernel", "part"]

_OPTIONS: dict[str, Any] = {
    # NumPy's division lets LLVM vectorise; `contract` fuses a*b+c and nothing else, so
    # isnan and compensated sums keep their meaning (`fastmath=True` would break both).
    "error_model": "numpy",
    "fastmath": {"contract"},
    "nogil": True,
}


def _source_hash() -> str:
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(Path(__file__).parents[1].rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _writable_cache_folder() -> Path | None:
    """The first folder for compiled kernels that can be written, or None (then compile each time)."""
    chosen = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    home = Path("~").expanduser() / ".cache"
    for base in filter(None, (chosen, home, tempfile.gettempdir())):
        folder = Path(base) / "hess-explorer" / _source_hash()
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                return folder
        except OSError:
            continue
    return None


# Numba leaves LLVM's packing of straight-line arithmetic into vectors off; here it is worth a quarter of the time.
numba.config.SLP_VECTORIZE = 1

CACHE_FOLDER = _writable_cache_folder()
if CACHE_FOLDER is not None:
    numba.config.CACHE_DIR = str(CACHE_FOLDER)


def kernel(function: Callable[..., Any]) -> Any:
    """Compile an entry point: machine code is kept on disk and the GIL is released."""
    return numba.njit(cache=CACHE_FOLDER is not None, **_OPTIONS)(function)


def inner(function: Callable[..., Any]) -> Any:
    """Compile a building block; its machine code is kept as part of the kernels that call it."""
    return numba.njit(forceinline=True, **_OPTIONS)(function)


def part(function: Callable[..., Any]) -> Any:
    """As `inner`, for closures and generated functions, which only kernels call.

    It has no entry for Python, where a call would end the process, and is compiled a tenth sooner for that.
    """
    return numba.njit(forceinline=True, no_cpython_wrapper=True, no_cfunc_wrapper=True, **_OPTIONS)(function)
