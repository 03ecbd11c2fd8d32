"""Options for the body and the initial state, the same in every command."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from .arguments import number, vector

if TYPE_CHECKING:
    from hess_mechanics import BallBody

__all__ = [
    "add_ball", "add_end", "add_free_body", "add_heavy_body", "add_inner_ball", "add_start", "add_suslov_body",
    "ball_of",
]


def _add_tensor(parser: argparse.ArgumentParser, more: str = "") -> None:
    parser.add_argument("--I", type=vector("I11,I22,I13,I23"), required=True, metavar="I11,I22,I13,I23",
                        help=f"inertia tensor (I12 = 0){more}")


def add_free_body(parser: argparse.ArgumentParser) -> None:
    """--I: inertia tensor of a body with Suslov's constraint that moves without a field."""
    _add_tensor(parser, "; I13 and I23 not both 0")


def add_inner_ball(parser: argparse.ArgumentParser) -> None:
    """--D: the ball inside a body, if there is one."""
    parser.add_argument("--D", type=number, default=0.0,
                        help="𝒟 = (R/R_s)² I_s of a ball inside, 0 or more (default 0: none)")


def add_end(parser: argparse.ArgumentParser, help: str = "the last time") -> None:
    """--t: how long a motion is followed."""
    parser.add_argument("--t", type=number, required=True, help=f"{help}; negative: backward")


def add_suslov_body(parser: argparse.ArgumentParser) -> None:
    """--I and --b: inertia tensor and field of a body with Suslov's constraint."""
    _add_tensor(parser)
    parser.add_argument("--b", type=vector("b1,b2,b3"), default=(0.0, 0.0, 0.0), metavar="b1,b2,b3",
                        help="field (default 0,0,0)")


def add_ball(parser: argparse.ArgumentParser) -> None:
    """--I, --b and --D: the body, and the ball inside it."""
    add_suslov_body(parser)
    parser.add_argument("--D", type=number, required=True, help="𝒟 = (R/R_s)² I_s of the ball inside, 0 or more")


def ball_of(options: argparse.Namespace) -> BallBody:
    """The ball of `add_ball`.  Raises a `ModelError`."""
    from hess_mechanics import BallBody

    return BallBody(*(*options.I, options.D, *options.b))


def add_heavy_body(parser: argparse.ArgumentParser) -> None:
    """--A, --r and --mu: inverse moments, centre of mass and weight of a body of the Euler–Poisson equations."""
    parser.add_argument("--A", type=vector("a1,a2,a3"), required=True, metavar="a1,a2,a3",
                        help="inverses of the principal moments of inertia")
    parser.add_argument("--r", type=vector("r1,r2,r3"), required=True, metavar="r1,r2,r3", help="centre of mass")
    parser.add_argument("--mu", type=number, required=True, help="weight; the potential is −μ(r, γ)")


def add_start(parser: argparse.ArgumentParser, omega: str = "w1,w2", gamma: str = "g1,g2,g3", option: str = "--omega",
              what: str = "angular velocity") -> None:
    """`option` (stored as `omega`) and --gamma: the state at t = 0."""
    parser.add_argument(option, dest="omega", type=vector(omega), required=True, metavar=omega, help=f"{what} at t = 0")
    parser.add_argument("--gamma", type=vector(gamma), required=True, metavar=gamma,
                        help="the vertical at t = 0; normalised")
