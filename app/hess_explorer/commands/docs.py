"""`hess-explorer docs`: the documentation, built by Sphinx."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import webbrowser
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

from . import CommandError
from .command import Command, Options, option
from .output import show

__all__ = ["COMMAND"]

_SOURCE = Path(str(files("hess_explorer"))) / "docs"


def _run(options: Options) -> None:
    missing = [name for name in ("sphinx", "myst_nb", "furo", "numpydoc", "matplotlib") if find_spec(name) is None]
    if missing:
        raise CommandError(f"The documentation needs {', '.join(missing)}: pip install 'hess-explorer[docs]'.")
    folder = Path(options.out or tempfile.mkdtemp(prefix="hess-explorer-docs-"))
    print("Running the tutorials takes about a minute.", file=sys.stderr)
    build = [
        sys.executable,
        "-m",
        "sphinx",
        "-q",
        "-b",
        "html",
        "-d",
        str(folder / ".doctrees"),
        str(_SOURCE),
        str(folder),
    ]
    # Of what Sphinx prints only the end of a failure matters.
    ran = subprocess.run(build, capture_output=True, text=True, check=False)
    if ran.returncode:
        raise CommandError(f"The documentation could not be built in {str(folder)!r}: {ran.stderr.strip()[-500:]}")
    index = folder / "index.html"
    show(f"{index}\n".encode())
    if options.out is None:
        webbrowser.open(index.as_uri())


COMMAND = Command(
    "Build the documentation and open it: a start, tutorials that are run, a gallery, guides, the API. It works "
    "without a network. Needs the extra: pip install '.[docs]'.",
    (option("--out", "build it there, and open nothing", type=Path, metavar="FOLDER"),),
    _run,
    "--out docs",
)
