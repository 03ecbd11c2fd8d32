"""`hess-explorer scattering`: to which limit circle the motions from another one go."""

from __future__ import annotations

import argparse

from .arguments import number, samples
from .bodies import add_free_body
from .output import add_options, computing, quality, whether_body, write

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "scattering", help="the scattering θ⁺(φ) of the free Suslov problem",
        description="The free Suslov problem (b = 0): every motion comes from a circle at the angle θ⁻ from ξ round "
                    "the unstable point, with a phase φ, and goes to one at the angle θ⁺ round the stable point.  "
                    "cos_chi, sin_chi, phi_star: cos θ⁺ = cos χ cos θ⁻ + sin χ sin θ⁻ cos(φ − φ*).",
        epilog="Example: hess-explorer scattering --I 3.56,1,0,0.8 --theta 1.0 --phi 0,1,2 --accuracy reference")
    add_free_body(parser)
    parser.add_argument("--theta", type=number, required=True, help="θ⁻ in radians")
    parser.add_argument("--phi", type=samples, default=[], metavar="LIST",
                        help="phases in radians, 0,1,2 or lo:hi:n (default: none)")
    parser.add_argument("--arc", type=int, choices=(1, -1), default=1,
                        help="the sign of I13ω1 + I23ω2 on the way (default 1)")
    parser.add_argument("--distance", type=number,
                        help="phases of starts where the part of ω across ξ is this times the angular velocity at the "
                             "unstable point (default: phases for t → −∞)")
    add_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import SuslovBody, check_body, level
        from hess_mechanics.suslov.scattering import cos_chi, scattering

        body = SuslovBody(*options.I)
        result = scattering(body, level(options.accuracy), options.arc, options.distance)
        theta_plus = result.theta_plus(options.theta, options.phi).tolist()
        closed_form = cos_chi(body)
        check = check_body(*options.I)
    facts = {
        "theta": options.theta,
        "cos_chi": result.cos_chi,
        "cos_chi_closed_form": closed_form,
        "sin_chi": result.sin_chi,
        "phi_star": result.phi_star,
        "arc": result.arc,
        "distance": result.distance,
        **quality(result),
        **whether_body(check),
    }
    write(options, {"phi": options.phi, "theta_plus": theta_plus}, ("phi", "theta_plus"), facts, notes=())
