"""Kernel cache on disk that never fails: a file that cannot be read or written only costs a compilation.

Not for users.  Numba assumes that its files are complete and that the disk has room.  A power failure truncates files,
a full disk takes none, and if two processes write at once, the index of one may name a file of the other.  It also lets
two processes that start together compile each kernel twice.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from filelock import FileLock, Timeout
from numba.core import sigutils
from numba.core.caching import FunctionCache

__all__ = ["KernelFiles", "cache_on_disk", "release"]

PATIENCE = 60.0
"""Seconds to wait for another process that compiles the same kernel."""


class KernelFiles(FunctionCache):  # type: ignore[misc]  # numba has no types
    """Numba's cache of one kernel, without errors; one process compiles it, and others wait for it."""

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        self._path = Path(self.cache_path, f"{function.__name__}.lock")
        self._locks: dict[int, FileLock] = {}

    @property
    def _lock(self) -> FileLock:
        """The lock of the kernel in this process, because a lock from before a fork must not be used afterwards."""
        process = os.getpid()
        if process not in self._locks:
            self._locks[process] = FileLock(self._path, timeout=PATIENCE)
        return self._locks[process]

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the kernel for these argument types; wait up to a minute for another process that is compiling it.

        Returns None if no kernel can be read; then this process compiles it.
        """
        overload = self._read(sig, target_context)
        if overload is None:
            # Without a lock, each process compiles the kernel.
            with suppress(OSError, NotImplementedError, Timeout):
                self._lock.acquire()
            overload = self._read(sig, target_context)
            if overload is not None:
                self._lock.release()
        return overload

    def _read(self, sig: Any, target_context: Any) -> Any:
        try:
            overload = super().load_overload(sig, target_context)
        # Unpickling a truncated file may raise any exception.
        except Exception:
            # Clear the index, which would otherwise stay broken and accept no new kernels.
            with suppress(OSError):
                self.flush()
            return None
        # Reject a kernel compiled for other types, which would access arbitrary memory.
        if overload is not None and tuple(overload.signature.args) != tuple(sigutils.normalize_signature(sig)[0]):
            return None
        return overload

    def save_overload(self, sig: Any, data: Any) -> None:
        """Store a kernel, if there is room."""
        try:
            super().save_overload(sig, data)
        except OSError:
            # A kernel that is in the index but not on disk is compiled again, and stored once there is room.
            return
        except Exception:
            # The index of this kernel cannot be read.
            with suppress(OSError):
                self.flush()
        finally:
            self._lock.release(force=True)


def cache_on_disk(dispatcher: Any, folder: Path) -> Callable[..., Any]:
    """Return the kernel with its machine code cached below this folder; Numba's `CACHE_DIR` must be set to it.

    The attribute is the one that `njit(cache=True)` sets: Numba has no public way to choose another cache class.
    """
    if not hasattr(dispatcher, "py_func"):
        # With NUMBA_DISABLE_JIT, the dispatcher is the Python function itself.
        return dispatcher  # type: ignore[no-any-return]
    try:
        files = KernelFiles(dispatcher.py_func)
    except (OSError, RuntimeError):
        # Without a writable folder, each process compiles the kernel.
        return dispatcher  # type: ignore[no-any-return]
    # If the folder is not writable, Numba uses others, which may be outdated or belong to another user.
    if Path(files.cache_path).is_relative_to(folder):
        dispatcher._cache = files
    return dispatcher  # type: ignore[no-any-return]


def release(dispatcher: Any) -> None:
    """Let other processes compile a kernel whose compilation here has failed or was stopped."""
    files = getattr(dispatcher, "_cache", None)
    if isinstance(files, KernelFiles):
        files._lock.release(force=True)
