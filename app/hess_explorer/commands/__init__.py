"""The commands of `hess-explorer`.

A command written by hand is a module with a `COMMAND`: its description, options and function as data (`command.py`).
All others are computations of the catalogue (`compute.py`).  Only the module of the given command is imported, so that
`serve` does not wait for the mechanics, nor a computation for the web libraries.
"""

from __future__ import annotations

from collections.abc import Mapping

HEADINGS = ("page", "compute", "prove", "files", "help")
"""Headings of the list of commands; the catalogue has more commands for "compute" and "prove"."""

COMMANDS: Mapping[str, tuple[str, str]] = {
    "serve": ("page", "open the explorer in the browser (default)"),
    "shot": ("page", "take a screenshot of the page as PNG"),
    "prove": ("prove", "prove that a Suslov–Hess torus has two limit cycles, or none"),
    "export": ("files", "export a picture as data, figure, film or Python code, or a state or lesson as a page"),
    "site": ("files", "build a folder of pages that needs no server"),
    "lesson": ("files", "check a lesson that you write, or begin one"),
    "sweep": ("files", "compute numbers over one to three parameters"),
    "levels": ("help", "print what each level of accuracy promises and computes"),
    "docs": ("help", "build the documentation"),
}
"""Heading and purpose of each command that is written by hand."""


class CommandError(Exception):
    """A command cannot be carried out; the message is one sentence that names the problem and a remedy.

    Attributes
    ----------
    status : int
        Exit status of the program.
    """

    def __init__(self, message: str, status: int = 2) -> None:
        self.status = status
        super().__init__(message)
