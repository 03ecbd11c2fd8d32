"""The Euler–Poisson equations near the Hess case: Andoyer–Deprit section, rotation number, exponent."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from hess_explorer.protocol.parameters import Value, written
from hess_explorer.scenes.framework.branched import (
    Branched,
    branch_picture,
    coordinate_of_branch,
    end_of_branch,
    parameter_of_branch,
)
from hess_explorer.scenes.framework.charted import Placed, exponents
from hess_explorer.scenes.framework.exponent import exponent_picture
from hess_explorer.scenes.framework.filled_window import EXPONENT, SECTION, TURN, filled_window
from hess_explorer.scenes.framework.hess_split import SplitSeparatrices, split_picture
from hess_explorer.scenes.framework.indicator import INDICATOR, colouring
from hess_explorer.scenes.framework.parameters import (
    accuracy_level,
    choice,
    exponent_time,
    number,
    orbits_spread,
    parameter,
    places,
    points_of_each,
    time_span,
)
from hess_explorer.scenes.framework.periodic import length_of_manifolds, plain, which
from hess_explorer.scenes.framework.proved_orbit import proved_error_shown
from hess_explorer.scenes.framework.rotation_across import ROTATION, RotationAcross, rotation_picture
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.solid_body import HeavySolid, heavy_solid
from hess_explorer.scenes.framework.windows import Window, inside
from hess_explorer.views import andoyer
from hess_explorer.views.layers import Columns, column
from hess_explorer.views.poisson_sphere import Direction, along_the_orbit, gamma_columns
from hess_explorer.views.text import digits, vector
from hess_mechanics import parameters as known
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, hess_curve
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from hess_mechanics.numerics.results import Array

_BOUNDS = ((-TURN, -1.0), (TURN, 1.0))
_OVER = {"ε": "away", "h": "h", "f": "f", "μ|r|": "m", "I₁": "I1", "I₂": "I2", "I₃": "I3"}
_ALONG, _ABOUT = "along l", "about the middle"
_LARGEST, _SECOND = "largest G", "second G"

# An example says also along what the rotation number is looked at: else choices stay as they were.
_RIS: dict[str, Value] = {"turns": _ALONG, "sheet": _LARGEST, "I1": 1.0, "I2": 1.5, "I3": 2.0, "m": -math.sqrt(0.5),
                          "span": 60.0}
_THERE, _LOW = "2.8,0.3", "-1.54,-0.86"
"""At the lowest energies the first of these starts is not possible."""
_BELOW, _AT, _ABOVE = "a curve in a regular leaf", "the separatrix", "two layers part"
_LS = np.array([-2.9, -2.7, -2.5, -2.2, 2.2, 2.5, 2.7, 2.9])
_ON_HESS = written([*zip(_LS, hess_curve(HeavyBody.hess((1.0, 1.5, 2.0), -math.sqrt(0.5)), _LS), strict=True)])
_NONE, _STABLE, _UNSTABLE = "no Hess motion yet", "the Hess motion is stable", "it is unstable, two layers part"
PRESETS = (*map(plain, (
    Preset("Two layers that never mix (figure 11)", turns=_ALONG, sheet=_LARGEST),
    Preset("Meandering torus (figure 12)", sheet=_LARGEST, window="-2.25,-0.27;-1.45,0.33", turns=_ABOUT,
           starts="-1.558,0.03", orbits=40.0, count=600.0),
    Preset("The barrier breaks: 0.02 away from Hess", turns=_ALONG, sheet=_LARGEST, away=0.02, count=600.0),
    *(Preset(f"Figure 13 {letter}: f = 0, h = {h:.4g}, {what}", **_RIS, h=h, f=0.0, starts=_THERE)
      for letter, h, what in (("a", -0.4, _BELOW), ("b", 0.0, _BELOW), ("c", 0.5, _BELOW), ("d", math.sqrt(0.5), _AT),
                              ("e", 1.0, _ABOVE), ("f", 2.0, _ABOVE))),
    *(Preset(f"Figure 14 {letter}: f = 1, h = {h:.4g}, {what}", **_RIS, h=h, f=1.0, starts=_THERE if h > 0.4 else _LOW)
      for letter, h, what in (("a", 0.0, _NONE), ("b", 0.2, _STABLE), ("c", 0.5, _STABLE), ("d", 0.8, _UNSTABLE),
                              ("e", 1.0, _UNSTABLE), ("f", 1.3, _UNSTABLE), ("g", 2.0, _UNSTABLE),
                              ("h", 4.0, _UNSTABLE))),
    Preset("On the Hess curve, f = 0, h below: fixed points, some in pairs", **_RIS, h=0.2, f=0.0, starts=_ON_HESS),
    Preset("h → ∞: Euler's case, h = 5000", turns=_ALONG, sheet=_LARGEST, h=5000.0, span=1.0, long=20.0,
           starts="0,0.5"),
    Preset("The second sheet of figure 14 a: a smaller G", **_RIS, h=0.0, f=1.0, starts="2.5,-0.92",
           window="2,-0.97;2.6,-0.86", count=600.0),
    Preset("Where the two Hess cycles meet, over h", **_RIS, h=2.0, f=1.0, starts="-0.1497,0.2064", reach=2.0,
           periodic="period 1", over="h", low=0.4, high=2.2),
)),)


@dataclass(frozen=True)
class EulerPoisson(SplitSeparatrices, RotationAcross, Branched, HeavySolid):
    """A section of one body at one energy and area integral, filled with orbits on both sides of the barrier."""

    away: float = number("ε", 0.0, (-0.5, 0.5), 0.005, bounds=(-math.pi, math.pi), label="Distance from Hess, ε",
                         doc="The angle, in radians, by which the centre of mass r is turned away from the direction "
                             "that the Hess condition asks for. At 0 the barrier r·M = 0 cannot be crossed.")
    m: float = parameter(known.MU_R)
    h: float = parameter(known.H_HEAVY, softbounds=(-1.0, 60.0), doc="H = h.")
    f: float = parameter(known.F_HEAVY, doc="(M, γ) = f; the section needs G ≥ |f|.")
    periodic: str = which()
    indicator: str = colouring()
    orbits: float = orbits_spread(60.0, 200.0, 400.0)
    count: float = points_of_each(300.0)
    reach: float = length_of_manifolds()
    over: str = parameter_of_branch(tuple(_OVER))
    low: float = end_of_branch("from")
    high: float = end_of_branch("to")
    upwards: str = coordinate_of_branch(("l", "L/G"))
    span: float = time_span(20.0, 200.0, what="the chosen orbit")
    long: float = exponent_time(200.0, 1000.0, 1e4, "the Lyapunov exponent is")
    turns: str = choice("Rotation number", (_ALONG, _ABOUT), _ALONG,
                        doc="Turns counted by the angle l, on a vertical line through the first chosen start; or about "
                            " the middle of the window, on a line from there to the right.")
    sheet: str = choice("Sheet", (_LARGEST, _SECOND), _LARGEST,
                        doc="Of the momenta G with this energy at one point of the section, where there are two: on "
                            "which orbits start.")
    certain: str = proved_error_shown()
    accuracy: str = accuracy_level()
    starts: str = places("The places of the chosen orbits", 12, *_BOUNDS, "0,0.2")
    window: str = places("The window of the section", 2, *_BOUNDS)

    names: ClassVar[tuple[str, str]] = ("l", "L/G")
    along: ClassVar[Mapping[str, str]] = _OVER
    besides: ClassVar[tuple[str, ...]] = ("sheet",)
    excuse: ClassVar[str] = "no motion with this h and f crosses the section"
    full: ClassVar[Window] = ((-math.pi, -1.0), (math.pi, 1.0))
    bounds: ClassVar[Window] = _BOUNDS
    held: ClassVar[tuple[int, int]] = (16, 40)
    weights: ClassVar[tuple[float, ...]] = (0.0, 0.0, 0.0, *(0.5 * PIXELS,) * 3)

    def limits(self) -> Mapping[str, tuple[float, float, float]]:
        """The energy from where the bottom of the potential is, and the moments in their order."""
        bottom = -math.floor(100.0 * abs(self.m)) / 100.0
        return {**super().limits(), "h": (bottom, max(60.0 if abs(self.m) > 2.0 else 6.0, bottom + 1.0), 0.01)}

    @cached_property
    def body(self) -> HeavyBody:
        """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return HeavyBody.hess(self.moments, self.m, self.away)

    @cached_property
    def section(self) -> AndoyerSection:
        """The section."""
        return AndoyerSection(self.body, self.h, self.f, (_LARGEST, _SECOND).index(self.sheet))

    @property
    def impossible_here(self) -> str:
        """What is said where nothing is possible in the window."""
        if self.sheet == _SECOND:
            return (f"No motion crosses a second sheet here with h = {self.h:.6g} and f = {self.f:.6g}: choose the "
                    "largest G, or press Clear for the whole section.")
        return (f"Nothing is possible here with h = {self.h:.6g} and f = {self.f:.6g}: choose a larger h, a smaller "
                "|f|, or press Clear for the whole section.")

    @property
    def about_middle(self) -> bool:
        """Whether turns are counted about the middle of the window."""
        return self.turns == _ABOUT

    # ---- what the pictures show ---------------------------------------------------------------------------------

    def track(self) -> Columns:
        """The orbit on show."""
        l, x = self.section.places_of(self.orbit.states).T
        orbit = self.orbit
        return {"t": column(orbit.times), "l": column(l), "x": column(x), **gamma_columns(orbit.states[:, 3:])}

    def hess_curve(self) -> tuple[Array, Array]:
        """The Hess manifold across the window."""
        l = np.linspace(self.frame[0][0], self.frame[1][0], 241)
        return l, hess_curve(self.body, l)

    # ---- words --------------------------------------------------------------------------------------------------

    def _about_section(self) -> str:
        if self.about_closed or self.about_indicator:
            return self.about_closed or self.about_indicator
        kept = [one for piece in self.pieces for one in piece.kept]
        mixed = ": the layers never mix." if self.away == 0.0 else "."
        other = len(inside([(float(l), float(x)) for l, x in self.elsewhere], self.frame))
        apart = f" {other} on another sheet." if other else ""
        return f"r·M keeps its sign along {sum(kept)} of {len(kept)} orbits{mixed}{apart}"

    def derived(self) -> Iterator[str]:
        """a and r, the start of the orbit on show, whether this is a rigid body."""
        yield f"a = {digits(self.body.hess_a)}, r = {vector(self.body.r)}"
        yield f"chosen: {self.at(self.chosen)}"
        yield from super().derived()
        if self.known("_known") and len(self.elsewhere):
            yield f"on another sheet: {len(self.elsewhere)} points"
        yield self.body.check.sentence


SCENE = Scene(
    EulerPoisson, __file__, place=11, presets=PRESETS, measures=(SECTION, INDICATOR, EXPONENT, ROTATION),
    charts=exponents(SYSTEM.name, lambda s: s.start_asked_for, ("section",), time=lambda s: s.long),
    placed=Placed("starts", EulerPoisson.names),
    group="Euler–Poisson", essential=("away", "h", "f"),
    title="Euler–Poisson: sections",
    summary="A heavy body near the Hess case: two stochastic layers with a barrier between them, a meandering torus.",
    tracks={"orbit": EulerPoisson.track},
    angles=("l",),
    views=(
        filled_window(
            title="Section g = π/2 (Andoyer–Deprit)", caption=EulerPoisson._about_section, scene=EulerPoisson,
            labels=("r·M > 0", "r·M < 0"), dot=("l", "x"),
            between=andoyer.between(
                elsewhere=lambda s: s.elsewhere, curve=EulerPoisson.hess_curve,
                across=lambda s: inside(s.ends, s.frame))),
        heavy_solid(),
        rotation_picture(),
        along_the_orbit(lambda s: Direction(math.copysign(1.0, s.m) * np.array(s.body.r), "r"),
                        lambda s: s.proved_around),
        replace(exponent_picture(), folded="Show the Lyapunov exponent"),
        split_picture(),
        branch_picture(EulerPoisson),
    ),
)
