"""The Euler–Poisson equations near the Hess case: Andoyer–Deprit section, rotation number, exponent."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from hess_explorer.protocol.specs import Value, Values, points_text
from hess_explorer.scenes.framework.answers import Answer
from hess_explorer.scenes.framework.charted import Charts, motion_charts
from hess_explorer.scenes.framework.hess_case import HeavyHess
from hess_explorer.scenes.framework.inertia import limits_of_moments
from hess_explorer.scenes.framework.orbit_batches import OrbitBatch, batch_of
from hess_explorer.scenes.framework.part import Start, part
from hess_explorer.scenes.framework.scene import Preset, Scene
from hess_explorer.scenes.framework.sliders import (
    TURN,
    Slider,
    choice,
    exponent_time,
    number,
    parameter,
    points,
    time_span,
)
from hess_explorer.scenes.framework.solid_body import Solid, body_picture, heavy_solid
from hess_explorer.scenes.framework.swarm import turned_swarm
from hess_explorer.scenes.parts.diagrams.hess_split import HessSplit, split_picture
from hess_explorer.scenes.parts.orbits.exponent import exponent_picture, exponent_trial
from hess_explorer.scenes.parts.orbits.hess_surface import (
    INVARIANT,
    HeavyTorus,
    HessSurface,
    shading,
    surface_picture,
)
from hess_explorer.scenes.parts.sections import (
    PLAIN,
    Clicks,
    FilledState,
    SectionBranch,
    branch_picture,
    coordinate_of_branch,
    end_of_branch,
    filled_picture,
    filled_section,
    orbits_spread,
    parameter_of_branch,
    points_of_each,
    section_trials,
    start_on,
)
from hess_explorer.scenes.parts.sections.density import SectionDensity
from hess_explorer.scenes.parts.sections.rotation_across import RotationAcross, rotation_picture, rotation_trial
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Columns, column, crop
from hess_explorer.views.plane import andoyer
from hess_explorer.views.plane.section_plane import concatenate
from hess_explorer.views.space.poisson_sphere import Direction, gamma_columns, orbit_sphere
from hess_explorer.views.text import digits, vector
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, hess_curve, relation
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from hess_mechanics.euler_poisson.hess_split import HessTorus
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array, as_read_only
from hess_mechanics.parameters import F_HEAVY, H_HEAVY, I1, I2, I3, MU_R

_NAMES = ("l", "L/G")
_BOUNDS = ((-TURN, -1.0), (TURN, 1.0))
_OVER = {"ε": "away", "h": "h", "f": "f", "μ|r|": "m", "I₁": "I1", "I₂": "I2", "I₃": "I3"}
_ALONG, _ABOUT = "along l", "about the middle"
_LARGEST, _SECOND = "largest G", "second G"
_MORE = "a larger h, a smaller |f|"

_RIS: dict[str, Value] = {"I1": 1.0, "I2": 1.5, "I3": 2.0, "m": -math.sqrt(0.5), "span": 60.0}
_THERE, _LOW = "2.8,0.3", "-1.54,-0.86"
"""The first of these starts is impossible at the lowest energies."""
_LS = np.array([-2.9, -2.7, -2.5, -2.2, 2.2, 2.5, 2.7, 2.9])
_ON_HESS = points_text([*zip(_LS, hess_curve(HeavyBody.hess((1.0, 1.5, 2.0), -math.sqrt(0.5)), _LS), strict=True)])


def _figure(number: int, f: float, what: str, energies: Mapping[str, float]) -> Iterator[Preset]:
    """Yield the presets of a figure, by letter."""
    for letter, h in energies.items():
        yield Preset(
            f"Figure {number} {letter}: f = {f:g}, h = {h:.4g}, {what}",
            **_RIS,
            h=h,
            f=f,
            starts=_THERE if f == 0.0 or h > 0.4 else _LOW,
        )


PRESETS = (
    Preset("Two layers that never mix (figure 11)", **PLAIN, turns=_ALONG, sheet=_LARGEST),
    Preset(
        "Meandering torus (figure 12)",
        window="-2.25,-0.27;-1.45,0.33",
        turns=_ABOUT,
        starts="-1.558,0.03",
        orbits=40.0,
        count=600.0,
    ),
    Preset("The barrier breaks: ε = 0.02", away=0.02, count=600.0),
    *_figure(13, 0.0, "the Hess curve among regular ones", {"a": -0.4, "b": 0.0, "c": 0.5}),
    *_figure(13, 0.0, "the separatrix", {"d": math.sqrt(0.5)}),
    *_figure(13, 0.0, "two layers", {"e": 1.0, "f": 2.0}),
    *_figure(14, 1.0, "no motion on the Hess manifold", {"a": 0.0}),
    *_figure(14, 1.0, "no limit cycles", {"b": 0.2, "c": 0.5}),
    *_figure(14, 1.0, "two limit cycles, two layers", {"d": 0.8, "e": 1.0, "f": 1.3, "g": 2.0, "h": 4.0}),
    Preset("On the Hess curve, f = 0, h < μ|r|: fixed points, some in pairs", **_RIS, h=0.2, f=0.0, starts=_ON_HESS),
    Preset("h → ∞: Euler's case, h = 5000", h=5000.0, span=1.0, long=20.0, starts="0,0.5"),
    Preset(
        "The second sheet of figure 14 a: a smaller G",
        **_RIS,
        h=0.0,
        f=1.0,
        starts="2.5,-0.92",
        window="2,-0.97;2.6,-0.86",
        count=600.0,
    ),
    Preset(
        "Where the two Hess cycles meet, over h",
        **_RIS,
        h=2.0,
        f=1.0,
        starts="-0.1497,0.2064",
        reach=2.0,
        periodic="period 1",
        over="h",
        low=0.4,
        high=2.2,
    ),
)


@dataclass(frozen=True)
class EulerPoisson(FilledState):
    """A section of a heavy body at one energy and area integral, with orbits on both sides of the barrier."""

    I1: float = parameter(I1)
    I2: float = parameter(I2)
    I3: float = parameter(I3)
    away: float = number(
        "ε",
        0.0,
        (-0.5, 0.5),
        0.005,
        bounds=(-math.pi, math.pi),
        label="Angle off the Hess condition, ε",
        doc="Angle, in radians, by which the centre of mass r is rotated away from the direction of the Hess "
        "condition. At 0 no orbit crosses the barrier r·M = 0.",
    )
    m: float = parameter(MU_R)
    h: float = parameter(H_HEAVY, softbounds=(-1.0, 60.0), doc="Energy, H = h.")
    f: float = parameter(F_HEAVY, doc="(M, γ) = f; the section needs G ≥ |f|.")
    orbits: float = orbits_spread(60.0, 200.0, 400.0)
    count: float = points_of_each(300.0)
    over: str = parameter_of_branch(tuple(_OVER))
    low: float = end_of_branch("from")
    high: float = end_of_branch("to")
    upwards: str = coordinate_of_branch(_NAMES)
    span: float = time_span(20.0, 200.0, what="the chosen orbit")
    long: float = exponent_time(200.0, 1000.0, 1e4, "the Lyapunov exponent is")
    turns: str = choice(
        "Rotation number",
        (_ALONG, _ABOUT),
        _ALONG,
        doc="Turns counted by the angle l, on a vertical line through the first chosen start; or about "
        "the middle of the window, on a line from there to the right.",
    )
    sheet: str = choice(
        "Sheet",
        (_LARGEST, _SECOND),
        _LARGEST,
        doc="Momentum G at the start, where several G have this energy at one point of the section.",
    )
    shade: str = shading()
    starts: str = points("The points of the chosen orbits", 12, *_BOUNDS, "0,0.2")
    window: str = points("The window of the section", 2, *_BOUNDS)

    weights: ClassVar[tuple[float, ...]] = (0.0, 0.0, 0.0, *(0.5 * PIXELS,) * 3)

    def limits(self) -> Mapping[str, Slider]:
        """Return slider ranges of the energy, from its minimum, and of the ordered moments."""
        bottom = -math.floor(100.0 * abs(self.m)) / 100.0
        return {
            **limits_of_moments(*self.moments),
            "h": (bottom, max(60.0 if abs(self.m) > 2.0 else 6.0, bottom + 1.0), 0.01),
        }

    # ---- the motion ---------------------------------------------------------------------------------------------

    @property
    def moments(self) -> tuple[float, float, float]:
        """The principal moments of inertia."""
        return self.I1, self.I2, self.I3

    @cached_property
    def body(self) -> HeavyBody:
        """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return HeavyBody.hess(self.moments, self.m, self.away)

    @cached_property
    def poincare(self) -> AndoyerSection:
        """The section in (l, L/G)."""
        return AndoyerSection(self.body, self.h, self.f, (_LARGEST, _SECOND).index(self.sheet))

    # ---- the parts ----------------------------------------------------------------------------------------------

    @part
    def split(self) -> HessSplit:
        """The splitting of the separatrices."""
        return HessSplit(self, HessTorus(self.moments, self.m, self.h, self.f), self.away)

    section = part(lambda s: filled_section(s, 16, compute=_crossings, max_steps=200_000))

    @part
    def clicks(self) -> Clicks:
        """The starts of the chosen orbits."""
        which, remedy = ("the second sheet", "the largest G") if self.poincare.sheet else ("the section", _MORE)
        return Clicks(self, f"no motion with this h and f crosses {which}", remedy)

    density = part(
        lambda s: SectionDensity(
            s.section, s.shows_density, 2, lambda states: (relation(s.body, states) <= 0.0).astype(int)
        )
    )
    branch = part(lambda s: SectionBranch(s, s.periodic_orbit, _OVER, ("sheet",)))

    @part
    def surface(self) -> HessSurface:
        """The torus of the Hess manifold in space, with the orbit."""
        torus = HeavyTorus(self, HeavyHess(self.moments, self.m, self.h, self.f))

        def orbit() -> tuple[Array, Array]:
            bridge, path = torus.heavy.bridge, self.orbit.path
            return bridge.hess.in_units_of_b(bridge.to_reduced(path.states)), path.times

        def says() -> str:
            if self.away != 0.0:
                return "The torus belongs to ε = 0 and is not invariant here."
            off = float(np.max(np.abs(relation(self.body, self.orbit.path.states))))
            return f"The orbit has |r·M| up to {digits(off, 3)}; on the torus r·M = 0."

        return HessSurface(torus, self.shade == INVARIANT, orbit, says)

    rotation = part(lambda s: RotationAcross(s, s.section, lambda: s.clicks.selection.points[0], s.turns == _ABOUT))

    def start_at(self, x: float, y: float) -> Values:
        """Return the parameter values of an orbit that starts at a point of the section."""
        return self.clicks.move(x, y)

    # ---- the pictures -------------------------------------------------------------------------------------------

    def track(self) -> Columns:
        """Return the columns of the orbit."""
        orbit = self.orbit.path
        l, x = self.poincare.points_of(orbit.states).T
        return {"t": column(orbit.times), "l": column(l), "x": column(x), **gamma_columns(orbit.states[:, 3:])}

    @cached_property
    def solid(self) -> Solid:
        """The body along the orbit."""
        return heavy_solid(self.body, self.orbit.path.times, self.orbit.path.states)

    @cached_property
    def other_sheets(self) -> Array:
        """The points (n, 2) of all orbits on other sheets of the energy surface."""
        known = *self.section.known_orbits.chosen_batches, *self.section.known_orbits.batches
        return concatenate(batch.other_sheets for batch in known if batch.other_sheets is not None)

    def hess_curve(self) -> tuple[Array, Array]:
        """Return l and L/G of the curve r·M = 0 over the l of the window."""
        l = np.linspace(self.section.frame[0][0], self.section.frame[1][0], 241)
        return l, hess_curve(self.body, l)

    # ---- texts --------------------------------------------------------------------------------------------------

    def _about_section(self) -> Caption:
        if self.section_caption is not None:
            return self.section_caption
        kept = [one for batch in self.section.known_orbits.batches for one in batch.same_side]
        return Caption(
            "No orbit crosses r·M = 0." if self.away == 0.0 else "",
            f"{self.density.phrase}r·M keeps its sign along {sum(kept)} of {len(kept)} orbits.",
        )

    def quantities(self) -> Iterator[str]:
        """Yield a and r, the start of the orbit and the check of the body."""
        yield f"a = {digits(self.body.hess_a)}, r = {vector(self.body.r)}"
        yield from super().quantities()
        if self.section.has_result("known_orbits") and len(self.other_sheets):
            yield f"on another sheet: {len(self.other_sheets)} points"
        yield self.body.check.sentence


def _crossings(
    section: AndoyerSection, starts: tuple[Start, ...], crossings: int, forward: bool, level: Level, most: int
) -> OrbitBatch:
    found = section_crossings(section, starts, crossings, level, threads=1, max_steps=most)
    signs = np.sign(relation(section.body, np.array(starts)))
    kept = (
        bool(np.all(sign * relation(section.body, states) >= 0.0))
        for states, sign in zip(found.states, signs, strict=True)
    )
    other = [section.points_of(states)[~section.is_on(states)] for states in found.states]
    return replace(
        batch_of(section, found),
        first_kind=tuple(bool(sign > 0.0) for sign in signs),
        same_side=tuple(kept),
        other_sheets=as_read_only(concatenate(other)),
    )


SCENE = Scene(
    EulerPoisson,
    __file__,
    place=11,
    presets=PRESETS,
    level_trials=(*section_trials(orbits=40.0), exponent_trial(), rotation_trial()),
    charts=Charts(
        motion_charts(SYSTEM, lambda s: start_on(s.poincare, s.starts), time=lambda s: s.long),
        over=_NAMES,
        point=("starts", _NAMES),
    ),
    group="Euler–Poisson",
    essential=("away", "h", "f"),
    answers=(
        Answer("In the Hess case no orbit crosses the curve of the Hess relation.", lambda s: s.away == 0.0),
        Answer("Each dot is one return: dots on a curve look regular, a cloud of dots looks chaotic."),
    ),
    title="Euler–Poisson: sections",
    summary="A heavy body in the Hess case and near it: two stochastic layers with a barrier, and a meandering torus.",
    swarm=turned_swarm(lambda s, states: dict(zip("lx", s.poincare.points_of(states).T, strict=True)), angles=("l",)),
    tracks={"orbit": EulerPoisson.track},
    angles=("l",),
    views=(
        filled_picture(
            ((-math.pi, -1.0), (math.pi, 1.0)),
            axes=_NAMES,
            title="Section g = π/2 (Andoyer–Deprit)",
            caption=EulerPoisson._about_section,
            labels=("r·M > 0", "r·M < 0"),
            dot=("l", "x"),
            between=andoyer.middle_layers(
                other_sheets=lambda s: s.other_sheets,
                curve=EulerPoisson.hess_curve,
                across=lambda s: crop(s.rotation.ends, s.section.frame),
            ),
        ),
        body_picture(wheels=False, section=True),
        rotation_picture(),
        orbit_sphere(
            lambda s: Direction(math.copysign(1.0, s.m) * np.array(s.body.r), "r"),
            lambda s: s.proof.circles,
            lambda s: s.clicks.colour,
        ),
        exponent_picture(button="Show the Lyapunov exponent"),
        surface_picture(lambda s: s.surface, button="Show the torus in space"),
        split_picture(lambda s: s.split),
        branch_picture(),
    ),
)
