"""Compiled kernels on disk: what of them cannot be read or written is compiled anew, and costs time and nothing else.

Numba takes for granted that its files are whole and that the disk has room.  A computer that lost its power leaves
files cut short, a full disk takes none, and of two processes that write at once the index of one may name a file of the
other.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from numba.core import sigutils
from numba.core.caching import FunctionCache

__all__ = ["KernelFiles", "keep"]


class KernelFiles(FunctionCache):  # type: ignore[misc]  # numba has no types
    """Numba's cache of one kernel, which never fails."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kernel for these types of arguments; None where there is none that can be read."""
        try:
            found = super().load_overload(sig, target_context)
        # What is read is unpickled: half a file may raise anything.
        except Exception:
            # Else the index would stay as it is, and nothing could be added to it.
            with suppress(OSError):
                self.flush()
            return None
        # Called with other types than it was compiled for, it would read wherever they happen to lead.
        if found is not None and tuple(found.signature.args) != tuple(sigutils.normalize_signature(sig)[0]):
            return None
        return found

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep a kernel, where there is room."""
        try:
            super().save_overload(sig, data)
        except OSError:
            # What the index names and was not written is compiled again, and so written once there is room.
            return
        except Exception:
            # The index of this kernel cannot be read.
            with suppress(OSError):
                self.flush()


def keep(dispatcher: Any, folder: Path) -> Callable[..., Any]:
    """The kernel, its machine code kept below this folder, for which Numba's `CACHE_DIR` has to be set.

    The attribute is what `njit(cache=True)` sets: Numba has no public way to choose another class.
    """
    if not hasattr(dispatcher, "py_func"):
        # NUMBA_DISABLE_JIT: it is the function itself.
        return dispatcher  # type: ignore[no-any-return]
    try:
        files = KernelFiles(dispatcher.py_func)
    except (OSError, RuntimeError):
        # No place that can be written: it is compiled in each process.
        return dispatcher  # type: ignore[no-any-return]
    # Where that folder cannot be written Numba looks for others, which may be stale or somebody else's.
    if Path(files.cache_path).is_relative_to(folder):
        dispatcher._cache = files
    return dispatcher  # type: ignore[no-any-return]
