"""Systems of the commands for motions: their options for body and start, and the body that these define."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from hess_mechanics import (
    BallBody,
    BodyCheck,
    HeavyBody,
    HessBody,
    SuslovBody,
    check_body,
    systems,
    unit_vector,
)
from hess_mechanics.dynamics.section import MAX_STEPS
from hess_mechanics.dynamics.system import Body
from hess_mechanics.parameters import (
    A_HESS,
    B_HESS,
    CENTRE,
    FIELD,
    GAMMA,
    INVERSE_MOMENTS,
    MAX_STEP,
    MOMENTUM,
    MU,
    OMEGA,
    REDUCED_GAMMA,
    REDUCED_OMEGA,
    TENSOR,
    D,
)

from .command import Option, Options, number, vector, whole

__all__ = [
    "BALL",
    "FREE_TENSOR",
    "HEAVY",
    "INNER_BALL",
    "LIMITS",
    "MOTIONS",
    "START",
    "SUSLOV",
    "System",
    "ball_of",
    "check_of",
    "heavy_of",
    "limits_of",
    "start_of",
    "suslov_of",
]

FREE_TENSOR = vector("--I", TENSOR, "inertia tensor (I12 = 0); I13 and I23 not both 0")
INNER_BALL = number(D, 0.0, help="𝒟 = (R/R_s)² I_s of the ball inside; 0 without a ball")
SUSLOV = (
    vector("--I", TENSOR, "inertia tensor (I12 = 0)"),
    vector("--b", FIELD, "field (default 0,0,0)", (0.0, 0.0, 0.0)),
)
BALL = (*SUSLOV, number(D, help="𝒟 = (R/R_s)² I_s of the ball inside"))
HEAVY = (
    vector("--A", INVERSE_MOMENTS, "inverses of the principal moments of inertia"),
    vector("--r", CENTRE, "centre of mass"),
    number(MU, help="weight; the potential is −μ(r, γ)"),
)
_VERTICAL = "the vertical at t = 0; normalised"
START = (vector("--omega", OMEGA, "angular velocity at t = 0"), vector("--gamma", GAMMA, _VERTICAL))


LIMITS = (
    number(MAX_STEP, 0.0, name="--max-step"),
    whole("--max-steps", 1, 10**12, "largest number of steps", MAX_STEPS),
)


def limits_of(options: Options) -> dict[str, Any]:
    """Return the arguments `max_step` and `max_steps` of `solve` and `section`."""
    return {"max_step": options.max_step or None, "max_steps": options.max_steps}


def suslov_of(options: Options) -> SuslovBody:
    """Return the body of the options `SUSLOV`.  Raises `ModelError`."""
    return SuslovBody(*options.I, *options.b)


def ball_of(options: Options) -> BallBody:
    """Return the body of the options `BALL`.  Raises `ModelError`."""
    return BallBody(*(*options.I, options.D, *options.b))


def heavy_of(options: Options) -> HeavyBody:
    """Return the body of the options `HEAVY`.  Raises `ModelError`."""
    return HeavyBody(options.A, options.r, options.mu)


def check_of(body: SuslovBody | BallBody | HeavyBody) -> BodyCheck:
    """Return the check that a rigid body can have these moments of inertia."""
    return body.check if isinstance(body, HeavyBody) else check_body(body.I11, body.I22, body.I13, body.I23)


def start_of(options: Options) -> tuple[tuple[float, ...], list[str]]:
    """Return the state at t = 0 with a normalised vertical, and a note if that changed it."""
    gamma, note = unit_vector(options.gamma)
    return (*options.omega, *gamma), [note] if note else []


@dataclass(frozen=True)
class System:
    """A system of equations with its command-line options.

    Attributes
    ----------
    title : its name in help texts; options : of body and start; example : values of the options; given : returns the
    body, and the check that a rigid body can have its moments of inertia.
    """

    title: str
    options: tuple[Option, ...]
    example: str
    given: Callable[[Options], tuple[Body, BodyCheck]]


def _of(body: Callable[[Options], SuslovBody | BallBody | HeavyBody]) -> Callable[[Options], tuple[Body, BodyCheck]]:
    def given(options: Options) -> tuple[Body, BodyCheck]:
        made = body(options)
        return made, check_of(made)

    return given


def _hess(options: Options) -> tuple[Body, BodyCheck]:
    # (a, b) do not determine the scale of the inertia tensor, and the check does not depend on it: take I22 = 1.
    return systems()["hess"].at((options.a, options.b)), HessBody(I22=1.0, I23=options.a, b3=0.0).check


MOTIONS: Mapping[str, System] = {
    "suslov": System(
        "the Suslov problem with gravity",
        (*SUSLOV, *START),
        "--I 1,2.5,0.6,0.6 --b=-1,-0.5,0.7 --omega 0.5,1.2 --gamma 0.6,0,0.8",
        _of(suslov_of),
    ),
    "ball": System(
        "the Chaplygin ball with Suslov's constraint",
        (*BALL, *START),
        "--I 1,4,0,0 --D 2 --b 0.3,0,1 --omega 0.5,0.9 --gamma 0.6,0,0.8",
        _of(ball_of),
    ),
    "hess": System(
        "the Suslov–Hess case in its reduced variables (w1, w2, n1, n2, n3)",
        (
            number(A_HESS, help="inertia parameter a = I23/I22"),
            number(B_HESS, help="field"),
            vector("--omega", REDUCED_OMEGA, "angular velocity at t = 0"),
            vector("--gamma", REDUCED_GAMMA, _VERTICAL),
        ),
        "--a 0.5 --b 1 --omega 0.7,1.1 --gamma 0.2,0.5,0.7",
        _hess,
    ),
    "euler-poisson": System(
        "a heavy rigid body with a fixed point in its principal axes, H = ½(M, AM) − μ(r, γ)",
        (
            *HEAVY,
            vector("--M", MOMENTUM, "angular momentum at t = 0", dest="omega"),
            vector("--gamma", GAMMA, _VERTICAL),
        ),
        "--A 1,1.6,2.6666666666666665 --r 3,0,4 --mu 1.995 --M 1.3,-2,0.7 --gamma 0.3,0.4,0.87",
        _of(heavy_of),
    ),
}
"""Systems by name."""
