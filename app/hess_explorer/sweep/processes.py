"""Worker processes on this machine; a process that dies is replaced.

They are separate programs that receive pieces on stdin and return results on stdout.  `multiprocessing` would import
the user's main script again, which must be written for that, and a `ProcessPoolExecutor` breaks when one of its
processes dies.
"""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress

from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.work import Chunk, ChunkResult, compute

__all__ = ["processes", "serve"]

_DEATHS = 4
"""Number of processes that may die on one piece before it is given up."""
_PROTOCOL = 5
_PROGRAM = "from hess_explorer.sweep.processes import serve; serve()"


def serve() -> None:
    """Process pieces from stdin until end of file."""
    asked, told = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    # Keep other output away from the results.
    os.dup2(2, 1)
    while True:
        try:
            piece = pickle.load(asked)
        except EOFError:
            return
        found: ChunkResult | Exception
        try:
            found = compute(piece)
        except WorkersLost as error:
            found = error
        except Exception as error:
            # As text, because the parent process may not be able to unpickle the exception.
            found = RuntimeError(f"{type(error).__name__}: {error}")
        try:
            pickle.dump(found, told, _PROTOCOL)
            told.flush()
        except BrokenPipeError:
            return


class _Process:
    """A worker process, which is restarted when it dies, until `end`."""

    def __init__(self) -> None:
        self._lock, self._ended = threading.Lock(), False
        self._child = self._begun()

    def _begun(self) -> subprocess.Popen[bytes]:
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
            # One thread per process, also in libraries.
            **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"),
        }
        # A new session, so that Ctrl-C does not reach it.
        return subprocess.Popen(
            [sys.executable, "-c", _PROGRAM],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )

    def compute(self, piece: Chunk) -> ChunkResult:
        """Compute a piece.  Raises `WorkersLost` if several processes die on it."""
        for _ in range(_DEATHS):
            child = self._child
            assert child.stdin is not None and child.stdout is not None
            try:
                pickle.dump(piece, child.stdin, _PROTOCOL)
                child.stdin.flush()
                found = pickle.load(child.stdout)
            except (EOFError, OSError, ValueError, pickle.UnpicklingError):
                self._again(child)
                continue
            if isinstance(found, Exception):
                raise found
            assert isinstance(found, ChunkResult)
            return found
        raise RuntimeError(f"{_DEATHS} worker processes crashed on it")

    def _again(self, child: subprocess.Popen[bytes]) -> None:
        _kill(child)
        with self._lock:
            if self._ended:
                raise CancelledError
            self._child = self._begun()

    def end(self) -> None:
        """Kill the process, even if it is computing."""
        with self._lock:
            self._ended = True
        _kill(self._child)


def _kill(child: subprocess.Popen[bytes]) -> None:
    child.kill()
    child.wait()
    for stream in (child.stdin, child.stdout):
        if stream is not None:
            # Closing flushes messages that a dead process cannot receive.
            with suppress(OSError):
                stream.close()


@contextmanager
def processes(count: int) -> Iterator[Callable[[Chunk], Future[ChunkResult]]]:
    """Yield a function that submits a piece to one of `count` processes, which are killed at the end of the block."""
    idle: queue.SimpleQueue[_Process] = queue.SimpleQueue()
    own = [_Process() for _ in range(count)]
    for one in own:
        idle.put(one)

    def computed(piece: Chunk) -> ChunkResult:
        one = idle.get()
        try:
            return one.compute(piece)
        finally:
            idle.put(one)

    # Each thread waits for its process.
    with ThreadPoolExecutor(count, "sweep") as waiting:
        try:
            yield lambda piece: waiting.submit(computed, piece)
        finally:
            waiting.shutdown(wait=False, cancel_futures=True)
            for one in own:
                one.end()
