"""`hess-explorer docs`: the pages of the Python packages, written from their docstrings."""

from __future__ import annotations

import argparse
from pathlib import Path

from . import CommandError
from .output import write_file

__all__ = ["add"]

_PACKAGES = ("hess_mechanics", "hess_explorer", "hess_explorer.library.state", "hess_explorer.export.columns")


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "docs", help="the pages of the Python packages, as HTML",
        description="Write the pages of what can be imported from hess_mechanics and hess_explorer, of the version "
                    "that is installed, with search, and no host to ask. Needs the extra: pip install '.[docs]'.",
        epilog="Example: hess-explorer docs --out docs")
    parser.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="where the pages go")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    try:
        import pdoc
    except ImportError as error:
        raise CommandError("The pages need pdoc: pip install 'hess-explorer[docs]'.") from error
    import importlib

    try:
        for name in _PACKAGES:
            (options.out / name.replace(".", "/")).parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CommandError(f"{str(options.out)!r} is no folder ({error.strerror}); choose another one.") from error
    found = {name: importlib.import_module(name) for name in _PACKAGES}
    for module in found.values():
        for name in module.__all__:
            # What is imported only when it is asked for.
            getattr(module, name)
    modules = {name: pdoc.doc.Module(module) for name, module in found.items()}
    pages = {f"{name.replace('.', '/')}.html": pdoc.render.html_module(module, modules)
             for name, module in modules.items()}
    pages |= {"index.html": pdoc.render.html_index(modules), "search.js": pdoc.render.search_index(modules)}
    for name, text in pages.items():
        write_file(options.out / name, text.encode())
