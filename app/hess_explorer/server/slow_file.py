"""Make a film or a page with sliders in a separate low-priority process that runs `hess-explorer export`."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from pathlib import Path

from hess_explorer.compute.budget import Abandoned
from hess_mechanics.errors import InvalidParameter, WorkLimit

__all__ = ["LONGEST", "SlowFile"]

LONGEST = 300.0
"""Wall-clock limit of a file in seconds."""
_LATER = 15
"""Scheduling priority ("nice" value) of its process, below all others."""


class SlowFile:
    """One file.  Call `made` in a separate thread; `stop` cancels it from any thread."""

    def __init__(self) -> None:
        self._stopped = threading.Event()
        self._process: subprocess.Popen[str] | None = None

    def stop(self) -> None:
        """Cancel it."""
        self._stopped.set()
        if self._process is not None:
            self._process.kill()

    def made(self, words: Sequence[str], tell: Callable[[str], None]) -> bytes:
        """Return the file that `hess-explorer export` writes.

        Parameters
        ----------
        words : sequence of str
            Arguments of the command.
        tell : callable
            Called with the progress, for example "3/250" after the third of 250 frames or states.

        Raises
        ------
        InvalidParameter
            If the command fails, with its message.
        WorkLimit
            After `LONGEST` seconds.
        Abandoned
            If it was cancelled.
        """
        # A killed process leaves temporary files, and its encoder may still be writing; this folder collects them.
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            path = Path(folder) / "file"
            command = [sys.executable, "-m", "hess_explorer", "export", *words, "--progress", "--out", str(path)]
            if self._stopped.is_set():
                raise Abandoned
            # `-m` searches the current folder first, so start in this package, where no other module shadows it.
            with subprocess.Popen(
                command,
                cwd=Path(__file__).resolve().parents[1],
                env={**os.environ, "TMPDIR": folder},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            ) as process:
                self._process = process
                if hasattr(os, "setpriority"):
                    os.setpriority(os.PRIO_PROCESS, process.pid, _LATER)
                end = threading.Timer(LONGEST, process.kill)
                end.start()
                try:
                    last_line = self._heard(process, tell)
                finally:
                    in_time = end.is_alive()
                    end.cancel()
                    process.kill()
            if self._stopped.is_set():
                raise Abandoned
            if not in_time:
                raise WorkLimit(
                    f"This file takes more than {LONGEST:g} s: choose a shorter or smaller film, or fewer values."
                )
            if not path.exists():
                raise InvalidParameter(last_line.removeprefix("hess-explorer: ") or "The file could not be made.")
            return path.read_bytes()

    def _heard(self, process: subprocess.Popen[str], tell: Callable[[str], None]) -> str:
        """Read the output of the process; return the last line that does not report progress."""
        assert process.stderr is not None
        last_line = ""
        for line in process.stderr:
            if self._stopped.is_set():
                break
            if re.fullmatch(r"\d+/\d+\n", line):
                tell(line.strip())
            else:
                last_line = line.strip()
        else:
            process.wait()
        return last_line
