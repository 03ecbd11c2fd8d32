"""The free Suslov problem (S2, S3): passages from the unstable to the stable half of a line of equilibria."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.protocol.parameters import Choice, Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, orbit_status, refuse
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.graph import Graph
from hess_explorer.views.poisson_sphere import Circle, Mark, PoissonSphere
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import VelocityPlane, nice_above, sphere_columns
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov import additional_integral
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody
from hess_mechanics.suslov.free import (
    Equilibria,
    FreeMotion,
    arcs,
    equilibria,
    free_motion,
    passage,
    rotation,
    sample_times,
)

_MOST = 4000
_LEVELS = (0.25, 0.6, 1.6)
"""Energies of the other ellipses drawn, in that of the orbit."""
_ROOM_BELOW = (-1.25, 1.05)
"""The axis of γ₁, with room for the name of the other axis."""

SPECS = (
    Number("I22", "I₂₂", "Inertia I₂₂", 1.0, 0.2, 3.0, 0.01, 1e-3, 1e3,
           "Moment of inertia about the second body axis."),
    Number("I13", "I₁₃", "Inertia I₁₃", 0.0, -1.0, 1.0, 0.01, -1e3, 1e3,
           "Product of inertia; with I₂₃ it sets the line of equilibria I₁₃ω₁ + I₂₃ω₂ = 0."),
    Number("I23", "I₂₃", "Inertia I₂₃", 0.5, -1.0, 1.0, 0.01, -1e3, 1e3,
           "Product of inertia; not 0 together with I₁₃."),
    Number("k", "k", "k, drives I₁₁", 2.4, -2.0, 7.0, 0.05, -50.0, 50.0,
           "I₁₁ = I₂₂ + k|k| (I₁₃² + I₂₃²)/I₂₂. With I₁₃ = 0 and k odd there is an additional integral F₂."),
    Number("w1", "ω₁", "Angular velocity ω₁(0)", 2.0, -4.0, 4.0, 0.01, -1e3, 1e3, "At the start."),
    Number("w2", "ω₂", "Angular velocity ω₂(0)", 1e-4, -4.0, 4.0, 0.01, -1e3, 1e3,
           "At the start; however close to the line of equilibria, 1e-300 too."),
    Number("Gamma", "Γ", "Γ(0) = (ξ, γ)", 0.4984, -1.0, 1.0, 0.01, -1.0, 1.0,
           "Where γ starts: the height along ξ of its circle on the sphere."),
    Number("phi", "φ", "Phase φ(0)", 1.2672, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "Where γ starts on that circle, in radians."),
    Number("phi2", "φ′", "Phase of the second orbit", -0.6, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "A second orbit with the same ω leaves the same circle Γ⁻, turned along it by φ′ − φ."),
    Number("span", "t", "Time span", 30.0, 1.0, 100.0, 1.0, 0.01, 1e5, "How long the orbit is followed."),
    Choice("across", "γ₁ against", ("time", "phase"), "time", "The horizontal axis of the third picture: t or φ."),
    ACCURACY,
)

# The figure's caption: tan φ = 0.85/0.28 and 0.53/0.72.
_ON_CIRCLE = {"w1": 2.0, "w2": 1e-3, "Gamma": -0.44, "phi": 1.2526, "phi2": 0.6346}


def _portrait(I13: float, I23: float) -> Values:
    """Next to the unstable half, whose direction is (I23, −I13)."""
    return {"I13": I13, "I23": I23, "k": 1.0, "w1": math.copysign(1.4, I23), "w2": math.copysign(0.9, -I13),
            "Gamma": 0.7, "phi": 0.5, "span": 20.0}


PRESETS = (
    Preset("γ₁(t): I₁₁ = 2.44, I₂₃ = 0.5 (figure 3)", {"across": "time"}),
    Preset("γ₁(φ): the same orbit (figure 3)", {"across": "phase"}),
    Preset("Γ(t), k = 1: F₂ exists, Γ⁺ = −Γ⁻", {**_ON_CIRCLE, "k": 1.0}),
    Preset("Γ(t), k = 3: F₂ exists, Γ⁺ = −Γ⁻", {**_ON_CIRCLE, "k": 3.0}),
    Preset("Γ(t), k = 1.5: two phases, two circles", {**_ON_CIRCLE, "k": 1.5}),
    Preset("Γ(t), I₁₃ ≠ 0: two phases, two circles", {
        "I13": 0.4, "I23": 0.6, "k": 1.2, "w1": 3.0, "w2": -2.001, "Gamma": -0.4647, "phi": math.pi, "phi2": 1.634}),
    Preset("Portrait, I₁₃ > 0, I₂₃ < 0 (figure 2)", _portrait(0.4, -0.5)),
    Preset("Portrait, I₁₃ > 0, I₂₃ > 0", _portrait(0.4, 0.5)),
    Preset("Portrait, I₁₃ < 0, I₂₃ < 0", _portrait(-0.4, -0.5)),
    Preset("Portrait, I₁₃ < 0, I₂₃ > 0", _portrait(-0.4, 0.5)),
    Preset("Started 1e-300 from the line", {"w2": 1e-300, "span": 750.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbit</li>
<li><span class="line second"></span>second orbit</li>
<li><span class="line stable"></span>stable half, circle joined</li>
<li><span class="line unstable"></span>unstable half, circle left</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="dot" style="background: #808080"></span>fixed points Γ = ±1</li>
<li><span class="line muted"></span>energy levels; level of F₂</li>
</ul>
"""

THUMBNAIL = """
<ellipse cx="24" cy="16" rx="17" ry="11" fill="none" stroke="#0072B2" stroke-width="2"/>
<path d="M24 16 46 5" stroke="#D55E00" stroke-width="2.5" stroke-dasharray="4 3"/>
<path d="M24 16 2 27" stroke="#009E73" stroke-width="2.5"/>
<circle cx="39" cy="8.5" r="3" fill="none" stroke="#D55E00" stroke-width="2"/>
<circle cx="9" cy="23.5" r="3" fill="#009E73"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class FreeResult:
    """`points` are the equilibria with the energy h of the orbit; `arcs` both ways between them."""

    values: Values
    body: SuslovBody
    h: float
    points: Equilibria
    arcs: tuple[Array, Array]
    orbit: FreeMotion
    second: FreeMotion
    integral: additional_integral.AdditionalIntegral | None
    ended: str


def body_of(values: Values) -> SuslovBody:
    """The body with I11 from k.  Raises `NotPositiveDefinite`, `InvalidParameter`."""
    I22, I13, I23, k = (float(values[name]) for name in ("I22", "I13", "I23", "k"))
    if I13 == I23 == 0.0:
        raise InvalidParameter(
            "I₁₃ = I₂₃ = 0: without a field ω does not change, and there is no ξ. Choose one of them other than 0.")
    I11 = I22 + k * abs(k) * (I13 * I13 + I23 * I23) / I22
    if I11 <= 0.0:
        raise InvalidParameter(
            f"k = {number(k)} would make I₁₁ = {number(I11)}; a moment of inertia is positive. Choose a larger k.")
    return SuslovBody(I11, I22, I13, I23)


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """Everything is possible together; what is not a motion says so when it is computed."""
    return dict(values), []


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The slider of k begins where I11 is still positive."""
    I22, J2 = float(values["I22"]), float(values["I13"]) ** 2 + float(values["I23"]) ** 2
    lowest = -I22 / math.sqrt(J2) if J2 > 0.0 else -2.0
    return {"k": (max(-2.0, math.ceil(lowest * 19.0) / 20.0), 7.0, 0.05)}


def gamma_of(points: Equilibria, Gamma: float, phi: float) -> tuple[float, float, float]:
    """γ = Γξ + √(1−Γ²)(cos φ η + sin φ e3), η = e3 × ξ."""
    x1, x2, _ = points.xi
    across = math.sqrt(max(0.0, 1.0 - Gamma * Gamma))
    return (Gamma * x1 - across * math.cos(phi) * x2, Gamma * x2 + across * math.cos(phi) * x1, across * math.sin(phi))


def _half_width(body: SuslovBody, h: float) -> float:
    return nice_above(1.3 * math.sqrt(2.0 * h / min(body.I11, body.I22)))


def _start(values: Values) -> tuple[SuslovBody, tuple[float, float], float, Equilibria]:
    body = body_of(values)
    omega = (float(values["w1"]), float(values["w2"]))
    # It refuses what is no motion in the words of ω, as here the energy is none of the controls.
    passage(body, omega)
    h = 0.5 * (body.I11 * omega[0] ** 2 + body.I22 * omega[1] ** 2)
    if h == 0.0:
        raise InvalidParameter("The energy of so small an ω is 0 in double precision: choose a larger one.")
    return body, omega, h, equilibria(body, h)


def _motion(body: SuslovBody, omega: tuple[float, float], gamma: tuple[float, float, float], span: float,
            half_width: float, accuracy: Level) -> FreeMotion:
    radius = 0.5 * PIXELS
    times = sample_times(body, omega, span, (radius / half_width, radius), SAGITTA, _MOST)
    return free_motion(body, omega, gamma, times, accuracy)


def _second_motion(body: SuslovBody, omega: tuple[float, float], gamma: tuple[float, float, float], turn: float,
                   span: float, half_width: float, accuracy: Level) -> FreeMotion:
    """The motion that comes from the same circle Γ⁻ as that of γ, turned along it by `turn`."""
    # Γ⁻ = (n, γ(0)).
    n = rotation(body, omega, [span], accuracy).limits[0]
    n = n / np.linalg.norm(n)
    g = np.array(gamma)
    g = n * (n @ g) + math.cos(turn) * (g - n * (n @ g)) + math.sin(turn) * np.cross(n, g)
    return _motion(body, omega, (float(g[0]), float(g[1]), float(g[2])), span, half_width, accuracy)


def compute(values: Values, shown: Collection[str], dragging: bool) -> FreeResult:
    """Two orbits from one circle of γ."""
    work = Work(values, dragging)
    accuracy = work.level
    body, omega, h, points = _start(values)
    width = _half_width(body, h)
    phi, span = float(values["phi"]), float(values["span"])
    gamma = gamma_of(points, float(values["Gamma"]), phi)
    orbit = work.get(_motion, body, omega, gamma, span, width, accuracy)
    second = work.get(_second_motion, body, omega, gamma, float(values["phi2"]) - phi, span, width, accuracy)
    return FreeResult(
        values=values, body=body, h=h, points=points, arcs=arcs(body, h), orbit=orbit, second=second,
        integral=additional_integral.of_body(body), ended=work.ended())


def motion(values: Values) -> Motion:
    """The orbit as one of the general system, for "Speed and accuracy".  Raises `ModelError`."""
    body, omega, h, points = _start(values)
    gamma = gamma_of(points, float(values["Gamma"]), float(values["phi"]))
    radius = 0.5 * PIXELS
    w = radius / _half_width(body, h)
    return Motion(SYSTEM, (*omega, *gamma), body.parameters, float(values["span"]), (w, w, radius, radius, radius), 1.0)


class FreeStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {
        "omega-point": ("omega1", "omega2"), "gamma1-point": ("across", "g1"), "Gamma-point": ("t", "Gamma"),
    }
    angles: Sequence[str] = ("across",)

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.omega = VelocityPlane(wire)
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit", "data-second": "second"})
        both = [Series("second", theme.MAP, "dotdash"), Series("first", theme.ORBIT)]
        self.gamma1 = Graph(wire, "gamma1", (" ", "γ₁"), (0.0, 30.0), _ROOM_BELOW, both)
        self.Gamma = Graph(wire, "Gamma", ("t", "Γ"), (0.0, 30.0), (-1.05, 1.05), both)
        self.pictures = (self.omega, self.sphere, self.gamma1, self.Gamma)

    def show(self, result: FreeResult, hold_axes: bool) -> Report:
        """Draw both orbits, the line, the circles."""
        orbit, second, points = result.orbit, result.second, result.points
        width = _half_width(result.body, result.h)
        span = float(result.values["span"])
        by_phase = result.values["across"] == "phase"
        period = 2.0 * math.pi if by_phase else None
        if not hold_axes:
            self.omega.fit(width)
            self.Gamma.set_ranges((0.0, span), (-1.05, 1.05))
            self.gamma1.set_ranges((-math.pi, math.pi) if by_phase else (0.0, span), _ROOM_BELOW)
        for graph in (self.gamma1, self.Gamma, self.omega):
            graph.say("")
        self.gamma1.name_across("φ" if by_phase else "t")
        self.omega.show_levels([math.sqrt(share) * arc for share in _LEVELS for arc in result.arcs], width)
        self.omega.show_line(points.stable, points.unstable, width)
        self.omega.show_arcs(result.arcs, width)
        across = orbit.phase if by_phase else orbit.times
        self.omega.assign("orbit", t=orbit.times.astype(np.float32), Gamma=orbit.Gamma.astype(np.float32),
                          across=across.astype(np.float32), **sphere_columns(orbit.omega, orbit.gamma))
        self.omega.assign("second", **sphere_columns(second.omega, second.gamma))
        for name, one in (("first", orbit), ("second", second)):
            self.gamma1.show(name, one.phase if by_phase else one.times, one.gamma[:, 0], period)
            self.Gamma.show(name, one.times, one.Gamma)
        self.Gamma.show_levels([*orbit.limits, second.limits[1]])
        self._show_sphere(result)
        for picture, text in zip(self.pictures, _captions(result), strict=True):
            self.wire.say(picture.name, text)
        return Report(_derived(result), _status(result), _notes(result))

    def _show_sphere(self, result: FreeResult) -> None:
        xi = result.points.xi
        circles = [Circle(xi, result.orbit.limits[0], "unstable"), Circle(xi, result.orbit.limits[1], "stable"),
                   Circle(xi, result.second.limits[1], "stable")]
        if result.integral is not None:
            f = _level_of_F2(result)
            for omega in result.arcs[0 if result.orbit.passage.arc > 0 else 1][5:-5:8]:
                V = result.integral.vector(omega)
                length = float(np.linalg.norm(V))
                circles.append(Circle(V / length, f / length, "muted"))
        marks = [Mark(xi, "muted"), Mark(-xi, "muted")]
        self.sphere.show(xi, "ξ", circles, marks)

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the plane chooses ω(0)."""
        return {"w1": x, "w2": y} if picture == "omega" else {}


def _captions(result: FreeResult) -> tuple[str, str, str, str]:
    orbit, second, points = result.orbit, result.second, result.points
    came, went, other = (number(Gamma) for Gamma in (*orbit.limits, second.limits[1]))
    by = "phase φ about ξ" if result.values["across"] == "phase" else "time"
    return (
        f"Angular velocity (ω₁, ω₂)\nFrom the unstable to the stable point at rate ω₀ = {number(points.rate)}, "
        f"E = {number(result.h)}.",
        f"Poisson sphere\n{_circles(result, came, went, other)}",
        f"γ₁ against {by}\nIn the end γ turns about ξ at {number(points.speed)} radians a unit of time.",
        f"Γ = (ξ, γ) against time\nFrom Γ⁻ = {came} to Γ⁺ = {went} and {other} (dotted).",
    )


def _circles(result: FreeResult, came: str, went: str, other: str) -> str:
    if result.integral is None:
        return f"From the circle Γ⁻ = {came} about ξ to Γ⁺ = {went} and {other}."
    return f"F₂ = {number(_level_of_F2(result))}: both from the cycle C⁻, Γ = {came}, to C⁺, Γ = {went}."


def _level_of_F2(result: FreeResult) -> float:
    assert result.integral is not None
    return float(result.integral(result.orbit.omega[0], result.orbit.gamma[0]))


def _derived(result: FreeResult) -> list[str]:
    body = result.body
    squared = float(result.values["k"]) * abs(float(result.values["k"]))
    rows = [
        f"I₁₁ = {number(body.I11, 6)}",
        f"k² = {number(squared, 6)}",
        f"E = {number(result.h, 6)}",
        f"ω₀ = {number(result.points.rate, 6)}",
        f"|ω±| = {number(result.points.speed, 6)}",
        f"ξ = ({number(result.points.xi[0])}, {number(result.points.xi[1])}, 0)",
    ]
    if result.integral is None:
        rows.append("F₂: none known (I₁₃ = 0 and k odd, or the like)")
    else:
        rows.append(f"F₂, degree {result.integral.k} in ω: f = {number(_level_of_F2(result), 6)}")
        rows.append(f"F₂ at the fixed points: ±{number(abs(result.integral.at_fixed_points(result.h)[0]), 6)}")
    return rows


def _status(result: FreeResult) -> str:
    return " · ".join([*orbit_status(result.orbit), result.ended]).replace("e-", "e−")


def _notes(result: FreeResult) -> list[str]:
    notes = []
    orbit = result.orbit
    if orbit.times.size >= _MOST:
        notes.append(f"So long a motion is drawn with {_MOST} points: its uniform turning is thinned out.")
    needed = -orbit.passage.u0 / result.points.rate
    if needed > float(result.values["span"]):
        notes.append(f"The passage comes at t = {number(needed)}: choose a longer time span to see it.")
    return notes


SCENE = Scene(
    name="free-suslov",
    title="Free Suslov problem",
    summary="No field: ω passes from an unstable to a stable state; γ leaves one circle and joins another.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("omega", "sphere", "gamma1", "Gamma"),
    compute=compute,
    stage=FreeStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=2,
)
