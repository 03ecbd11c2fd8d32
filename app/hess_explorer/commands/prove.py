"""`hess-explorer prove`: prove that a Suslov–Hess torus has two limit cycles, or none, with a certificate."""

from __future__ import annotations

import json

from hess_mechanics import certificate, prove
from hess_mechanics.suslov_hess.certificate import statement_text

from .command import OUT, Command, Options, integer_option, option
from .output import long_computation, show

_FACTS = ("trace", "rotation_number", "period", "fixed_points", "multipliers", "rates", "bits", "versions")


def _run(options: Options) -> None:
    with long_computation():
        proof = prove(options.a, options.h, options.f, options.bits)
        found = certificate(proof)
    if options.format == "json":
        text = json.dumps(found, ensure_ascii=False, allow_nan=False, indent=1)
    else:
        names = [name for name in _FACTS if found.get(name) is not None]
        text = "\n".join(
            [
                statement_text(proof),
                *(f"{name.replace('_', ' ')}: {json.dumps(found[name])}" for name in names),
                "A proof holds for the equations with exactly these numbers, provided that the ball arithmetic of Arb "
                "is correct; --format json prints the certificate.",
            ]
        )
    show(f"{text}\n".encode(), options.out)


COMMAND = Command(
    "Prove by ball arithmetic that the torus (h, f), in units b = 1, has exactly two limit cycles (|trace| > 2 of its "
    "circle map) or none (|trace| < 2).  The proof holds for the equations with exactly these numbers, provided that "
    "the ball arithmetic of Arb is correct.  If |trace| is too close to 2, the result is “undecided”.  On the edge |f| "
    "= f_max(h) the torus degenerates to a circle of states; the command proves that it contains exactly two "
    "equilibria or is a periodic orbit.  Multipliers, fixed points and rotation number are enclosed in intervals.  The "
    "JSON output is a certificate with every Taylor step and the bound on its remainder, for an independent check such "
    "as tests/manual/check_certificate.py.  Requires: pip install 'hess-explorer[prove]'.",
    (
        *(
            option(f"--{name}", f"{what}; exact: 0.1, -2e-3 or 1/3", required=True, metavar="NUMBER")
            for name, what in (
                ("a", "inertia parameter a = I23/I22"),
                ("h", "energy, h > -1"),
                ("f", "area integral, |f| ≤ f_max(h)"),
            )
        ),
        integer_option("--bits", 64, 4096, "maximum precision; it doubles from 64 bits until the proof succeeds", 512),
        option(
            "--format",
            "text (default): the statement in words; json: the complete certificate",
            choices=("text", "json"),
            default="text",
        ),
        OUT,
    ),
    _run,
    "--a 0.5 --h 1.5 --f 0.6 --format json",
)
