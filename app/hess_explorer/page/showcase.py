"""The gallery in the menu of scenes: examples in rows, one row per idea.

`tests/make_pictures.py` makes the pictures.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any
from urllib.parse import urlencode

from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Preset

__all__ = ["EXHIBITS", "IDEAS", "Exhibit", "rows"]


@dataclass(frozen=True)
class Exhibit:
    """One picture of an example.

    scene : name of the scene; example : beginning of the name of its preset; picture : name of the picture; title : a
    few words, in the gallery.
    """

    scene: str
    example: str
    picture: str
    title: str = ""

    @property
    def preset(self) -> Preset:
        """The example."""
        (found,) = (one for one in scenes()[self.scene].presets if one.name.startswith(self.example))
        return found

    @property
    def query(self) -> str:
        """The query of the example, without "?"."""
        return urlencode({"scene": self.scene, **self.preset.values})

    @property
    def file(self) -> str:
        """The name of its file, without theme and suffix."""
        return f"{self.scene}-{self.title.lower().replace(' ', '-')}"


IDEAS = {
    "Order beside chaos": (
        Exhibit("euler-poisson", "Two layers that never mix", "section", "Two layers"),
        Exhibit("euler-poisson", "Meandering torus", "section", "Meandering torus"),
        Exhibit("ball-section", "Mixed", "section", "Curves and a sea"),
        Exhibit("quartic", "Mixed: in the sea", "section", "In a quartic potential"),
    ),
    "Volume is not kept": (
        Exhibit("suslov", "Strange attractor", "section", "Strange attractor"),
        Exhibit("orbit-diagram", "Period doubling", "diagram", "Period doubling"),
        Exhibit("suslov", "Reversal", "section", "Attractor and repeller"),
        Exhibit("ball-section", "A wider one", "section", "On a rolling ball"),
    ),
    "One torus, one number": (
        Exhibit("suslov-hess", "Two limit cycles", "surface", "Two limit cycles"),
        Exhibit("suslov-hess", "No cycle", "omega", "Every orbit winds"),
        Exhibit("suslov-hess", "Strong contraction", "bifurcation", "Locked or winding"),
        Exhibit("rotation-number", "One plateau", "map", "Rotation number"),
    ),
    "Curves with a formula": (
        Exhibit("loxodrome", "Almost round", "space", "Almost round"),
        Exhibit("chaplygin-ball", "Projections", "omega", "A rolling ball"),
        Exhibit("kharlamova", "Periodic: two orbits", "domain", "Parabolas"),
        Exhibit("free-suslov", "Portrait, I₁₃ > 0, I₂₃ < 0", "omega", "From line to line"),
    ),
}
EXHIBITS = tuple(exhibit for row in IDEAS.values() for exhibit in row)


@cache
def rows() -> list[dict[str, Any]]:
    """Return the rows of the gallery as the page needs them."""
    return [
        {"idea": idea, "exhibits": [{"title": one.title, "query": one.query, "file": one.file} for one in row]}
        for idea, row in IDEAS.items()
    ]
