"""The scenes of a principal axis: where their moving points are."""

from __future__ import annotations

from hess_explorer.scenes import scenes

ARC, POINT = scenes()["kharlamova"], scenes()["quartic"]
