"""Compilation of kernels: one decorator, and a cache that is never stale.  Not for users.

Numba validates its cache by the file of the compiled function alone.  These kernels are assembled from several files,
so the cache folder of a kernel is named by a hash of its subpackage, of the subpackages it imports, and of `numerics`
and `dynamics`: after any change, the old cache is simply not used.  Comments and docstrings do not count.
"""

from __future__ import annotations

import ast
import hashlib
import json
import logging
import os
import stat
import tempfile
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import numba
from numba.core import event

from hess_mechanics.numerics.files import write_atomically
from hess_mechanics.numerics.kernel_files import cache_on_disk, release
from hess_mechanics.numerics.patience import check_limit

__all__ = [
    "CACHE_FOLDER",
    "compile_seconds",
    "derived_kernel",
    "inner",
    "kernel",
    "part",
    "source_hash",
    "with_compile_notice",
    "without_fma",
]

_OPTIONS: dict[str, Any] = {
    # NumPy's division lets LLVM vectorise; `contract` fuses a*b+c and nothing else, so
    # isnan and compensated sums keep their meaning (`fastmath=True` would break both).
    "error_model": "numpy",
    "fastmath": {"contract"},
    "nogil": True,
}
_INLINED = {**_OPTIONS, "forceinline": True}
_ONLY_INLINED = {**_INLINED, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}

_CONFIG: Any = numba.config
_LOG = logging.getLogger("hess_mechanics")
_LONG = 20.0
"""Seconds from which a compilation is announced."""

_PACKAGE = Path(__file__).parents[1]
_FOR_ALL = {"numerics", "dynamics"}


# ---- folders ----------------------------------------------------------------------------------------------------


def _is_own(folder: Path) -> bool:
    """Return True for a folder of this user that no other user may write to; close it to all others."""
    status = folder.lstat()
    if not stat.S_ISDIR(status.st_mode):
        return False
    if hasattr(os, "getuid"):
        if status.st_uid != os.getuid():
            return False
        # Other users may have written files to a folder with these permissions.
        if status.st_mode & 0o022:
            return False
        if status.st_mode & 0o055:
            folder.chmod(0o700)
    return True


def _usable(folder: Path) -> bool:
    """Return True if compiled kernels can be kept in this folder, which is created if missing.

    They are machine code that is run, so a folder that belongs to someone else, or is writable by others, is not used.
    """
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        if not _is_own(folder):
            return False
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def _cache_folder() -> Path | None:
    """Return the first usable folder for compiled kernels; None if there is none (each process then compiles them)."""
    chosen = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    for base in filter(None, (chosen, "~/.cache")):
        try:
            folder = Path(base).expanduser() / "hess-explorer"
        except RuntimeError:  # There is no home folder.
            continue
        if _usable(folder):
            return folder
    # The temporary folder is shared by all users, so choose a name there that nobody can guess and claim first.
    shared = Path(tempfile.gettempdir())
    try:
        earlier = sorted(shared.glob("hess-explorer-*"))
        return next(filter(_usable, earlier), None) or Path(tempfile.mkdtemp(prefix="hess-explorer-"))
    except OSError:
        return None


CACHE_FOLDER = _cache_folder()
"""A folder that only this user can access, or None."""


# ---- hashes -----------------------------------------------------------------------------------------------------


def _read(path: Path) -> tuple[str, list[str]]:
    """Return the hash of a file without comments and docstrings, and the parts of the package that it imports."""
    tree = ast.parse(path.read_bytes())
    imported = set()
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list):
            node.body = [line for line in body if not _is_text(line)]  # type: ignore[attr-defined]
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(f"{_PACKAGE.name}."):
            imported.add((node.module or "").split(".")[1])
    return hashlib.sha256(ast.dump(tree).encode()).hexdigest(), sorted(imported)


def _is_text(line: Any) -> bool:
    """Return True for a docstring."""
    return isinstance(line, ast.Expr) and isinstance(line.value, ast.Constant) and isinstance(line.value.value, str)


@cache
def _sources() -> dict[str, tuple[str, list[str]]]:
    """Return `_read` of every file of the package, by its path.

    Reading takes a third of a second, so the results are stored; a file is read again if its time or size has changed.
    """
    memory = (
        None
        if CACHE_FOLDER is None
        else (CACHE_FOLDER / f"sources-{hashlib.sha256(str(_PACKAGE).encode()).hexdigest()[:16]}.json")
    )
    try:
        known = json.loads(memory.read_text(encoding="utf-8")) if memory is not None else {}
    except (OSError, ValueError):
        known = {}
    if not isinstance(known, dict):
        known = {}
    entries: dict[str, Any] = {}
    for path in sorted(_PACKAGE.rglob("*.py")):
        name, status = path.relative_to(_PACKAGE).as_posix(), path.stat()
        mark = [status.st_mtime_ns, status.st_size]
        match known.get(name):
            case [before, str(), list()] as entry if before == mark:
                entries[name] = entry
            case _:
                entries[name] = [mark, *_read(path)]
    if memory is not None and entries != known:
        # Ignore the error, because the file only saves time.
        with suppress(OSError):
            write_atomically(memory, json.dumps(entries).encode())
    return {name: (digest, imported) for name, (_, digest, imported) in entries.items()}


@cache
def source_hash(part: str | None = None) -> str:
    """Return the hash of the sources of the kernels in a part of the package; None for the whole package."""
    sources = _sources()
    parts, waiting = set(), [part, *_FOR_ALL] if part is not None else [name.split("/")[0] for name in sources]
    while waiting:
        one = waiting.pop()
        if one not in parts:
            parts.add(one)
            waiting += [other for name, (_, imported) in sources.items() if _part_of(name) == one for other in imported]
    digest = hashlib.sha256(numba.__version__.encode())
    for name, (own, _) in sources.items():
        if part is None or _part_of(name) in parts:
            digest.update(f"{name} {own}\n".encode())
    return digest.hexdigest()[:16]


def _part_of(name: str) -> str:
    """Return the part of the package that has a file: "suslov" for "suslov/equations.py", "errors" for "errors.py"."""
    return name.split("/", 1)[0].removesuffix(".py")


# ---- compilation ------------------------------------------------------------------------------------------------


# Numba disables LLVM's SLP vectorizer, which saves a quarter of the time here.
_CONFIG.SLP_VECTORIZE = 1


class _Clock(event.Listener):  # type: ignore[misc]  # numba has no types
    """Time for which each thread has held Numba's compiler lock, to compile kernels or to load them."""

    def __init__(self) -> None:
        self.of = threading.local()

    def on_start(self, event: Any) -> None:
        self.of.depth = getattr(self.of, "depth", 0) + 1
        if self.of.depth == 1:
            self.of.begun = time.perf_counter()

    def on_end(self, event: Any) -> None:
        self.of.depth = getattr(self.of, "depth", 1) - 1
        if self.of.depth == 0:
            self.of.seconds = getattr(self.of, "seconds", 0.0) + time.perf_counter() - self.of.begun


_CLOCK = _Clock()
event.register("numba:compiler_lock", _CLOCK)


def compile_seconds() -> float:
    """Return the time that this thread has spent on compiling kernels or loading them from disk, in seconds."""
    return float(getattr(_CLOCK.of, "seconds", 0.0))


def _folder_for(module: str) -> Path | None:
    """Return the cache folder of the kernels of a module."""
    if CACHE_FOLDER is None:
        return None
    package, _, inside = module.partition(".")
    return CACHE_FOLDER / source_hash(_part_of(inside.replace(".", "/")) if package == _PACKAGE.name else "numerics")


def kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile an entry point, which releases the GIL; its machine code is cached on disk if a folder is usable."""
    folder = _folder_for(function.__module__)
    if folder is None:
        return _compiled(function, _OPTIONS)
    # Numba reads the folder when the kernel is created.
    before, _CONFIG.CACHE_DIR = _CONFIG.CACHE_DIR, str(folder)
    try:
        return cache_on_disk(_compiled(function, _OPTIONS), folder)
    finally:
        _CONFIG.CACHE_DIR = before


def with_compile_notice(function: Callable[..., Any], name: str, seconds: float) -> Callable[..., Any]:
    """Return a kernel that logs a warning before its compilation if that is expected to take more than 20 s.

    `name` and `seconds`, the expected time, appear in the warning.  A long compilation ends between two passes of the
    compiler if the request is cancelled.
    """
    if seconds > _LONG:
        compiled: Any = getattr(function, "py_func", function)
        compiled.announcement = (
            f"Compiling {name} takes about {seconds:.0f} s, once: the machine code is stored. Ctrl-C stops it."
        )
    return function


class _LongCompilations(event.Listener):  # type: ignore[misc]  # numba has no types
    """Logs the beginning of a long compilation, and checks for a cancellation between its passes."""

    def __init__(self) -> None:
        self.of = threading.local()

    def on_start(self, event: Any) -> None:
        text = _announcement(event)
        if text:
            self.of.runs = True
            _LOG.warning(text)
        if getattr(self.of, "runs", False):
            check_limit()

    def on_end(self, event: Any) -> None:
        if _announcement(event):
            self.of.runs = False
        # `event.is_failed` means the opposite in some versions of Numba.
        if event.kind == "numba:compile" and tuple(event.data["args"]) not in event.data["dispatcher"].overloads:
            release(event.data["dispatcher"])


def _announcement(event: Any) -> str:
    """Return the announcement of the kernel in a Numba event; empty if it has none, and for other events."""
    return str(getattr(event.data["dispatcher"].py_func, "announcement", "")) if event.kind == "numba:compile" else ""


_LONG_COMPILATIONS = _LongCompilations()
for _kind in ("numba:compile", "numba:run_pass"):
    event.register(_kind, _LONG_COMPILATIONS)


def derived_kernel(name: str, source: str, module: str, **names: Any) -> Callable[..., Any]:
    """Return the `kernel` of the function `name` in derived source, which may call the functions in `names`.

    `module` is the importable module to which the kernel belongs.  Numba caches only functions in files, so the source
    is written to the cache folder, under a name that contains its hash.  Without a usable folder nothing is cached.
    """
    folder = _folder_for(module)
    file, is_stored = f"{name}.py", False
    if folder is not None:
        path = folder / f"{name}-{hashlib.sha256(source.encode()).hexdigest()[:16]}.py"
        file = str(path)
        is_stored = _holds(path, source)
        if not is_stored:
            with suppress(OSError):
                folder.mkdir(mode=0o700, exist_ok=True)
                # Numba recognises changed sources by the modification time.  The file is named by its hash, so a fixed
                # time lets processes that write it simultaneously share the cache.
                write_atomically(path, source.encode(), modified=0.0)
            is_stored = _holds(path, source)
    namespace: dict[str, Any] = {"__name__": module, **names}
    exec(compile(source, file, "exec"), namespace)
    # Numba caches nothing without the source file.
    return kernel(namespace[name]) if is_stored else _compiled(namespace[name], _OPTIONS)


def _holds(path: Path, text: str) -> bool:
    """Return True if a file exists and has exactly this text."""
    try:
        return path.read_text(encoding="utf-8") == text
    except (OSError, ValueError):
        return False


def inner(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a building block; its machine code is part of the kernels that call it."""
    return _compiled(function, _INLINED)


def part(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a closure or generated function like `inner`; only kernels may call it.

    It has no entry point for Python, where a call would crash the process, and compiles a tenth faster.
    """
    return _compiled(function, _ONLY_INLINED)


def without_fma(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile like `inner`, without fused operations, for arithmetic that depends on its roundings."""
    return _compiled(function, {**_INLINED, "fastmath": False})


def _compiled(function: Callable[..., Any], options: dict[str, Any]) -> Callable[..., Any]:
    jit: Any = numba.njit
    dispatcher: Callable[..., Any] = jit(**options)(function)
    return dispatcher
