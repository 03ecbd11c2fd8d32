"""Colours, lines and sizes: one thing has one look in every picture (Okabe and Ito's palette)."""

from __future__ import annotations

ORBIT = "#0072B2"
STABLE = "#009E73"
UNSTABLE = "#D55E00"
MAP = "#CC79A7"
SHEET = "#56B4E9"
POINT = "#F0E442"
FORBIDDEN = "#A8A8A8"
ON_FORBIDDEN = "#101010"
"""Words on it: the same in light and dark, see `plot.js`."""
LOCKED = "#B9A7D6"
MUTED = "#808080"
NUMBER_MAP = "Cividis256"
LEVELS = {"draft": "#E69F00", "standard": "#8A63B8", "precise": "#9A6B2F", "reference": "#3C9DAF"}
INTEGRALS = ("#CC6677", "#999933", "#6B7FD7", "#808080")
CHANGED = "#E0245E"
DASHES = {"draft": "dotted", "standard": "solid", "precise": "dashed", "reference": "dotdash"}
FONT_SIZE = "14px"
