"""`hess-explorer docs`: the pages of the Python packages, which the wheel has."""

from __future__ import annotations

import tempfile
import webbrowser
from importlib.resources import files
from pathlib import Path

from hess_explorer.api_pages import pages

from . import CommandError
from .command import Command, Options, option
from .output import show, write_file

__all__ = ["COMMAND"]

_PACKED = Path(str(files("hess_explorer"))) / "pages"


def _run(options: Options) -> None:
    if options.out is None and _PACKED.is_dir():
        _open(_PACKED)
        return
    folder: Path = options.out or Path(tempfile.mkdtemp(prefix="hess-explorer-docs-"))
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CommandError(f"{str(folder)!r} is no folder ({error.strerror}); choose another one.") from error
    for name, text in _pages().items():
        write_file(folder / name, text.encode())
    if options.out is None:
        _open(folder)


def _open(folder: Path) -> None:
    index = folder / "index.html"
    show(f"{index}\n".encode())
    webbrowser.open(index.as_uri())


def _pages() -> dict[str, str]:
    """Those in the wheel, else made from the sources.  Raises `CommandError`."""
    if _PACKED.is_dir():
        return {file.name: file.read_text(encoding="utf-8") for file in sorted(_PACKED.iterdir())}
    try:
        return pages([Path(str(files(package))).parent for package in ("hess_explorer", "hess_mechanics")])
    except ImportError as error:
        raise CommandError("The pages need griffelib: pip install 'hess-explorer[docs]'.") from error


COMMAND = Command(
    "Open the pages of what can be imported from hess_mechanics and hess_explorer, of the version that is installed, "
    "with search, and no host to ask. Where the packages are installed to be edited, the pages are made from the "
    "sources, which needs the extra: pip install '.[docs]'.",
    (option("--out", "write them there, and open none", type=Path, metavar="FOLDER"),),
    _run,
    "--out docs",
)
