"""Ticks of axes that are angles."""

from __future__ import annotations

import math

__all__ = ["ANGLE_TICKS", "POLAR_TICKS"]

ANGLE_TICKS = [(-math.pi, "−π"), (-math.pi / 2, "−π/2"), (0.0, "0"), (math.pi / 2, "π/2"), (math.pi, "π")]
POLAR_TICKS = [(0.0, "0"), (math.pi / 4, "π/4"), (math.pi / 2, "π/2"), (3 * math.pi / 4, "3π/4"), (math.pi, "π")]
