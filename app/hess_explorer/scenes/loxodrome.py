"""The loxodromic pendulum (S14): a heavy body in the Hess case with area integral 0, as it moves in space."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.protocol.parameters import Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Motion, Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, orbit_status, refuse
from hess_explorer.views import theme
from hess_explorer.views.body import BodyView, Curve, Rod, Shape
from hess_explorer.views.figure import Figure
from hess_explorer.views.poisson_sphere import Circle, Mark
from hess_explorer.views.text import number
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.loxodromic_pendulum import LoxodromicMotion, LoxodromicPendulum, loxodromic_motion
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.equations import SYSTEM

_SWING = (-1.05, 1.05)
_ANGLES = (0.0, math.pi)
_TO_THE_POLE = 0.02
"""The loxodrome never comes to its poles: it is drawn to this distance from them."""
_MOST_TURNS = 30.0
_DRAWN = 2000

SPECS = (
    Number("I1", "I₁", "Moment I₁", 1.0, 0.1, 3.0, 0.005, 1e-3, 1e3, "First principal moment of inertia."),
    Number("I2", "I₂", "Moment I₂", 1.5, 0.1, 3.0, 0.005, 1e-3, 1e3,
           "Middle principal moment: it must lie between I₁ and I₃."),
    Number("I3", "I₃", "Moment I₃", 2.0, 0.1, 3.0, 0.005, 1e-3, 1e3, "Third principal moment of inertia."),
    Number("m", "μ|r|", "Weight times distance, μ|r|", 0.7071, 0.05, 20.0, 0.05, 1e-3, 1e3,
           "It sets the unit of energy and of time; the direction of r follows from the moments."),
    Number("energy", "h", "Energy h", 1.5, -0.95, 4.0, 0.01, -1.0 + 1e-4, 1e4,
           "In units of μ|r|: −1 hanging at rest, 1 the separatrix, on which it comes to rest upright."),
    Number("l", "l", "Middle axis l(0)", 0.15, 0.02, 3.12, 0.01, 1e-3, math.pi - 1e-3,
           "Angle of the middle axis from M, which is horizontal, when the centre of mass passes its lowest place."),
    Number("span", "t", "Time span", 30.0, 1.0, 200.0, 1.0, 0.01, 1e4, "How long the motion is followed."),
    ACCURACY,
)

PRESETS = (
    Preset("h above: the whole loxodrome (gess-ris1)", {}),
    Preset("h below: a segment of it", {"energy": 0.3, "l": 1.1}),
    Preset("h at the separatrix: once, to the top", {"energy": 1.0, "l": 0.6}),
    Preset("Small swings", {"energy": -0.9, "l": 1.2}),
    Preset("The body of figure gess1, f = 0", {
        "I1": 1.0, "I2": 0.625, "I3": 0.375, "m": 9.975, "energy": 5.0, "l": 2.9, "span": 5.0}),
    Preset("Almost round: many turns", {"I1": 1.0, "I2": 1.03, "I3": 1.06, "energy": 2.0, "l": 0.1, "span": 150.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>middle axis, its track, θ</li>
<li><span class="line muted"></span>loxodrome; gyration ellipsoid</li>
<li><span class="line stable"></span>path of the centre of mass</li>
<li><span class="dot point"></span>centre of mass</li>
<li><span class="line second"></span>circular section; l</li>
</ul>
"""

THUMBNAIL = """
<circle cx="24" cy="16" r="13" fill="none" stroke="#808080"/>
<path d="M11 16C14 8 19 24 24 16C27 9 31 22 34 15C35 12 36 14 37 16" fill="none" stroke="#0072B2" stroke-width="2"/>
<ellipse cx="24" cy="16" rx="4" ry="13" fill="none" stroke="#009E73" stroke-width="1.5"/>
<circle cx="22" cy="28" r="3" fill="#F0E442" stroke="#000"/>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class LoxodromeResult:
    """One motion; `loxodrome` the closed form (n, 3), along (γ, e, γ × e)."""

    values: Values
    motion: LoxodromicMotion
    loxodrome: Array
    ended: str


def pendulum_of(values: Values) -> LoxodromicPendulum:
    """Raises `InvalidParameter`, `NotPositiveDefinite`, `OutsideRegion`."""
    I1, I2, I3, m, energy, l = (float(values[name]) for name in ("I1", "I2", "I3", "m", "energy", "l"))
    return LoxodromicPendulum(HeavyBody.hess((I1, I2, I3), m), energy, l)


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """Everything is possible together; what is no body of the Hess case says so when it is computed."""
    return dict(values), []


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """The slider of I2 between the two others."""
    low, high = sorted((float(values["I1"]), float(values["I3"])))
    return {"I2": (low, high, 0.005)} if high - low > 0.01 else {}


def loxodrome_of(pendulum: LoxodromicPendulum) -> Array:
    """All of the loxodrome but its last windings about the poles, (n, 3)."""
    reach = -math.log(math.tan(0.5 * _TO_THE_POLE))
    middle = math.log(math.tan(0.5 * pendulum.l))
    most = 2.0 * math.pi * _MOST_TURNS
    ends = [(side * reach - middle) / pendulum.a if abs(pendulum.a) * most > reach + abs(middle) else side * most
            for side in (-1.0, 1.0)]
    return pendulum.middle_axis_at(np.linspace(*ends, _DRAWN))


def compute(values: Values, shown: Collection[str], dragging: bool) -> LoxodromeResult:
    """The motion, from which all pictures are drawn."""
    work = Work(values, dragging)
    pendulum = pendulum_of(values)
    found = work.get(loxodromic_motion, pendulum, float(values["span"]), work.level)
    return LoxodromeResult(values, found, loxodrome_of(pendulum), work.ended())


def motion(values: Values) -> Motion:
    """The reduced motion, in units b = 1.  Raises `ModelError`."""
    pendulum = pendulum_of(values)
    radius = 0.5 * PIXELS
    w = radius / math.sqrt(2.0 * (pendulum.h + 1.0))
    return Motion(SYSTEM, tuple(pendulum.start[:5]), (pendulum.a, 1.0), pendulum.length(float(values["span"])),
                  (w, w, radius, radius, radius), 1.0 / pendulum.frequency_unit)


class LoxodromeStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {"angle-point": ("t", "l"), "height-point": ("t", "height")}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.body = BodyView(wire, "body", "The body in space", bare=True)
        self.space = BodyView(wire, "space", "Sphere fixed in space", attitude="body")
        self.angle = Figure(wire, "angle", ("t", "θ, l"), (0.0, 30.0), _ANGLES)
        for layer, color, dash in (("l", theme.MAP, "solid"), ("theta", theme.ORBIT, "solid"),
                                   ("promised", theme.MUTED, "dotted")):
            self.angle.add(layer, "line", ("x", "y"), color=color, line_dash=dash, line_width=2)
        self.angle.add_point_and_message()
        self.height = Figure(wire, "height", ("t", "height"), (0.0, 30.0), _SWING)
        self.height.add("orbit", "line", ("t", "height"), source="data-orbit", color=theme.STABLE, line_width=2)
        self.height.add_point_and_message()
        self.pictures = (self.body, self.space, self.angle, self.height)

    def show(self, result: LoxodromeResult, hold_axes: bool) -> Report:
        """Draw the body, the tracks, both angles."""
        found = result.motion
        if not hold_axes:
            for plot, y in ((self.angle, _ANGLES), (self.height, _SWING)):
                plot.set_ranges((0.0, float(result.values["span"])), y)
        for plot in (self.angle, self.height):
            plot.say("")
        self._show_body(result)
        self._show_space(result)
        span = float(found.times[-1])
        for layer, x, y in (("theta", *found.measured), ("l", found.times, found.l),
                            ("promised", [0.0, span], [found.pendulum.angle] * 2)):
            self.angle.assign(layer, x=np.asarray(x, np.float32), y=np.asarray(y, np.float32))
        self.height.assign("orbit", t=found.times.astype(np.float32), height=(-found.centre[:, 0]).astype(np.float32),
                           l=found.l.astype(np.float32))
        for picture, text in zip(self.pictures, _captions(result), strict=True):
            self.wire.say(picture.name, text)
        return Report(_derived(result), _status(result), _notes(result))

    def _show_body(self, result: LoxodromeResult) -> None:
        found = result.motion
        heavy = found.pendulum.body
        shape = Shape(np.eye(3), 1.0 / np.array(heavy.a), np.array(heavy.r)) if heavy.check.is_body else None
        self.body.show(shape, found.attitude, found.times, _rods(found, ""), [Curve(found.centre, "stable")])

    def _show_space(self, result: LoxodromeResult) -> None:
        found = result.motion
        poles = [Mark((1.0, 0.0, 0.0), "muted", "e"), Mark((-1.0, 0.0, 0.0), "muted", "−e")]
        curves = [Curve(result.loxodrome, "muted"), Curve(found.middle, "orbit"), Curve(found.centre, "stable")]
        plane = [Circle((1.0, 0.0, 0.0), 0.0, "limit")]
        self.space.show(rods=_rods(found, "2"), curves=curves, circles=plane, marks=poles)

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """Nothing is chosen by a click."""
        return {}


def _rods(found: LoxodromicMotion, label: str) -> list[Rod]:
    return [Rod((0.0, 1.0, 0.0), "orbit", label), Rod(found.pendulum.body.r, "mass")]


def _captions(result: LoxodromeResult) -> tuple[str, str, str, str]:
    found = result.motion
    pendulum = found.pendulum
    start, end = number(found.l[0]), number(found.l[-1])
    if pendulum.h < 1.0:
        reach = pendulum.amplitude
        low, high = sorted(map(float, pendulum.l_at(np.array([-reach, reach]))))
        track = f"Middle axis: to and fro on a segment of the loxodrome, l from {number(low)} to {number(high)}."
        swing = f"It swings to α = ±{number(reach)}; the height reaches h = {number(pendulum.h)}."
    elif pendulum.h == 1.0:
        top = float(pendulum.l_at(np.array([math.pi]))[0])
        track = f"Middle axis: once along the loxodrome, from l = {start} towards {number(top)}."
        swing = "It rises to the top, 1, and never quite comes there."
    else:
        track = f"Middle axis: along the whole loxodrome to a pole; l from {start} to {end}."
        swing = f"It goes round: {number(abs(float(found.swing[-1])) / (2.0 * math.pi))} turns in this time."
    measured = found.measured[1]
    error = f", to {_power(np.max(np.abs(measured - pendulum.angle)))}" if measured.size else ""
    return (
        f"The body in space\n{'' if pendulum.body.check.is_body else 'No rigid body, so no ellipsoid. '}"
        f"The centre of mass stays in a vertical plane, to {_power(found.off_plane)}.",
        f"Sphere fixed in space\n{track}",
        f"Angles θ and l\nsin θ = 1/√(1+a²): θ = {number(pendulum.angle, 6)}, measured on the track"
        f"{error}.",
        f"Height of the centre of mass\n{swing}",
    )


def _power(value: float) -> str:
    return f"{value:.0e}".replace("e-", "e−")


def _derived(result: LoxodromeResult) -> list[str]:
    pendulum = result.motion.pendulum
    heavy, a = pendulum.body, pendulum.a
    return [
        f"a = ±√((a₃−a₂)(a₂−a₁))/a₂ = {number(a, 6)}",
        f"θ = {number(pendulum.angle, 6)} = {number(math.degrees(pendulum.angle), 6)}°",
        f"r = ({number(heavy.r[0])}, 0, {number(heavy.r[2])})",
        f"H = h μ|r| = {number(pendulum.h * heavy.mu, 6)}",
        f"Unit of time = {number(1.0 / pendulum.frequency_unit, 6)}",
        f"l(0) = {number(pendulum.l, 6)}",
        f"A rigid body? {'yes' if heavy.check.is_body else 'no'}",
        f"ln of what full equations leave it by in a turn, 2π|a| = {number(2.0 * math.pi * abs(a))}",
    ]


def _status(result: LoxodromeResult) -> str:
    lying = result.motion.attitude
    parts = [*orbit_status(lying.orbit), f"γ, e made orthonormal from {_power(lying.defect)}", result.ended]
    return " · ".join(parts).replace("e-", "e−")


def _notes(result: LoxodromeResult) -> list[str]:
    found = result.motion
    pendulum = found.pendulum
    notes = [] if pendulum.body.check.is_body else [pendulum.body.check.sentence]
    if found.times[-1] < float(result.values["span"]) * (1 - 1e-9):
        notes.append(f"The motion is shown up to t = {number(float(found.times[-1]))}: after that it is at rest to the "
                     "eye.")
    return notes


SCENE = Scene(
    name="loxodrome",
    title="Loxodromic pendulum",
    summary="A heavy body whose centre of mass swings in a plane while its middle axis runs along a loxodrome.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("body", "space", "angle", "height"),
    compute=compute,
    stage=LoxodromeStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    motion=motion,
    place=14,
)
