from .chaplygin_ball.ball_scattering import BallScattering, ball_scattering
from .chaplygin_ball.energy_surface import Strip
from .chaplygin_ball.equations import BallBody
from .chaplygin_ball.integrable_cases import period
from .computations import (
    cloud,
    rotation_along_line,
    rotation_numbers,
)
from .dynamics.continuation import Branch
from .dynamics.ensemble import ensemble
from .dynamics.manifolds import Manifold, manifold
from .dynamics.megno import Megno, megno
from .dynamics.megno_map import MegnoMap, megno_map
from .dynamics.orbit import solve
from .dynamics.orbit_diagram import Cascade, Diagram
from .dynamics.periodic import PeriodicOrbit
from .dynamics.plane_section import Plane, SectionPoints, section, section_points
from .dynamics.regime import Dynamics, Regime, dynamics_of, regime
from .dynamics.return_map import ReturnMap
from .dynamics.spectrum import Exponent, Spectrum, lyapunov_exponent, lyapunov_spectrum
from .dynamics.system import Body, ParametrizedSystem, System, systems
from .dynamics.tube import ProvedOrbit, Tube, proved_orbit, tube
from .errors import ModelError
from .euler_poisson.andoyer import AndoyerPlane
from .euler_poisson.equations import HeavyBody
from .euler_poisson.hess_isomorphism import Bridge
from .euler_poisson.loxodromic_pendulum import LoxodromicMotion, LoxodromicPendulum, loxodromic_motion
from .numerics.accuracy import LEVELS, Level, Status, level
from .numerics.arguments import unit_vector
from .numerics.results import Cost, Ensemble, Orbit, SectionCrossings
from .return_maps import (
    Basins,
    PlanePoints,
    basins,
    continued_orbit,
    orbit_diagram,
    period_doublings,
    periodic_orbit,
    return_map,
    section_orbits,
)
from .rigid_body.inertia import BodyCheck, check_body
from .rigid_body.own_body import OwnBody, Polynomial
from .suslov.additional_integral import AdditionalIntegral, additional_integral
from .suslov.equations import SuslovBody
from .suslov.free import FreeMotion, free_motion
from .suslov.kharlamova import PlaneBody
from .suslov.quartic import QuarticBody
from .suslov.scattering import Scattering, scattering
from .suslov_hess.bifurcation import TurningPoints, curve, curve_point, f_max, turning_points
from .suslov_hess.certificate import certificate
from .suslov_hess.circle_map import CircleMap, FixedPoint, circle_map
from .suslov_hess.edge import EdgeProof
from .suslov_hess.equations import HessBody
from .suslov_hess.mode_locking import critical_a, tongue_boundary
from .suslov_hess.proof import Proof, prove

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
    "section_points",
    "Plane",
    "SectionCrossings",
    "SectionPoints",
    "lyapunov_exponent",
    "Exponent",
    "lyapunov_spectrum",
    "tube",
    "Tube",
    "ProvedOrbit",
    "proved_orbit",
    "Spectrum",
    "megno",
    "Megno",
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
    # Suslov-Hess case
    "circle_map",
    "CircleMap",
    "FixedPoint",
    "turning_points",
    "TurningPoints",
    "curve",
    "curve_point",
    "f_max",
    "critical_a",
    "tongue_boundary",
    "prove",
    "Proof",
    "EdgeProof",
    "certificate",
    # Chaplygin ball with Suslov's constraint
    "Strip",
    "ball_scattering",
    "BallScattering",
    # Euler-Poisson equations
    "AndoyerPlane",
    "Bridge",
    "LoxodromicPendulum",
    "LoxodromicMotion",
    "loxodromic_motion",
]
