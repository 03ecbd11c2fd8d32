"""Mechanics of the Suslov problem, its Hess case, the Chaplygin ball and the Euler–Poisson equations.

The most used names can be imported from this package.  Each subject has a module of its own, such as `suslov.quartic`;
models/README.md lists them with the paper's equations.  `hess-explorer docs` opens the documentation of all of them.

Examples
--------
>>> from hess_mechanics import circle_map, level
>>> circle_map(a=0.5, h=1.5, f=0.6, level=level("reference")).kind
'hyperbolic'
"""

from hess_mechanics.chaplygin_ball.energy_surface import Strip
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.chaplygin_ball.integrable_cases import period
from hess_mechanics.chaplygin_ball.scattering import BallScattering, ball_scattering
from hess_mechanics.computations import (
    Basins,
    basins,
    cloud,
    rotation_along_line,
    rotation_numbers,
)
from hess_mechanics.dynamics.continuation import Branch
from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.dynamics.lyapunov import Exponent, lyapunov_exponent
from hess_mechanics.dynamics.manifolds import Manifold
from hess_mechanics.dynamics.megno import Megno, megno
from hess_mechanics.dynamics.megno_map import MegnoMap, megno_map
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram
from hess_mechanics.dynamics.periodic import PeriodicOrbit
from hess_mechanics.dynamics.regime import Dynamics, Regime, dynamics_of, regime
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.dynamics.section import Plane, SectionPoints, section, section_points, sections
from hess_mechanics.dynamics.spectrum import Spectrum, lyapunov_spectrum
from hess_mechanics.dynamics.system import Body, ParametrizedSystem, System, systems
from hess_mechanics.dynamics.tube import Tube, proved_error, right_until, tube
from hess_mechanics.dynamics.variation import Return, Transition, return_matrix, transition_matrix
from hess_mechanics.errors import ModelError
from hess_mechanics.euler_poisson.andoyer import AndoyerPlane
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.euler_poisson.loxodromic_pendulum import LoxodromicMotion, LoxodromicPendulum, loxodromic_motion
from hess_mechanics.numerics.accuracy import LEVELS, Level, Status, level
from hess_mechanics.numerics.results import Cost, Ensemble, Orbit, SectionCrossings
from hess_mechanics.return_maps import (
    PlanePoints,
    continued_orbit,
    manifold,
    orbit_diagram,
    period_doublings,
    periodic_orbit,
    return_map,
    section_orbits,
)
from hess_mechanics.rigid_body.inertia import BodyCheck, check_body
from hess_mechanics.rigid_body.own_body import OwnBody, Polynomial
from hess_mechanics.suslov.additional_integral import AdditionalIntegral, additional_integral
from hess_mechanics.suslov.equations import SuslovBody, unit_vector
from hess_mechanics.suslov.free import FreeMotion, free_motion
from hess_mechanics.suslov.kharlamova import PlaneBody
from hess_mechanics.suslov.quartic import QuarticBody
from hess_mechanics.suslov.scattering import Scattering, scattering
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, curve, curve_point, f_max, turning_points
from hess_mechanics.suslov_hess.certificate import certificate
from hess_mechanics.suslov_hess.circle_map import CircleMap, FixedPoint, circle_map
from hess_mechanics.suslov_hess.edge import EdgeProof
from hess_mechanics.suslov_hess.equations import HessBody
from hess_mechanics.suslov_hess.lock_zone import LockZone, lock_zone
from hess_mechanics.suslov_hess.mode_locking import (
    critical_a,
    lock_boundary,
    lock_boundary_f,
    rotation_number_grid,
    trace_on_curve,
)
from hess_mechanics.suslov_hess.proof import Proof, prove

__all__ = [  # noqa: RUF022 (by subject)
    # Computations for one kind of body
    "basins",
    "Basins",
    "cloud",
    "period",
    "rotation_numbers",
    "rotation_along_line",
    # Return maps of sections
    "return_map",
    "ReturnMap",
    "section_orbits",
    "PlanePoints",
    "periodic_orbit",
    "PeriodicOrbit",
    "continued_orbit",
    "Branch",
    "manifold",
    "Manifold",
    "megno_map",
    "MegnoMap",
    "orbit_diagram",
    "Diagram",
    "period_doublings",
    "Cascade",
    "regime",
    "Regime",
    "dynamics_of",
    "Dynamics",
    # Any system
    "Body",
    "System",
    "ParametrizedSystem",
    "systems",
    "solve",
    "Orbit",
    "ensemble",
    "Ensemble",
    "section",
    "sections",
    "section_points",
    "Plane",
    "SectionCrossings",
    "SectionPoints",
    "lyapunov_exponent",
    "Exponent",
    "lyapunov_spectrum",
    "tube",
    "Tube",
    "proved_error",
    "right_until",
    "Spectrum",
    "megno",
    "Megno",
    "transition_matrix",
    "Transition",
    "return_matrix",
    "Return",
    # Accuracy, cost, errors
    "LEVELS",
    "Level",
    "level",
    "Status",
    "Cost",
    "ModelError",
    # Bodies
    "SuslovBody",
    "PlaneBody",
    "QuarticBody",
    "HessBody",
    "BallBody",
    "HeavyBody",
    "OwnBody",
    "Polynomial",
    "BodyCheck",
    "check_body",
    "unit_vector",
    # Free Suslov problem
    "free_motion",
    "FreeMotion",
    "scattering",
    "Scattering",
    "additional_integral",
    "AdditionalIntegral",
    # Suslov–Hess case
    "circle_map",
    "CircleMap",
    "FixedPoint",
    "turning_points",
    "TurningPoints",
    "curve",
    "curve_point",
    "f_max",
    "critical_a",
    "lock_boundary",
    "lock_boundary_f",
    "rotation_number_grid",
    "trace_on_curve",
    "prove",
    "Proof",
    "EdgeProof",
    "certificate",
    "lock_zone",
    "LockZone",
    # Chaplygin ball with Suslov's constraint
    "Strip",
    "ball_scattering",
    "BallScattering",
    # Euler–Poisson equations
    "AndoyerPlane",
    "Bridge",
    "LoxodromicPendulum",
    "LoxodromicMotion",
    "loxodromic_motion",
]
