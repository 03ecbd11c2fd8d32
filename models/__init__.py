"""The mechanics of the Suslov–Hess explorer: formulas, kernels, results.  No user interface.

>>> from models import HessBody, circle_map, level
>>> circle_map(a=0.5, h=1.5, f=0.6, level=level("reference")).kind
'hyperbolic'
"""

from .accuracy import LEVELS, Level, Status, level
from .bifurcation import TurningPoints, curve, curve_point, f_max, turning_points
from .circle_map import CircleMap, FixedPoint, circle_map
from .errors import ModelError
from .hess import HessBody
from .locking import critical_a, lock_boundary, lock_boundary_f, rotation_number_grid, trace_on_curve
from .results import Cost, Orbit
from .rigid_body import BodyCheck, check_body
from .suslov import SuslovBody, unit_vector
from .system import System, solve, systems

__all__ = [
    "LEVELS", "BodyCheck", "CircleMap", "Cost", "FixedPoint", "HessBody", "Level", "ModelError", "Orbit",
    "Status", "SuslovBody", "System", "TurningPoints", "check_body", "circle_map", "critical_a", "curve",
    "curve_point", "f_max", "level", "lock_boundary", "lock_boundary_f", "rotation_number_grid", "solve",
    "systems", "trace_on_curve", "turning_points", "unit_vector",
]
