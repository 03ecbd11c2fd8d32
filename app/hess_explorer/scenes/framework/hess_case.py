"""Parameters, limits and texts shared by the scenes of the Hess case."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.inertia import limits_of_moments
from hess_explorer.scenes.framework.scene import Motion
from hess_explorer.scenes.framework.sliders import ONE_TURN, Slider, slider_within
from hess_explorer.scenes.framework.swarm import Swarm
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.layers import Columns
from hess_explorer.views.plane.torus_plane import cycle_columns
from hess_explorer.views.plane.velocity_plane import pixels_per_unit
from hess_explorer.views.text import digits
from hess_mechanics import parameters as known
from hess_mechanics.errors import ModelError, NoField, Separatrix
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge, largest_area_integral
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.balls import Enclosure, exact
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, f_max, turning_points
from hess_mechanics.suslov_hess.certificate import statement_text
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map
from hess_mechanics.suslov_hess.edge import TWO_EQUILIBRIA, EdgeProof
from hess_mechanics.suslov_hess.embedding import embed
from hess_mechanics.suslov_hess.equations import SYSTEM, HessBody
from hess_mechanics.suslov_hess.proof import NO_CYCLE, TWO_CYCLES, Proof, prove
from hess_mechanics.suslov_hess.torus import Track, cycles, start_of_track

_MAX_A = 100.0
_MOST_BITS, _MOST_WORK = 256, 1e6
"""Limits of a background proof: it takes less than a second."""

_INSIDE = 1.0 - 1e-12
"""Margin for the round-off of the translation at the edge of the possible region."""

CYCLE_TRACKS: Mapping[str, Callable[[Any], Columns | None]] = {
    "stable": lambda s: cycle_columns(s.cycles, 0),
    "unstable": lambda s: cycle_columns(s.cycles, 1),
}
"""The tracks of the limit cycles of a state, see `limit_cycles`."""

CYCLES_MERGE: Answer[Any] = Answer(
    "The two loops have just met: here they appear or vanish.",
    lambda s: s.map is not None and s.map.kind == "parabolic" and bool(s.map.fixed_points),
)
"""The sentence on a state with one limit cycle.  The identity is parabolic, too, but has no isolated fixed points."""

UNSURE = 1e-9
NEAR_UNSTABLE_CYCLE = "This motion starts next to the unstable cycle: there round-off grows even on the torus."

I22 = replace(
    known.I22,
    default=0.96,
    softbounds=(0.2, 3.0),
    doc="Moment of inertia about the second body axis. I₁₁ follows from it and I₂₃.",
)
I23 = replace(
    known.I23,
    default=0.28,
    doc="Product of inertia. a = I₂₃/I₂₂ tilts the circular section; a = 0 decouples the motion.",
)
# The Hess case needs a field in this direction.
B3 = replace(
    known.B3,
    default=-1.0,
    softbounds=(-3.0, -0.05),
    bounds=(-1e3, -1e-3),
    doc="Third component of b = −mg r. It sets the unit of time; b₂ follows from it.",
)
PHI0 = replace(known.PHI0, bounds=ONE_TURN)

RIS = {"I1": 1.0, "I2": 1.5, "I3": 2.0, "m": math.sqrt(0.5)}
"""The body of figures 13 and 14, turned by π about its middle axis."""


def reduced_motion(hess: HessBody, turning_points: TurningPoints, phi0: float, length: float) -> Motion:
    """Return the reduced motion on a torus from phase φ0 at the lowest n3, in units b = 1.

    Parameters
    ----------
    hess : HessBody
        The body.
    turning_points : TurningPoints
        Turning points of n3 on the torus.
    phi0 : float
        Phase of the start, in radians.
    length : float
        Duration, in units b = 1.
    """
    start = tuple(turning_points.state_at_lower_turn(phi0).tolist())
    weights = pixels_per_unit(math.sqrt(2.0 * (turning_points.h + 1.0)))
    return Motion(SYSTEM, start, (hess.a, 1.0), length, weights, 1.0 / hess.frequency_unit)


def possible_f(h: float, f: float, notes: list[str]) -> float:
    """Return f clamped to |f| ≤ f_max(h), in units b = 1; append a note for a change."""
    largest = f_max(h)
    if abs(f) <= largest:
        return f
    notes.append(f"At h = {digits(h)} the largest possible |f| is {digits(largest)}: f was set to this limit.")
    return math.copysign(largest, f)


def possible_I23(I22: float, I23: float, notes: list[str]) -> float:
    """Return I23 clamped to |a| = |I23/I22| ≤ 100; append a note for a change."""
    bound = _MAX_A * I22
    if abs(I23) <= bound:
        return I23
    I23 = math.copysign(bound, I23)
    notes.append(f"|a| = |I₂₃/I₂₂| can be at most {_MAX_A:g}: I₂₃ was set to {digits(I23)}.")
    return I23


def map_or_none(work: Work, a: float, h: float, f: float, level: Level) -> CircleMap | None:
    """Return the circle map of a torus (a, h, f) in units b = 1; None on the separatrix.

    Raises `OutsideRegion` if no motion has this h and f.
    """
    try:
        return work.need(Task(circle_map, a, h, f, level))
    except Separatrix:
        return None


def limit_cycles(
    work: Work, hess: HessBody, theta: CircleMap | None, level: Level, half_width: float
) -> tuple[Track, Track] | None:
    """Return the stable and the unstable limit cycle on a torus, see `torus.cycles`.

    Parameters
    ----------
    work : Work
        Computation of the state.
    hess : HessBody
        The body.
    theta : CircleMap or None
        Circle map of the torus; None on the separatrix.
    level : Level
        Level of accuracy.
    half_width : float
        Largest |ω| of the plot, in rad/T.

    Returns
    -------
    (Track, Track) or None
        Both cycles; None unless the map is hyperbolic.
    """
    if theta is None or theta.kind != "hyperbolic":
        return None
    return work.need(Task(cycles, hess, theta.h, theta.f, theta.fixed_points[0], level, half_width))


@dataclass(frozen=True)
class ProvedStatement:
    """The result of a proof on a torus: a statement, or why there is none.

    Attributes
    ----------
    badge : str
        Short sentence for the caption of the circle map.
    sentence : str
        Sentence with more digits.
    """

    badge: str
    sentence: str


def proved_statement(I22: float, I23: float, h: float, f: float) -> ProvedStatement:
    """Prove the number of limit cycles on a torus; each double stands for the decimal number that its control shows.

    Parameters
    ----------
    I22, I23 : float
        Moment and product of inertia, in the same unit.
    h, f : float
        Energy and area integral, in units b = 1.

    Returns
    -------
    ProvedStatement
        The statement.  If the proof fails or is undecided, both sentences say so.
    """
    try:
        found = prove(exact("I23", I23) / exact("I22", I22), h, f, _MOST_BITS, _MOST_WORK)
    except ModelError as error:
        return ProvedStatement("Not proved.", f"Not proved: {error}")
    if isinstance(found, EdgeProof):
        moves = "two equilibria" if found.statement == TWO_EQUILIBRIA else "one periodic orbit"
        return ProvedStatement(f"Proved: no torus, but a circle with n₃ constant: {moves}.", statement_text(found))
    if found.statement == NO_CYCLE:
        # Print enough digits to show that |t| is less than 2.
        least = next(count for count in itertools.count(4) if Fraction(found.trace.decimals(count)[1]) < 2)
        return ProvedStatement(
            f"Proved: no cycle, |trace| in {_within(found.trace, least)}.",
            f"Proved: no cycle, |trace| in {_within(found.trace, least + 7)}{_costs(found)}",
        )
    if found.statement != TWO_CYCLES:
        return ProvedStatement(
            f"Undecided at {found.bits} bits.", f"Undecided at {found.bits} bits: the intervals do not tell"
        )
    less, more = found.multipliers
    return ProvedStatement(
        f"Proved: exactly two cycles, multipliers in {_within(less, 4)}, {_within(more, 4)}.",
        f"Proved: exactly two cycles, multipliers in {_within(less, 11)}, {_within(more, 11)}{_costs(found)}",
    )


def _within(result: Enclosure, count: int) -> str:
    return f"[{', '.join(result.decimals(count))}]".replace("E+", "e").replace("E-", "e−")


def _costs(result: Proof) -> str:
    return f" ({len(result.steps)} steps, {result.bits} bits)"


@dataclass(frozen=True)
class HeavyHess:
    """A motion of a heavy body on the Hess manifold.

    Attributes
    ----------
    moments : (float, float, float)
        Principal moments of inertia I1, I2 and I3.
    m : float
        μ|r|, weight times the distance of the centre of mass, of either sign.
    h : float
        Energy, in the unit of m.
    f : float
        Area integral (M, γ).
    """

    moments: tuple[float, float, float]
    m: float
    h: float
    f: float

    @property
    def _least_weight(self) -> float:
        """The least |μ||r| at which h/(|μ||r|) is not too large for the computation."""
        return max(1e-3, 1e-9 * abs(self.h))

    def _largest_f(self, h: float) -> float:
        return largest_area_integral(self.m, self.moments[1], h) * _INSIDE

    def corrections(self, notes: list[str]) -> Values:
        """Clamp h to values above its minimum and f to the region of this h; append a note for each change.

        Return nothing if |μ||r| is too small for a Hess case.
        """
        if abs(self.m) < self._least_weight:
            return {}
        h, f = max(self.h, -abs(self.m) * _INSIDE), self.f
        if h > self.h:
            notes.append(f"The energy must exceed −|μ||r|: h was set to {digits(h)}.")
        largest = self._largest_f(h)
        if abs(f) > largest:
            f = math.copysign(largest, f)
            notes.append(
                f"At h = {digits(h)} the largest |f| on the Hess manifold is {digits(largest)}: f was set to "
                "this limit."
            )
        return {"h": h, "f": f}

    def limits(self) -> Mapping[str, Slider]:
        """Return slider ranges of h and f over the possible region, and of the moments in their order.

        Without a possible motion, return only those of the moments.
        """
        m, moments = abs(self.m), limits_of_moments(*self.moments)
        if m < self._least_weight or self.h <= -m:
            return moments
        step = 10.0 ** (math.floor(math.log10(m)) - 2)
        low = -math.floor(m / step * 0.995) * step
        return {**moments, "h": (low, max(10.0 * m, self.h), step), "f": slider_within(self._largest_f(self.h))}

    @cached_property
    def bridge(self) -> Bridge:
        """The heavy body and the Suslov body with the same motions.

        Raises `NoField` if |μ||r| is too small, and `InvalidParameter` if no body has these moments.
        """
        if abs(self.m) < self._least_weight:
            raise NoField(
                f"μ|r| = {digits(self.m)}: without weight there is no Hess case. Choose μ|r| of at least "
                f"{digits(self._least_weight)} in absolute value."
            )
        return Bridge.of_heavy(HeavyBody.hess(self.moments, self.m))

    @cached_property
    def turning_points(self) -> TurningPoints:
        """The turning points of n3, with h and f in units b = 1.

        Raises `Separatrix`, `OutsideRegion` and the errors of `bridge`.
        """
        try:
            return turning_points(*self.bridge.in_units_of_b(self.h, self.f))
        except Separatrix:
            raise Separatrix(
                "h = |μ||r|, f = 0 is the separatrix: n₃ has no period. Choose another h, or a nonzero f."
            ) from None


def torus_swarm(torus: Callable[[Any], tuple[HessBody, float, float, float, CircleMap | None]]) -> Swarm[Any]:
    """Return the swarm on a torus: starts at all phases, each at the lowest n3, or at n3 = 1 on the separatrix.

    Parameters
    ----------
    torus : callable
        `torus(state)` returns the body, h and f in units b = 1, φ0 in radians, and the circle map or, on the
        separatrix, None.
    """

    def starts(state: Any, angles: Array) -> Array:
        body, h, f, phi0, theta = torus(state)
        if theta is None:
            return np.array([start_of_track(body, h, f, phi0 + angle, 1.0)[0] for angle in angles])
        turning = turning_points(h, f)
        return np.array([turning.state_at_lower_turn(phi0 + angle) for angle in angles])

    def columns(state: Any, times: Array, states: Array) -> Columns:
        body, h, _, _, theta = torus(state)
        in_body = body.from_reduced(body.from_units_of_b(states))
        phi = np.arctan2(states[..., 0], states[..., 1])
        at_return = np.zeros(times.size, int)
        if theta is not None and times.size > 1:
            period = round(theta.period / abs(times[1]))
            at_return = np.arange(times.size) // period * period
        on_surface = embed(states.reshape(-1, 5), h).reshape(*states.shape[:2], 3)
        return {
            "omega1": in_body[..., 0],
            "omega2": in_body[..., 1],
            **{f"g{i}": in_body[..., i + 1] for i in (1, 2, 3)},
            "phi": phi,
            "phi_start": phi[:, at_return],
            **{name: on_surface[..., i] for i, name in enumerate("xyz")},
        }

    def rate(state: Any) -> tuple[float, str] | None:
        body, *_, theta = torus(state)
        if theta is None or theta.kind != "hyperbolic":
            return None
        stable = theta.fixed_points[0]
        return (
            stable.log_multiplier / theta.period * body.frequency_unit,
            f"Multiplier {digits(stable.multiplier)} per return",
        )

    return Swarm(
        starts,
        columns,
        angles=("phi",),
        steps=("phi_start",),
        period=lambda s: None if (theta := torus(s)[-1]) is None else theta.period,
        rate=rate,
    )
