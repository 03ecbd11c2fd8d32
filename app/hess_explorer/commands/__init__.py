"""The commands of `hess-explorer`, one file per subject.

Each file has a `COMMAND`, its description, options and function as data (`command.py`).  Only the file of the command
that was given is imported: `--help` does not wait for the mechanics, nor `circle-map` for the web page's libraries.
"""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ["COMMANDS", "CommandError"]

COMMANDS: Mapping[str, str] = {
    "serve": "show the explorer in the browser (the default)",
    "circle-map": "the circle map of a Suslov–Hess torus (h, f)",
    "orbit": "states of one motion at given times",
    "period": "the period of a motion with I13 = I23 = 0 and b3 = 0",
    "periodic": "periodic orbits of a section, their branches and manifolds",
    "section": "the points of a Poincaré section",
    "orbit-diagram": "where an orbit of a section settles over a parameter",
    "regime": "of what kind a motion is: periodic, quasi-periodic, chaotic",
    "scattering": "the scattering θ⁺(φ) of the free Suslov problem",
    "rotation-number": "the rotation number of Suslov–Hess tori over a, h, f",
    "lyapunov": "the largest Lyapunov exponent of one motion, or all",
    "basins": "where the orbits from the cells of a section of the Suslov problem end",
    "cloud": "a cloud of phase points without a field, its volume and density",
    "prove": "proves that a Suslov–Hess torus has two limit cycles, or none",
    "prove-zone": "proves where over (h, f) tori have two limit cycles, and where none",
    "tube": "intervals that contain one motion, as a theorem",
    "export": "what a picture of the page shows, as CSV, JSON, PNG, SVG, PDF or a film; HTML of all",
    "code": "the lines of Python that compute and draw what the page shows",
    "docs": "the documentation: tutorials, a gallery, guides, the API",
    "sweep": "a quantity over one to three parameters",
    "shot": "a picture of the page, as PNG",
    "bench": "speed beside other integrators, at the same measured error",
}
"""Name and purpose of each."""


class CommandError(Exception):
    """A request that cannot be carried out; the message is one sentence: what is wrong and what to change."""
