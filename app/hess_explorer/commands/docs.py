"""`hess-explorer docs`: build the documentation with Sphinx."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import webbrowser
from importlib.resources import files
from pathlib import Path

from . import CommandError
from .command import Command, Options, option
from .output import show

_SOURCE = Path(str(files("hess_explorer"))) / "docs"


def _run(options: Options) -> None:
    folder = Path(options.out or tempfile.mkdtemp(prefix="hess-explorer-docs-"))
    print("Building the documentation takes a few minutes.", file=sys.stderr)
    words = ["-q", "-b", "html", "-d", str(folder / ".doctrees"), str(_SOURCE), str(folder)]
    # Sphinx's output is long: show its end, and only on failure.
    ran = subprocess.run([sys.executable, "-m", "sphinx", *words], capture_output=True, text=True, check=False)
    if ran.returncode:
        raise CommandError(
            f"The documentation could not be built in {str(folder)!r}: {ran.stderr.strip()[-500:]}  It needs: pip "
            "install 'hess-explorer[docs]'."
        )
    index = folder / "index.html"
    show(f"{index}\n".encode())
    if options.out is None:
        webbrowser.open(index.as_uri())


COMMAND = Command(
    "Build the documentation (first steps, tutorials, gallery, guides, API) and open it in the browser. The tutorials "
    "are run during the build. Works offline. Requires: pip install 'hess-explorer[docs]'.",
    (option("--out", "build into this folder and do not open it", type=Path, metavar="FOLDER"),),
    _run,
    "--out docs",
)
