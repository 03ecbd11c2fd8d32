"""Singular measures (S16): a cloud of phase points drawn onto an invariant manifold, and its density."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Choice, Number, Value, Values
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.scene import Preset, Report, Scene
from hess_explorer.scenes.framework.work import ACCURACY, Work, refuse
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.cloud import CloudPlane, CloudSphere, DensityPlot
from hess_explorer.views.graph import Graph
from hess_explorer.views.text import number
from hess_explorer.views.velocity_plane import nice_above
from hess_mechanics.chaplygin_ball.energy_surface import line_of_rest
from hess_mechanics.chaplygin_ball.equations import SYSTEM, BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import Cloud, carried, frame_times, histogram, occupation, patch, shell
from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array, Ensemble, frozen

_FEW = 1000
_BIN = 0.25
"""Of ln|s|."""
_SMALLEST = math.log(1e-30)
"""Of what is drawn: a smaller |s| has no place in single precision."""

SPECS = (
    Number("I11", "I₁₁", "Inertia I₁₁", 2.0, 0.2, 5.0, 0.01, 1e-3, 1e3, "Moment of inertia about the first body axis."),
    Number("I22", "I₂₂", "Inertia I₂₂", 1.5, 0.2, 5.0, 0.01, 1e-3, 1e3,
           "Moment of inertia about the second body axis."),
    Number("I13", "I₁₃", "Inertia I₁₃", 0.5, -2.0, 2.0, 0.01, -1e3, 1e3,
           "Product of inertia; with I₂₃ it sets the manifold s = I₁₃ω₁ + I₂₃ω₂ = 0."),
    Number("I23", "I₂₃", "Inertia I₂₃", 0.7, -2.0, 2.0, 0.01, -1e3, 1e3,
           "Product of inertia; not 0 together with I₁₃."),
    Number("D", "𝒟", "Ball inside, 𝒟", 0.0, 0.0, 20.0, 0.05, 0.0, 1e3,
           "0: free Suslov problem; otherwise the Chaplygin ball, whose inner ball has this 𝒟."),
    Number("h", "h", "Energy h", 2.0, 0.1, 20.0, 0.1, 1e-6, 1e6, "Of the middle of the cloud; without a field h > 0."),
    Number("spread", "δ", "Spread δ", 0.1, 0.01, 0.5, 0.01, 1e-3, 0.9,
           "Shell: E = h(1 ± δ). Patch: radius of its disc of ω, in |ω|, and of its cap of γ, in radians."),
    Number("angle", "φ", "Direction φ of the patch", -0.3, -3.14, 3.14, 0.01, -math.pi, math.pi,
           "Angle of the patch in the plane of ω₁ and ω₂, in radians. A click there chooses it."),
    Number("span", "t", "Time span", 14.0, 1.0, 40.0, 0.5, 0.01, 1e4, "How long the cloud is followed."),
    Number("b3", "b₃", "Field b₃ of the cloud beside", 1.0, -3.0, 3.0, 0.01, -1e3, 1e3,
           "With I₁₃ = I₂₃ = 0 nothing would move without a field; the first cloud has none."),
    Choice("start", "Cloud", ("energy shell", "small patch"), "energy shell",
           "All states with about the energy h, or those about one state; evenly spread over the phase volume."),
    Choice("direction", "Time", ("forward", "backward"), "forward",
           "Forward to the stable half of s = 0, backward to the other."),
    Choice("beside", "Beside", ("nothing", "principal axis"), "nothing",
           "The same points with I₁₃ = I₂₃ = 0 and the field b₃, in another colour."),
    Choice("along", "Fourth picture", ("divergence", "volume"), "divergence",
           "The divergence div v at the points, or the logarithm of small volumes about them."),
    Choice("points", "Points", ("1000", "10000"), "10000", "How many points both clouds have together."),
    ACCURACY,
)

_CHOICES = {"start": "energy shell", "direction": "forward", "beside": "nothing", "along": "divergence"}
"""An example sets all that it is about: choices stay as they are otherwise."""

PRESETS = (
    Preset("Free Suslov problem: on the average 1/|s|", _CHOICES),
    Preset("Backward: onto the unstable half", {**_CHOICES, "direction": "backward"}),
    Preset("A small patch and its volume", {**_CHOICES, "start": "small patch", "along": "volume"}),
    Preset("Beside: on a principal axis volume is kept", {
        **_CHOICES, "start": "small patch", "beside": "principal axis", "along": "volume"}),
    Preset("Chaplygin ball, 𝒟 = 3: γ gathers too", {
        **_CHOICES, "I11": 1.0, "I22": 1.5, "I13": 0.7, "I23": 1.2, "D": 3.0, "h": 3.0, "span": 11.0}),
)

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>cloud; its mean</li>
<li><span class="line second"></span>cloud on a principal axis</li>
<li><span class="line stable"></span>stable half, s = 0</li>
<li><span class="line unstable"></span>unstable half, s = 0</li>
<li><span class="dot point"></span>at the moving time</li>
<li><span class="line muted"></span>energy h; 1/|s|; extremes</li>
</ul>
"""

THUMBNAIL = """
<path d="M24 16 46 5" stroke="#D55E00" stroke-width="2" stroke-dasharray="4 3"/>
<path d="M24 16 2 27" stroke="#009E73" stroke-width="2"/>
<g fill="#0072B2"><circle cx="38" cy="14" r="1.3"/><circle cx="35" cy="22" r="1.3"/><circle cx="27" cy="27" r="1.3"/>
<circle cx="21" cy="5" r="1.3"/><circle cx="12" cy="9" r="1.3"/><circle cx="8" cy="16" r="1.3"/>
<circle cx="16" cy="28" r="1.3"/><circle cx="6" cy="21" r="1.3"/><circle cx="11" cy="26" r="1.5"/>
<circle cx="7" cy="24" r="1.5"/><circle cx="9" cy="22" r="1.5"/><circle cx="12" cy="23" r="1.5"/></g>
"""

WORDS = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Course:
    """Mean, least and largest at each time, (3, m): of div v and of ln s(t)/s(0); volume: (m,), see `Cloud`."""

    divergence: Array
    log_growth: Array
    volume: Array


@dataclass(frozen=True)
class Density:
    """Shares of the points per unit of ln|s|, in the bins about `log_s`: at the start, at the end, mean over the time.

    height : the mean where all points pass.
    """

    log_s: Array
    first: Array
    last: Array
    mean: Array
    height: float


@dataclass(frozen=True)
class Clouds:
    """A cloud and what becomes of it; `other`: the one on a principal axis."""

    cloud: Cloud
    course: Course
    density: Density
    other: Ensemble | None


@dataclass(frozen=True)
class CloudResult:
    """`todo`: the larger clouds, where they are not computed yet."""

    values: Values
    body: BallBody
    clouds: Clouds
    todo: Sequence[Task]
    total: int
    ended: str


def admit(values: Values) -> tuple[dict[str, Value], list[str]]:
    """Every number within its bounds: another scene may have had others."""
    admitted, notes = dict(values), []
    for spec in SPECS:
        if isinstance(spec, Number):
            admitted[spec.name], note = spec.admit(float(values[spec.name]))
            notes += [note] if note else []
    return admitted, notes


def limits(values: Values) -> Mapping[str, tuple[float, float, float]]:
    """No slider depends on another."""
    return {}


def _body(values: Values) -> BallBody:
    return BallBody(*(float(values[name]) for name in ("I11", "I22", "I13", "I23", "D")))


def _states(body: BallBody, h: float, angle: float | None, spread: float, count: int) -> Array:
    return shell(body, h, spread, count) if angle is None else patch(body, h, angle, spread, count)


def _course(cloud: Cloud) -> Course:
    def of(values: Array) -> Array:
        return frozen(np.stack([values.mean(axis=0), values.min(axis=0), values.max(axis=0)]))

    return Course(of(cloud.divergence), of(cloud.log_growth), frozen(cloud.volume))


def _density(cloud: Cloud) -> Density:
    low = max(_SMALLEST, float(cloud.log_s.min()))
    first = math.floor(low / _BIN)
    edges = _BIN * np.arange(first, max(first + 1, math.floor(float(cloud.log_s.max()) / _BIN) + 1) + 1)
    # What each point spends per unit of ln|s| in the end, where ln|s| falls at an even rate.
    late = 3 * cloud.times.size // 4
    rate = np.abs(cloud.log_s[:, -1] - cloud.log_s[:, late]) / abs(cloud.times[-1] - cloud.times[late])
    return Density(frozen(0.5 * (edges[1:] + edges[:-1])), histogram(cloud, 0, edges), histogram(cloud, -1, edges),
                   occupation(cloud, edges), 1.0 / float(np.median(rate) * abs(cloud.times[-1])))


def _clouds(body: BallBody, h: float, angle: float | None, spread: float, count: int, span: float,
            field: float | None, accuracy: Level) -> Clouds:
    """`count` points, half of them in the field of a cloud beside if there is one; times reach to `span`."""
    states = _states(body, h, angle, spread, count if field is None else count // 2)
    times = frame_times(body, states, span, abs(field or 0.0))
    cloud, other = carried(body, states, times, accuracy), None
    if field is not None:
        principal = BallBody(body.I11, body.I22, 0.0, 0.0, body.D, 0.0, 0.0, field)
        other = ensemble(SYSTEM, states, principal.parameters, times, accuracy)
    return Clouds(cloud, _course(cloud), _density(cloud), other)


def compute(values: Values, shown: Collection[str], dragging: bool) -> CloudResult:
    """One cloud, or two; with fewer points while a slider is dragged, and until all of them are known."""
    work = Work(values, dragging)
    body = _body(values)
    angle = float(values["angle"]) if values["start"] == "small patch" else None
    span = float(values["span"]) * (-1.0 if values["direction"] == "backward" else 1.0)
    field = float(values["b3"]) if values["beside"] == "principal axis" else None

    def of(count: int) -> Task:
        return Task(_clouds, (
            body, float(values["h"]), angle, float(values["spread"]), count, span, field, work.level))

    count = int(values["points"])
    clouds = work.sooner(of(count), of(min(count, _FEW)))
    return CloudResult(values, body, clouds, tuple(work.todo), work.pieces, work.ended())


class CloudStage:
    """The four pictures of one session."""

    dots: Mapping[str, tuple[str, str]] = {"divergence-point": ("t", "mean")}
    angles: Sequence[str] = ()

    def __init__(self, wire: Wire) -> None:
        self.wire = wire
        self.omega = CloudPlane(wire, "omega", "density-now")
        self.sphere = CloudSphere(wire, "omega")
        self.density = DensityPlot(wire, "density")
        self.divergence = Graph(wire, "divergence", ("t", "div v, or ln s(t)/s(0)"), (0.0, 14.0), (-1.0, 1.0), [
            Series("least", theme.MUTED, "dashed"), Series("largest", theme.MUTED, "dashed"),
            Series("beside", theme.MAP, "dotdash"), Series("mean", theme.ORBIT)])
        # The player reads the time of the moving clouds from the source of that name.
        self.divergence.add("orbit", "line", ("t", "mean"), source="data-orbit", line_alpha=0)
        self.pictures = (self.omega, self.sphere, self.density, self.divergence)

    def show(self, result: CloudResult, hold_axes: bool) -> Report:
        """Draw the clouds, their density, what becomes of volumes."""
        cloud, density, other = result.clouds.cloud, result.clouds.density, result.clouds.other
        h = float(result.values["h"])
        if not hold_axes:
            fastest = float(np.sqrt((cloud.omega**2).sum(axis=2).max()))
            if other is not None:
                fastest = max(fastest, float(np.sqrt((other.states[..., :2] ** 2).sum(axis=2).max())))
            self.omega.fit(nice_above(1.1 * fastest))
            lowest = max(_SMALLEST, float(np.quantile(cloud.log_s[:, -1], 0.02)))
            self.density.fit((math.exp(lowest), math.exp(float(density.log_s[-1]))), density.height)
        bins = (float(density.log_s[0]) - 0.5 * _BIN, _BIN, density.log_s.size)
        self.omega.show(cloud, h, bins, None if other is None else other.states,
                        float(result.values["b3"]))
        xi, _ = line_of_rest(result.body)
        self.sphere.show([*map(float, xi), 0.0], "ξ")
        self.density.say("")
        for name, share in (("first", density.first), ("last", density.last), ("mean", density.mean)):
            self.density.show(name, np.exp(density.log_s), share)
        self.density.show_limit(density.height)
        self._show_course(result, hold_axes)
        for picture, text in zip(self.pictures, _captions(result), strict=True):
            self.wire.say(picture.name, text)
        return Report(_derived(result), _status(result), (), result.todo, result.total)

    def _show_course(self, result: CloudResult, hold_axes: bool) -> None:
        course, t = result.clouds.course, np.abs(result.clouds.cloud.times)
        mean, least, largest = course.divergence if result.values["along"] == "divergence" else course.log_growth
        if not hold_axes:
            low, high = min(0.0, float(least.min())), max(0.0, float(largest.max()))
            room = 0.08 * (high - low)
            self.divergence.set_ranges((0.0, float(t[-1])), (low - room, high + room))
        self.divergence.say("")
        self.divergence.show_levels([0.0])
        for name, values in (("least", least), ("largest", largest), ("mean", mean)):
            self.divergence.show(name, t, values)
        if result.clouds.other is None:
            self.divergence.clear("beside")
        else:
            self.divergence.show("beside", t[[0, -1]], np.zeros(2))
        self.divergence.assign("orbit", t=t.astype(np.float32), mean=mean.astype(np.float32))

    def fail(self, sentence: str) -> None:
        """Empty pictures, and the sentence where the eye is."""
        refuse(self.pictures, self.wire, sentence)

    def pick(self, picture: str, x: float, y: float) -> Values:
        """A click in the plane chooses where the patch is."""
        return {"start": "small patch", "angle": math.atan2(y, x)} if picture == "omega" else {}


def passed_by_most(density: Density) -> tuple[float, float]:
    """|s| after a quarter of the way (of ln|s|), passed by most points, and the mean density there, times |s|."""
    i = 3 * density.log_s.size // 4
    return math.exp(float(density.log_s[i])), float(density.mean[i])


def _captions(result: CloudResult) -> tuple[str, str, str, str]:
    cloud, course, density = result.clouds.cloud, result.clouds.course, result.clouds.density
    before, after = (math.exp(float(np.median(cloud.log_s[:, i]))) for i in (0, -1))
    xi = np.append(line_of_rest(result.body)[0], 0.0)
    first, last = (float(((cloud.gamma[:, i] @ xi) ** 2).mean()) for i in (0, -1))
    s, share = passed_by_most(density)
    ends = f"from {number(course.divergence[0, 0], 3)} to {number(course.divergence[0, -1], 3)}"
    title = "Divergence" if result.values["along"] == "divergence" else "Small volumes"
    if result.values["along"] == "volume" and result.values["start"] == "small patch":
        fate = f"The patch has {number(float(course.volume[-1]), 3)} of its volume left"
    else:
        fate = f"Mean of div v {ends}; mean of ln s(t)/s(0) in the end {number(course.log_growth[0, -1], 3)}"
    if result.clouds.other is not None:
        fate += "; beside, all of it"
    return (
        f"Angular velocity (ω₁, ω₂)\nHalf of {cloud.signs.size} points begin within |s| < {number(before, 3)}, "
        f"and end within {number(after, 3)}.",
        f"Poisson sphere\nγ of the same points; the mean of (γ, ξ)² goes from {number(first, 3)} to {number(last, 3)}.",
        f"Density against |s|\nMean over time · |s| at {number(s, 2)}: {number(share, 3)}; dotted "
        f"{number(density.height, 3)}/|s|.",
        f"{title} along the way\n{fate}.",
    )


def _derived(result: CloudResult) -> list[str]:
    course = result.clouds.course
    values = result.values
    rows = [
        f"System: {'Chaplygin ball, b = 0' if result.body.D else 'free Suslov problem'}",
        "Invariant density: 1/|I₁₃ω₁ + I₂₃ω₂|",
        f"ξ = ({', '.join(number(float(x)) for x in line_of_rest(result.body)[0])}, 0)",
        f"mean of div v: {number(float(course.divergence[0, 0]), 3)} → {number(float(course.divergence[0, -1]), 3)}",
        f"mean of ln s(t)/s(0): {number(float(course.log_growth[0, -1]), 5)}",
    ]
    if values["start"] == "small patch":
        rows.append(f"V(t)/V(0) = {number(float(course.volume[-1]), 4)}")
    if result.clouds.other is not None:
        rows.append(f"Beside: I₁₃ = I₂₃ = 0, b₃ = {number(float(values['b3']))}, div v = 0")
    return rows


def _status(result: CloudResult) -> str:
    cloud = result.clouds.cloud
    return " · ".join([
        f"{cloud.level}: {cloud.signs.size} points, {cloud.times.size} frames, {cloud.cost.steps} Taylor steps, "
        f"error of ω/ν, γ and ln|s| ≤ {cloud.error_estimate:.1e} ({cloud.status})",
        *([] if result.clouds.other is None else [f"beside ≤ {result.clouds.other.errors.max():.1e}"]),
        result.ended,
    ]).replace("e-", "e−")


SCENE = Scene(
    name="singular-measures",
    title="Singular measures",
    summary="10 000 phase points are drawn onto an invariant manifold, where an invariant density is infinite.",
    specs=SPECS,
    presets=PRESETS,
    words=WORDS,
    admit=admit,
    limits=limits,
    pictures=("omega", "sphere", "density", "divergence"),
    compute=compute,
    stage=CloudStage,
    legend=LEGEND,
    thumbnail=THUMBNAIL,
    place=16,
)
