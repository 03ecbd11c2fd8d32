"""Track compiled kernels, and start processes that compile missing kernels.  This module loads no scenes."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import hess_mechanics
from hess_mechanics.numerics.jit import CACHE_FOLDER, source_hash

KEEPS_KERNELS = CACHE_FOLDER is not None
"""False if no cache folder is writable; then every start compiles the kernels that it needs."""

# Numba stores kernels under the path of their source, so each installed copy of this version compiles its own.
_PLACE = hashlib.sha256(str(Path(hess_mechanics.__file__).parent).encode()).hexdigest()[:16]
_MARK = None if CACHE_FOLDER is None else CACHE_FOLDER / f"complete-{_PLACE}-{source_hash()}"


def all_compiled() -> bool:
    """Return whether the compiled kernels of all scenes are on disk."""
    return _MARK is not None and _MARK.exists()


def mark_all_compiled() -> None:
    """Record that all kernels are on disk for this version of `hess_mechanics` and Numba."""
    if _MARK is not None:
        # If the disk is full, the next start tries again.
        with suppress(OSError):
            _MARK.touch()


_COMPILER = """
import os
import threading

from hess_explorer.server.parent import end_with_stdin

threading.Thread(target=end_with_stdin, daemon=True).start()
if os.name == "posix":
    os.nice({patience})

{work}
"""


def compiler(work: str, patience: int = 0) -> subprocess.Popen[bytes]:
    """Start a process that compiles kernels; it ends with this process, or when its standard input is closed.

    Parameters
    ----------
    work : str
        Python statements that call the kernels.
    patience : int
        Increment of its "nice" value, which lowers its priority.

    Returns
    -------
    subprocess.Popen
        The process.  It does not inherit standard output, whose reader would wait for it too.
    """
    # Use a new session, so that Ctrl-C reaches only the server, which then closes the compiler's standard input.
    return subprocess.Popen(
        [sys.executable, "-c", _COMPILER.format(work=work, patience=patience)],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        start_new_session=True,
    )
