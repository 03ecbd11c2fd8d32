"""Scattering of the free Suslov problem (S4): from the circle θ⁻ and the phase φ to the circle θ⁺."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hess_explorer.protocol.parameters import Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, refuse
from hess_explorer.scenes.free_suslov import body_of, limits
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.graph import Graph
from hess_explorer.views.poisson_sphere import Circle, Mark, PoissonSphere
from hess_explorer.views.scattering_map import ANGLE_TICKS, POLAR_TICKS, ScatteringMap
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import nice_above, sphere_columns
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody
from hess_mechanics.suslov.free import Equilibria, FreeMotion, equilibria, free_motion, sample_times
from hess_mechanics.suslov.scattering import Scattering, cos_chi, scattering, start

_GRIDS = {False: (240, 120), True: (120, 60)}
"""Cells of the map; fewer while a slider is dragged."""

_PHASES = np.linspace(-math.pi, math.pi, 361)
_MOST = 4000
_MOST_DIGITS = 12.0

SPECS = (
    Number("I22", "I₂₂", "Inertia I₂₂", 1.0, 0.2, 3.0, 0.01, 1e-3, 1e3,
           "Moment of inertia about the second body axis."),
    Number("I13", "I₁₃", "Inertia I₁₃", 0.0, -1.0, 1.0, 0.01, -1e3, 1e3, "Product of inertia."),
    Number("I23", "I₂₃", "Inertia I₂₃", 0.8, -1.0, 1.0, 0.01, -1e3, 1e3,
           "Product of inertia; not 0 together with I₁₃."),
    Number("k", "k", "k, drives I₁₁", 2.0, -2.0, 7.0, 0.05, -50.0, 50.0,
           "I₁₁ = I₂₂ + k|k| (I₁₃² + I₂₃²)/I₂₂. With I₁₃ = 0 and k odd all orbits are reversed: θ⁺ = π − θ⁻."),
    Number("theta", "θ⁻", "Angle θ⁻ of the circle left", math.pi / 2, 0.0, 3.14, 0.01, 0.0, math.pi,
           "The angle between ξ and γ at the start, in radians."),
    Number("phi", "φ", "Phase φ of the orbit shown", 0.5, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "Where on that circle γ starts, in radians."),
    Number("digits", "−lg δ", "Distance δ of the start, digits", 5.30103, 1.0, 12.0, 0.05, 0.5, 300.0,
           "The start is δ = 10^−digits of |ω| away from the unstable point; it only shifts the phase."),
    ACCURACY,
)

PRESETS = (
    Preset("I₁₁ = 3.56, θ⁻ = π/2 (figure 5)", {}),
    Preset("k = 1: complete reversal, the curve is flat", {"k": 1.0, "theta": 1.0}),
    Preset("k = 3: complete reversal again", {"k": 3.0, "I23": 0.4, "theta": 1.0}),
    Preset("k = 2, small θ⁻", {"theta": 0.3}),
    Preset("k² < 0: I₁₁ below I₂₂", {"k": -0.9, "I23": 0.5, "theta": 1.2}),
    Preset("I₁₃ ≠ 0", {"I13": 0.3, "I23": 0.5, "k": 1.7, "theta": 1.2}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbit; θ⁺(φ)</li>
<li><span class="line second" style="border-top-style: dashed"></span>closed form</li>
<li><span class="line stable"></span>circle joined</li>
<li><span class="line unstable"></span>circle left</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="dot" style="background: #808080"></span>fixed points Γ = ±1</li>
<li><span class="box rho"></span>θ⁺ from 0 to π</li>
</ul>
"""

THUMBNAIL = """
<path d="M4 28h40M4 28V3" fill="none" stroke="#808080" stroke-width="1.5"/>
<path d="M5 20C12 2 18 2 24 14S37 28 44 10" fill="none" stroke="#0072B2" stroke-width="2.5"/>
<path d="M5 16h39" stroke="#CC79A7" stroke-width="1.5" stroke-dasharray="3 3"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class ScatteringResult:
    """`map` is of the start that is shown, `limit` of δ → 0; `closed`: the closed form of its cos χ.

    `orders`: pairs (k, cos χ); `grid`, `orders`, `orbit` where a picture asks.
    """

    values: Values
    body: SuslovBody
    map: Scattering
    limit: Scattering
    closed: float
    curve: Array
    grid: Array | None
    orders: Array | None
    orbit: FreeMotion | None
    points: Equilibria
    ended: str


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """Next to a slanting line a double keeps the start to 1e-16 only; on an axis it may be as close as it likes."""
    if float(values["I13"]) * float(values["I23"]) == 0.0 or float(values["digits"]) <= _MOST_DIGITS:
        return dict(values), []
    return {**values, "digits": _MOST_DIGITS}, [
        f"With I₁₃I₂₃ ≠ 0 a start is known to 1e−16 only: its distance is 1e−{_MOST_DIGITS:g} now."]


def _grid_of(found: Scattering, m: int, n: int) -> Array:
    phi = -math.pi + (np.arange(m) + 0.5) * (2 * math.pi / m)
    theta_minus = (np.arange(n) + 0.5) * (math.pi / n)
    return frozen(found.theta_plus(theta_minus[:, None], phi[None, :]))


def _range_of_k(k: float) -> tuple[int, int]:
    """The horizontal axis of cos χ."""
    return min(0, math.floor(k)), max(7, math.ceil(k))


def _orders(I22: float, I13: float, I23: float, low: int, high: int) -> Array:
    """(k, cos χ) in rows, where k gives a body that is in bounds."""
    rows = []
    for k in np.linspace(low, high, 20 * (high - low) + 1):
        try:
            rows.append((k, cos_chi(body_of({"I22": I22, "I13": I13, "I23": I23, "k": float(k)}))))
        except ModelError:
            continue
    return frozen(np.array(rows).reshape(-1, 2))


def _unit_rate(body: SuslovBody) -> float:
    """The energy with ω0 = 1: nothing else depends on it."""
    return 1.0 / equilibria(body, 1.0).rate ** 2


def _start(values: Values) -> tuple[SuslovBody, float, tuple[float, float], tuple[float, float, float]]:
    body = body_of(values)
    h = _unit_rate(body)
    distance = 10.0 ** -float(values["digits"])
    return body, h, *start(body, h, float(values["theta"]), float(values["phi"]), distance)


def _span(values: Values) -> float:
    """Until γ has settled on the second circle: as long after the passage as before it."""
    return 2.0 * math.log(10.0) * float(values["digits"]) + 8.0


def _orbit(body: SuslovBody, omega: tuple[float, float], gamma: tuple[float, float, float], span: float,
           accuracy: Any) -> FreeMotion:
    radius = 0.5 * PIXELS
    return free_motion(body, omega, gamma, sample_times(body, omega, span, (1.0, radius), SAGITTA, _MOST), accuracy)


def compute(values: Values, shown: Collection[str], dragging: bool) -> ScatteringResult:
    """One rotation gives the curve and the map; the orbit is that of the phase chosen."""
    work = Work(values, dragging)
    accuracy = work.level
    body, h, omega, gamma = _start(values)
    found = work.get(scattering, body, accuracy, 1, 10.0 ** -float(values["digits"]))
    return ScatteringResult(
        values=values, body=body, map=found, limit=work.get(scattering, body, accuracy), closed=cos_chi(body),
        curve=found.theta_plus(float(values["theta"]), _PHASES),
        grid=work.get(_grid_of, found, *_GRIDS[dragging]) if "map" in shown else None,
        orders=work.get(_orders, *(float(values[name]) for name in ("I22", "I13", "I23")),
                      *_range_of_k(float(values["k"]))) if "chi" in shown else None,
        orbit=work.get(_orbit, body, omega, gamma, _span(values), accuracy) if shown else None,
        points=equilibria(body, h), ended=work.ended())


def motion(values: Values) -> Motion:
    """The orbit as one of the general system, for "Speed and accuracy".  Raises `ModelError`."""
    body, _, omega, gamma = _start(values)
    radius = 0.5 * PIXELS
    return Motion(SYSTEM, (*omega, *gamma), body.parameters, _span(values), (1.0, 1.0, radius, radius, radius), 1.0)


class ScatteringStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.curve = Graph(wire, "curve", ("φ", "θ⁺"), (-math.pi, math.pi), (0.0, math.pi),
                           [Series("theta", theme.ORBIT)], picks=("tap", "doubletap", "pan"),
                           ticks=ANGLE_TICKS, y_ticks=POLAR_TICKS)
        self.map = ScatteringMap(wire)
        self.chi = Graph(wire, "chi", ("k", "cos χ"), (0.0, 7.0), (-1.05, 1.05),
                         [Series("closed", theme.MAP, "dashed")], picks=("tap", "doubletap", "pan"))
        self.sphere = PoissonSphere(wire, {"data-orbit": "orbit"})
        # The sphere and the player read the orbit from the source of that name; the map does not show it.
        self.map.add("orbit", "line", ("phase", "polar"), source="data-orbit", visible=False)
        self.pictures = (self.curve, self.map, self.chi, self.sphere)

    def show(self, result: ScatteringResult, hold_axes: bool) -> Report:
        """Draw the curve, the map, cos χ and the orbit."""
        theta_minus, phi, k = (float(result.values[name]) for name in ("theta", "phi", "k"))
        for view in (self.curve, self.map, self.chi):
            view.say("")
        self.curve.show("theta", _PHASES, result.curve)
        self.curve.show_levels([theta_minus, math.pi - theta_minus])
        theta_plus = float(result.map.theta_plus(theta_minus, phi))
        self.curve.choose(phi, theta_plus)
        if result.grid is not None:
            self.map.show(result.grid)
        self.map.choose(phi, theta_minus)
        if result.orders is not None:
            self.chi.show("closed", result.orders[:, 0], result.orders[:, 1])
            if not hold_axes:
                reach = nice_above(max(1e-3, 1.0 + float(result.orders[:, 1].max(initial=result.limit.cos_chi))))
                self.chi.set_ranges(_range_of_k(k), (-1.0 - 0.05 * reach, -1.0 + 1.05 * reach))
            self.chi.choose(k, result.limit.cos_chi)
        orbit, xi = result.orbit, result.points.xi
        if orbit is not None:
            polar = np.arccos(np.clip(orbit.Gamma, -1.0, 1.0))
            self.map.assign("orbit", t=orbit.times.astype(np.float32), phase=orbit.phase.astype(np.float32),
                            polar=polar.astype(np.float32), **sphere_columns(orbit.omega, orbit.gamma))
        self.sphere.show(xi, "ξ", [Circle(xi, math.cos(theta_minus), "unstable"),
                                   Circle(xi, math.cos(theta_plus), "stable")], [Mark(xi, "muted"), Mark(-xi, "muted")])
        for picture, text in zip(self.pictures, _captions(result, theta_plus), strict=True):
            self.wire.say(picture.name, text)
        return Report(_derived(result), _status(result), _notes(result))

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click on the curve chooses φ, on the map φ and θ⁻, on the graph of cos χ the k."""
        return {"curve": {"phi": x}, "map": {"phi": x, "theta": y}, "chi": {"k": x}}.get(picture, {})


def _captions(result: ScatteringResult, theta_plus: float) -> tuple[str, str, str, str]:
    low, high = float(result.curve.min()), float(result.curve.max())
    spread = f"θ⁺ = {number(low)} for every φ" if high - low < 1e-4 else f"θ⁺ from {number(low)} to {number(high)}"
    computed = result.limit.cos_chi
    return (
        f"θ⁺ against the phase φ\nθ⁻ = {number(float(result.values['theta']))}: {spread} (dotted: θ⁻, π − θ⁻).",
        f"θ⁺ over (φ, θ⁻)\nAll of it from one rotation, which turns ξ by χ = {number(math.acos(computed))}.",
        f"cos χ against k\nComputed {number(computed, 6)}; closed form {number(result.closed, 6)}, "
        f"difference {number(abs(computed - result.closed), 2)}.",
        f"Poisson sphere\nφ = {number(float(result.values['phi']))}: from θ⁻ = {number(float(result.values['theta']))} "
        f"to θ⁺ = {number(theta_plus)}.",
    )


def _derived(result: ScatteringResult) -> list[str]:
    k = float(result.values["k"])
    xi = result.points.xi
    return [
        f"I₁₁ = {number(result.body.I11, 6)}",
        f"k² = {number(k * abs(k), 6)}",
        f"cos χ = {number(result.limit.cos_chi, 12)}",
        f"φ* = {number(result.map.phi_star, 6)}",
        f"δ = {number(10.0 ** -float(result.values['digits']), 3)}",
        f"ξ = ({number(xi[0])}, {number(xi[1])}, 0)",
        "Time in units of 1/ω₀; θ⁺ does not depend on the energy",
    ]


def _status(result: ScatteringResult) -> str:
    found = result.map
    parts = [f"{found.level}: rotation {found.cost.steps} Taylor steps, error ≤ {found.error_estimate:.1e} "
             f"({found.status})"]
    if result.orbit is not None:
        parts.append(f"orbit {result.orbit.times.size} points, error ≤ {result.orbit.error_estimate:.1e}")
        parts.append("drift " + " ".join(f"{name} {drift:.0e}" for name, drift in result.orbit.drift.items()))
    parts.append(result.ended)
    return " · ".join(parts).replace("e-", "e−")


def _notes(result: ScatteringResult) -> list[str]:
    digits = float(result.values["digits"])
    if result.body.I13 * result.body.I23 != 0.0 and digits > 8.0:
        return ["With I₁₃I₂₃ ≠ 0 the start of the orbit is rounded to 1e−16: its passage is a little early or late, "
                f"and its Γ⁺ is off by up to 1e−{16.0 - digits:.0f}."]
    return []


SCENE = Scene(
    name="scattering",
    title="Scattering",
    summary="No field: from the circle γ leaves and its phase to the circle it joins, exact for all phases at once.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("curve", "map", "chi", "sphere"),
    compute=compute,
    stage=ScatteringStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=4,
)
