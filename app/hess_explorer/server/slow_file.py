"""Make a slow file in a separate low-priority process that runs `hess-explorer export`."""

from __future__ import annotations

import asyncio
import os
import re
import sys
import tempfile
from asyncio.subprocess import DEVNULL, PIPE
from collections.abc import Callable, Sequence
from pathlib import Path

from hess_mechanics.errors import InvalidParameter, WorkLimit

LONGEST = 300.0
"""Wall-clock limit of a file in seconds."""
_LATER = 15
"""Scheduling priority ("nice" value) of its process, below all others."""


async def slow_file(words: Sequence[str], tell: Callable[[str], None]) -> bytes:
    """Return the file that `hess-explorer export` writes; cancelling the task kills the process.

    Parameters
    ----------
    words : sequence of str
        Arguments of the command, without --progress and --out.
    tell : callable
        Called with the progress, for example "3/250" after the third of 250 frames or states.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    InvalidParameter
        If the command fails, with its message.
    WorkLimit
        After `LONGEST` seconds.
    """
    # A killed process leaves temporary files, and its encoder may still be writing; this folder collects its files.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        path = Path(folder) / "file"
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", "hess_explorer", "export", *words, "--progress", "--out", str(path)),
            # `-m` searches the current folder first, so start in this package, where no other module shadows it.
            cwd=Path(__file__).resolve().parents[1],
            env={**os.environ, "TMPDIR": folder},
            stdin=DEVNULL,
            stdout=DEVNULL,
            stderr=PIPE,
        )
        assert process.stderr is not None
        why = ""
        try:
            if hasattr(os, "setpriority"):
                os.setpriority(os.PRIO_PROCESS, process.pid, _LATER)
            async with asyncio.timeout(LONGEST):
                async for line in process.stderr:
                    text = line.decode(errors="replace").strip()
                    if re.fullmatch(r"\d+/\d+", text):
                        tell(text)
                    else:
                        why = text
                await process.wait()
        except TimeoutError as error:
            raise WorkLimit(
                f"This file takes more than {LONGEST:g} s: choose a shorter or smaller film, or fewer values."
            ) from error
        finally:
            if process.returncode is None:
                process.kill()
                await process.wait()
        if not path.exists():
            raise InvalidParameter(why.removeprefix("hess-explorer: ") or "The file could not be made.")
        return path.read_bytes()
