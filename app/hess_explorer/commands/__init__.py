"""The commands of `hess-explorer`, one module per command.

Each module defines a `COMMAND`: its description, options and function as data (`command.py`).  Only the module of the
given command is imported, so that `--help` does not import the mechanics, nor `circle-map` the web libraries.
"""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ["COMMANDS", "CommandError"]

COMMANDS: Mapping[str, str] = {
    "serve": "open the explorer in the browser (default)",
    "circle-map": "compute the circle map of a Suslov–Hess torus (h, f)",
    "orbit": "compute states of one motion at given times",
    "period": "compute the period of a motion with I13 = I23 = 0 and b3 = 0",
    "periodic": "find periodic orbits of a section, their branches and manifolds",
    "section": "compute the points of a Poincaré section",
    "orbit-diagram": "compute the attractors of a section over a parameter",
    "regime": "classify a motion: periodic, quasi-periodic or chaotic",
    "scattering": "compute the scattering map θ⁺(φ) of the free Suslov problem",
    "rotation-number": "compute the rotation number of Suslov–Hess tori over a, h, f",
    "lyapunov": "compute the largest Lyapunov exponent of a motion, or the spectrum",
    "basins": "compute basins of attraction in a section of the Suslov problem",
    "cloud": "compute the volume and density of a cloud of phase points without a field",
    "prove": "prove that a Suslov–Hess torus has two limit cycles, or none",
    "tube": "compute proved intervals that contain one motion",
    "export": "export a picture as CSV, JSON, PNG, SVG, PDF or a film, or a state or lesson as a page",
    "site": "build a folder of pages that needs no server",
    "code": "print the Python code that computes and draws a picture of the page",
    "lesson": "check a lesson that you write, or begin one",
    "docs": "build the documentation",
    "sweep": "compute numbers over one to three parameters",
    "shot": "take a screenshot of the page as PNG",
    "bench": "compare the speed with other integrators at equal measured error (in a source checkout)",
}
"""Name and purpose of each command."""


class CommandError(Exception):
    """A command cannot be carried out; the message is one sentence that names the problem and a remedy.

    status : exit status of the program.
    """

    def __init__(self, message: str, status: int = 2) -> None:
        self.status = status
        super().__init__(message)
