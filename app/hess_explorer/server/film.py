"""A film made in the background, by the command line in a process of its own, which yields to all pages."""

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

__all__ = ["LONGEST", "Film"]

LONGEST = 300.0
"""Seconds by the clock, after which it is given up."""
_LATER = 15
"""The priority of its process, after all others."""


class Film:
    """One film: `made` in a thread of its own, `stop` from any other."""

    def __init__(self) -> None:
        self._stopped = threading.Event()
        self._process: subprocess.Popen[str] | None = None

    def stop(self) -> None:
        """Nobody waits for it any more."""
        self._stopped.set()
        if self._process is not None:
            self._process.kill()

    def made(self, words: Sequence[str], tell: Callable[[str], None]) -> bytes:
        """The file that `hess-explorer export` with these words writes; tell : is told "3/250" after the third frame.

        Raises `InvalidParameter` with the sentence of the command, `WorkLimit` after `LONGEST`, `Abandoned` once
        stopped.
        """
        # A killed process leaves its files behind, and its encoder may still write one: they go with this folder.
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            path = Path(folder) / "film"
            command = [sys.executable, "-m", "hess_explorer", "export", *words, "--progress", "--out", str(path)]
            if self._stopped.is_set():
                raise Abandoned
            # `-m` looks in the current folder first: start in this package, where nothing can shadow it.
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
                    said = self._heard(process, tell)
                finally:
                    in_time = end.is_alive()
                    end.cancel()
                    process.kill()
            if self._stopped.is_set():
                raise Abandoned
            if not in_time:
                raise WorkLimit(f"This film takes more than {LONGEST:g} s to make: choose a shorter or a smaller one.")
            if not path.exists():
                raise InvalidParameter(said.removeprefix("hess-explorer: ") or "The film could not be made.")
            return path.read_bytes()

    def _heard(self, process: subprocess.Popen[str], tell: Callable[[str], None]) -> str:
        """The last line that was no progress."""
        assert process.stderr is not None
        said = ""
        for line in process.stderr:
            if self._stopped.is_set():
                break
            if re.fullmatch(r"\d+/\d+\n", line):
                tell(line.strip())
            else:
                said = line.strip()
        else:
            process.wait()
        return said
