"""Colours, lines and sizes: one thing has one look in every picture (Okabe and Ito's palette).

A colour is named by its value on a light page.  `SHADES` has the shade of the same hue that is as clear on a dark one;
the browser exchanges them (`looks.js`), in legends by CSS variables.
"""

from __future__ import annotations

import re

from hess_explorer.views.cyclic import TURN

__all__ = ["gradient", "in_css"]

ORBIT = "#0072B2"
STABLE = "#009E73"
UNSTABLE = "#D55E00"
MAP = "#BF6699"
SHEET = "#56B4E9"
POINT = "#F0E442"
FORBIDDEN = "#ECECEC"
"""Quiet: nothing happens there."""
LOCKED = "#B9A7D6"
MUTED = "#808080"
INK = "#101010"
"""Edges and rings: the colour of text."""
PAPER = "#FFFFFF"
"""What is behind everything, as a rim about `INK`."""
NUMBER_MAP = "Cividis256"
"""Of numbers with two ends."""
TURN_MAP = TURN
"""Of rotation numbers, from −½ to ½, which are the same rotation."""
LEVELS = {"draft": "#E69F00", "standard": "#8A63B8", "precise": "#9A6B2F", "reference": "#3C9DAF"}
INTEGRALS = ("#CC6677", "#999933", "#6B7FD7", "#808080")
CHANGED = "#E0245E"
DASHES = {"draft": "dotted", "standard": "solid", "precise": "dashed", "reference": "dotdash"}
FONT_SIZE = "14px"

SHADES = {
    "orbit": (ORBIT, "#4DAEEB"),
    "stable": (STABLE, "#1DBE8F"),
    "unstable": (UNSTABLE, "#F07A22"),
    "second": (MAP, "#DE97C0"),
    "sheet": (SHEET, "#B3DFFF"),
    "forbidden": (FORBIDDEN, "#2B2B2B"),
    "locked": (LOCKED, "#6F6190"),
    "muted": (MUTED, "#949494"),
    "ink": (INK, "#F2F2F2"),
    "paper": (PAPER, "#121212"),
}
"""Name in CSS → on a light page, on a dark one."""

_NAMES = {light: name for name, (light, _) in SHADES.items()}


def gradient(scale: tuple[str, ...], parts: int = 16) -> str:
    """A scale of colours from left to right, in CSS."""
    return f"linear-gradient(90deg, {', '.join(scale[i * (len(scale) - 1) // parts] for i in range(parts + 1))})"


def in_css(style: str) -> str:
    """A style in CSS whose colours follow the page's theme: each that has shades becomes its variable."""

    def variable(found: re.Match[str]) -> str:
        colour, opacity = found[0][:7].upper(), found[0][7:]
        if colour not in _NAMES:
            return found[0]
        shade = f"var(--{_NAMES[colour]}, {colour})"
        return shade if not opacity else (f"color-mix(in srgb, {shade} {round(int(opacity, 16) / 2.55)}%, transparent)")

    return re.sub(r"#[0-9A-Fa-f]{6}(?:[0-9A-Fa-f]{2})?\b", variable, style)
