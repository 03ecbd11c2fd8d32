"""The scenes of a principal axis: positions of their moving points."""

from hess_explorer.scenes import scenes

ARC, POINT = scenes()["kharlamova"], scenes()["quartic"]
