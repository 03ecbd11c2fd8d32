"""The mechanics of the explorer: formulas, kernels, results.  No user interface.

>>> from models import HessBody, circle_map, level
>>> circle_map(a=0.5, h=1.5, f=0.6, level=level("reference")).kind
'hyperbolic'
"""

from .accuracy import LEVELS, Level, Status, level
from .bifurcation import TurningPoints, curve, curve_point, f_max, turning_points
from .chaplygin_ball import BallBody
from .circle_map import CircleMap, FixedPoint, circle_map
from .ensemble import ensemble
from .errors import ModelError
from .free_suslov import free_motion
from .hess import HessBody
from .locking import critical_a, lock_boundary, lock_boundary_f, rotation_number_grid, trace_on_curve
from .orbit import solve
from .results import Cost, Ensemble, Orbit, Section
from .rigid_body import BodyCheck, check_body
from .scattering import scattering
from .section import Plane, section, sections
from .suslov import SuslovBody, unit_vector
from .system import System, systems

__all__ = [
    "LEVELS", "BallBody", "BodyCheck", "CircleMap", "Cost", "Ensemble", "FixedPoint", "HessBody", "Level", "ModelError",
    "Orbit", "Plane", "Section", "Status", "SuslovBody", "System", "TurningPoints", "check_body", "circle_map",
    "critical_a", "curve", "curve_point", "ensemble", "f_max", "free_motion", "level", "lock_boundary",
    "lock_boundary_f", "rotation_number_grid", "scattering", "section", "sections", "solve", "systems",
    "trace_on_curve", "turning_points", "unit_vector",
]
