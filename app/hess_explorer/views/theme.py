"""Colours, lines and sizes, consistent across all pictures (palette of Okabe and Ito).

A colour is identified by its value on a light page.  `SHADES` holds the equally clear shade for a dark page;
the browser swaps them (`looks.js`), in legends by CSS variables.
"""

from __future__ import annotations

import re

from hess_explorer.views.cyclic import TURN


def _mixed(colour: str) -> str:
    """Return a colour mixed with two fifths of grey."""
    return "#" + "".join(f"{round(0.6 * int(colour[i : i + 2], 16) + 0.4 * 0x80):02X}" for i in (1, 3, 5))


ORBIT = "#0072B2"
STABLE = "#009E73"
UNSTABLE = "#D55E00"
MAP = "#BF6699"
SHEET = "#56B4E9"
POINT = "#F0E442"
FORBIDDEN = "#ECECEC"
"""A quiet colour for regions without motion."""
LOCKED = "#B9A7D6"
MUTED = "#808080"
INK = "#101010"
"""The text colour, also for edges and rings."""
PAPER = "#FFFFFF"
"""The background colour, also for the rim of `INK` marks."""
NUMBER_MAP = "Cividis256"
"""Scale for numbers in an interval."""
TURN_MAP = TURN
"""Cyclic scale for rotation numbers from −½ to ½."""
SWARM = tuple(_mixed(colour) for colour in TURN[::8])
"""Cyclic colours of the starts of a swarm; none is as light as a light page or as dark as a dark one."""
LEVELS = {"draft": "#E69F00", "standard": "#8A63B8", "precise": "#9A6B2F", "reference": "#3C9DAF"}
INTEGRALS = ("#CC6677", "#999933", "#6B7FD7", "#808080")
CHANGED = "#E0245E"
BASINS = ("#4FB0E5", "#E69F00", "#8517FA", "#D9D264", "#CB3B0D")
"""Colours of basins, for light and dark pages; colour-blind readers can distinguish them."""
CHOSEN = ("#790167", "#15503F", "#AB0FFE", "#383800", "#A48CAE", "#AB5D34", "#310FA9", "#041F09")
"""Chosen orbits in the order of their starts; distinct also for the colour-blind, and from `ORBIT` and `UNSTABLE`."""
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
    **{
        f"chosen-{i}": pair
        for i, pair in enumerate(
            zip(
                CHOSEN,
                ("#FF14B6", "#0CFF8B", "#AE03C9", "#A19955", "#D7D8FF", "#845D49", "#516483", "#B4FFD1"),
                strict=True,
            )
        )
    },
}
"""CSS name → (colour on a light page, colour on a dark page)."""

_NAMES = {light: name for name, (light, _) in SHADES.items()}


def gradient(scale: tuple[str, ...]) -> str:
    """Return a colour scale as a CSS gradient from left to right."""
    return f"linear-gradient(90deg, {', '.join(scale[i * (len(scale) - 1) // 16] for i in range(17))})"


def to_css(style: str) -> str:
    """Replace the theme's colours in a CSS style by CSS variables; other colours stay unchanged."""

    def variable(match: re.Match[str]) -> str:
        colour, opacity = match[0][:7].upper(), match[0][7:]
        if colour not in _NAMES:
            return match[0]
        shade = f"var(--{_NAMES[colour]}, {colour})"
        return shade if not opacity else (f"color-mix(in srgb, {shade} {round(int(opacity, 16) / 2.55)}%, transparent)")

    return re.sub(r"#[0-9A-Fa-f]{6}(?:[0-9A-Fa-f]{2})?\b", variable, style)
