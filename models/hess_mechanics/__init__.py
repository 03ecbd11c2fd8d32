"""The mechanics of the explorer: formulas, kernels, results.  No user interface.

>>> from models import HessBody, circle_map, level
>>> circle_map(a=0.5, h=1.5, f=0.6, level=level("reference")).kind
'hyperbolic'
"""

from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.section import Plane, section, sections
from hess_mechanics.dynamics.system import System, systems
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import LEVELS, Level, Status, level
from hess_mechanics.numerics.results import Cost, Ensemble, Orbit, Section
from hess_mechanics.rigid_body.inertia import BodyCheck, check_body
from hess_mechanics.suslov.equations import SuslovBody, unit_vector
from hess_mechanics.suslov.free import free_motion
from hess_mechanics.suslov.scattering import scattering
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, curve, curve_point, f_max, turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap, FixedPoint, circle_map
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.mode_locking import (
    critical_a,
    lock_boundary,
    lock_boundary_f,
    rotation_number_grid,
    trace_on_curve,
)

__all__ = [
    "LEVELS", "BallBody", "BodyCheck", "CircleMap", "Cost", "Ensemble", "FixedPoint", "HessBody", "Level", "ModelError",
    "Orbit", "Plane", "Section", "Status", "SuslovBody", "System", "TurningPoints", "check_body", "circle_map",
    "critical_a", "curve", "curve_point", "ensemble", "f_max", "free_motion", "level", "lock_boundary",
    "lock_boundary_f", "rotation_number_grid", "scattering", "section", "sections", "solve", "systems",
    "trace_on_curve", "turning_points", "unit_vector",
]
