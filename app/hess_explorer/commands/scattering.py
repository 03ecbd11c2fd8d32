"""`hess-explorer scattering`: the scattering map of the free Suslov problem."""

from __future__ import annotations

from hess_mechanics import SuslovBody, level, scattering
from hess_mechanics.parameters import CIRCLE_PHASE, THETA
from hess_mechanics.suslov.scattering import cos_chi

from .arguments import number as any_number
from .command import OUTPUT, Command, Options, number, option, samples
from .motions import FREE_TENSOR, check_of
from .output import Answer, body_facts, quality, table

__all__ = ["COMMAND"]


def _computed(options: Options) -> Answer:
    body = SuslovBody(*options.I)
    result = scattering(body, level(options.accuracy), options.arc, options.distance)
    return Answer(
        {"phi": options.phi, "theta_plus": result.theta_plus(options.theta, options.phi).tolist()},
        {
            "theta": options.theta,
            "cos_chi": result.cos_chi,
            "cos_chi_closed_form": cos_chi(body),
            "sin_chi": result.sin_chi,
            "phi_star": result.phi_star,
            "arc": result.arc,
            "distance": result.distance,
            **quality(result),
            **body_facts(check_of(body)),
        },
    )


COMMAND = Command(
    "Compute the scattering of the free Suslov problem (b = 0).  Every motion starts asymptotically on a circle at the "
    "angle θ⁻ from ξ around the unstable point, with a phase φ, and tends to a circle at the angle θ⁺ around the "
    "stable point.  The results cos_chi, sin_chi and phi_star satisfy cos θ⁺ = cos χ cos θ⁻ + sin χ sin θ⁻ "
    "cos(φ − φ*).",
    (
        FREE_TENSOR,
        number(THETA, help="θ⁻ in radians"),
        samples(CIRCLE_PHASE, "phases in radians (default: none)", []),
        option("--arc", "sign of I13ω1 + I23ω2 along the motion (default 1)", type=int, choices=(1, -1), default=1),
        option(
            "--distance",
            "define phases at the point where the component of ω across ξ is this fraction of the angular velocity at "
            "the unstable point (default: phases for t → −∞)",
            type=any_number,
        ),
        *OUTPUT,
    ),
    table(_computed),
    "--I 3.56,1,0,0.8 --theta 1.0 --phi 0,1,2 --accuracy reference",
)
