"""Cascades, hysteresis, attractors and repellers, tori and spirals of sections, found by looking.

`python tests/benchmarks/search_regimes.py diagrams|sets|strange|spirals|reversal|tori --count 300 --seed 1` draws
random bodies and a parameter, and prints what it sees: of a cascade the doublings that Newton's method then locates, of
two sets how far apart they are.  What it prints is seen, not proved.

The presets of the scene "Orbit diagram" were found so: by `strange --real --seed 1`, of whose first 34 strange
attractors four are on a cascade that Newton's method locates to period 16, and by `reversal --real --seed 2`, where 80
of 300 bodies turn round.

--real : of the Suslov problem only what is a rigid body for some I33 (`check_body`).
--ball : of the Chaplygin ball in a field in place of the Suslov problem.
strange : strange attractors, with their Kaplan–Yorke dimension, whether their dynamics are mixed, the permanent
    rotations that are saddle-foci with Shilnikov's inequality and how close the attractor comes to them, and cascades
    over a parameter about them.
spirals : strange attractors to which motions from next to saddle-foci come, of the Suslov problem.  Of the first 17124
    bodies of `--real --seed 1`, with 8753 saddle-foci that have Shilnikov's inequality and a stable real eigenvalue,
    eleven come within 0.3 of one, the closest within 0.084: I = (0.7, 2.8, 0.2, 0.2), b = (1.0, -1.8, -1.2), E = 2.717,
    eigenvalues 0.287 ± 2.025i, -0.744.  Of 31 strange attractors to which 4000 bodies came from random places (`strange
    --real`, seeds 1 to 4), none comes closer than 0.39.  Of six of the eleven, motions that come to the saddle-focus
    were followed backward in time along h, I11, I22, I13, I23: of that body alone a homoclinic orbit was found, at
    h = 5.015931, which the example "A spiral" shows.
reversal : motions that turn round on their way from a repeller to an attractor.
tori : parameters along which an attracting focus bears an invariant curve (Neimark–Sacker), and what attracts beyond.
    The example "A torus breaks up" of the scene was found so, with `--real --seed 1`.  What an earlier search took for
    curves, as places did not repeat and their exponents were 0 to their errors, were in all eleven cases that were
    looked at periodic orbits to which motions come slowly: a curve is called one only where it has a rotation number.
"""

from __future__ import annotations

import argparse
import math
import time
from collections import Counter

import numpy as np
from scipy.optimize import brentq

from hess_mechanics import (
    BallBody,
    ModelError,
    ReturnMap,
    SuslovBody,
    check_body,
    level,
    lyapunov_spectrum,
    return_map,
    solve,
)
from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.dynamics.continuation import Bifurcation, continued
from hess_mechanics.dynamics.orbit_diagram import cascade, diagram_over, hysteresis, period_of
from hess_mechanics.dynamics.periodic import apart, find_periodic
from hess_mechanics.dynamics.regime import MotionKind, dynamics_of, regime
from hess_mechanics.errors import NotConverged, OutsideRegion
from hess_mechanics.rigid_body.reversal import reversals

NAMES = ("I11", "I22", "I13", "I23", "E")
_STEP = 1e-6
_BROKEN = "torus, then a strange attractor"


def drawn(draw: np.random.Generator, real: bool = False, ball: bool = False) -> ReturnMap:
    """The section γ3 = 0 of a random body at a random energy."""
    while True:
        p = np.round([*draw.uniform(0.5, 3.0, 2), *draw.uniform(-1.0, 1.0, 2), *draw.uniform(-2.0, 2.0, 3)], 1).tolist()
        above = round(float(draw.uniform(0.5, 6.0)), 1)
        if not real or (check_body(*p[:4]).is_body and (p[2] or p[3])):
            break
    if ball:
        D = round(float(draw.uniform(0.0, 5.0)), 1)
        return return_map(BallBody(*p[:4], D, *p[4:]), h=round(above - math.hypot(*p[4:]), 3), accuracy="draft")
    return return_map(SuslovBody(*p), E=round(above - math.hypot(*p[4:]), 3), accuracy="draft")


def is_real(map_: ReturnMap) -> bool:
    """Whether this is a rigid body for some I33."""
    try:
        return check_body(*(map_.section.constants[name] for name in ("I11", "I22", "I13", "I23"))).is_body
    except ModelError:
        return False


def start_of(map_: ReturnMap, draw: np.random.Generator) -> np.ndarray:
    """A random place where motions cross."""
    for _ in range(100):
        place = np.array([draw.uniform(-math.pi, math.pi), draw.uniform(0.2, 2.9)])
        if map_.section.states_at(*place[:, None])[1][0]:
            return place
    raise OutsideRegion("No motion of this energy reaches the section.")


def looked_at(
    map_: ReturnMap, name: str, draw: np.random.Generator, start: np.ndarray | None = None, real: bool = False
) -> None:
    """Follow an orbit along a parameter there and back; print doublings and hysteresis, of real bodies only."""
    here, exact = map_.section.constants[name], ReturnMap(map_.section, level("precise"))
    values = here + np.linspace(-0.5, 0.5, 61)
    if real:
        values = values[[name not in NAMES[:4] or is_real(map_.moved(name, value)) for value in values]]
    if start is None:
        start = start_of(map_, draw)
    there = diagram_over(lambda v: map_.moved(name, v), name, values, start, 300, 64)
    periods = there.periods.tolist()
    seen = [k for k in range(len(values) - 1) if periods[k] and periods[k + 1] == 2 * periods[k]] + [
        -k for k in range(1, len(values)) if periods[k] and periods[k - 1] == 2 * periods[k]
    ]
    chaos = sum(not p and len(one) > 0 for p, one in zip(periods, there.places, strict=True))
    for signed in seen:
        step, k = (1, signed) if signed > 0 else (-1, -signed)
        beyond = periods[k::step]
        if 4 * periods[k] not in beyond:
            continue
        try:
            orbit = find_periodic(exact.moved(name, values[k]), there.places[k][-periods[k] :], periods[k])
            found = cascade(lambda v: exact.moved(name, v), name, orbit, values[k], values[k] + 0.3 * step, 5)
        except ModelError as error:
            print("   ", error)
            continue
        print(
            "CASCADE",
            name,
            map_.section.constants,
            "from",
            values[k],
            there.ends[k],
            found.periods,
            found.values,
            found.errors,
            "ratios",
            found.ratios,
            found.ended,
            flush=True,
        )
    back = diagram_over(lambda v: map_.moved(name, v), name, values[::-1], there.ends[-1], 300, 64)
    both = hysteresis(map_.turns, there, back)
    wide = [one for one in both if one[1] - one[0] > 0.05]
    if wide:
        print(
            "HYSTERESIS",
            name,
            map_.section.constants,
            start,
            wide,
            "periods",
            periods,
            back.periods[::-1].tolist(),
            "chaotic values",
            chaos,
            flush=True,
        )


def saddle_foci(map_: ReturnMap) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Permanent rotations (5,) with two complex and a real eigenvalue of the other sign, these (3,), a direction (5,).

    They are γ3 = 0, ω = wγ with w²(I13γ1 + I23γ2) = b3.  The real eigenvalue is the last; the direction is in the plane
    of the complex ones.
    """
    body, E = map_.section.body, map_.section.E
    if body.b3 == 0.0 or body.I13 == body.I23 == 0.0:
        return []

    def rotation(psi: float, sign: float) -> np.ndarray:
        g1, g2 = math.cos(psi), math.sin(psi)
        w = sign * math.sqrt(max(0.0, body.b3 / (body.I13 * g1 + body.I23 * g2)))
        return np.array([w * g1, w * g2, g1, g2, 0.0])

    def excess(psi: float) -> float:
        w1, w2, g1, g2, _ = rotation(psi, 1.0)
        return 0.5 * (body.I11 * w1**2 + body.I22 * w2**2) + body.b1 * g1 + body.b2 * g2 - E

    def field(y: np.ndarray) -> np.ndarray:
        return np.array(map_.section.system.field(list(y), list(map_.section.parameters)), float)

    middle = math.atan2(body.I23, body.I13) + (0.0 if body.b3 > 0.0 else math.pi)
    psi = middle + np.linspace(-1.56, 1.56, 401)
    values = np.array([excess(x) for x in psi])
    found = []
    for k in np.flatnonzero(values[1:] * values[:-1] < 0.0):
        for sign in (1.0, -1.0):
            root = rotation(brentq(excess, psi[k], psi[k + 1]), sign)
            J = np.column_stack(
                [(field(root + _STEP * e) - field(root - _STEP * e)) / (2.0 * _STEP) for e in np.eye(root.size)]
            )
            eigenvalues, vectors = np.linalg.eig(J)
            # Those of the integrals, along the family of rotations, are 0.
            order = np.argsort(-np.abs(eigenvalues))[:3]
            spiral, plain = (order[(np.abs(eigenvalues[order].imag) > 1e-6) == turns] for turns in (True, False))
            if len(spiral) == 2 and eigenvalues[plain[0]].real * eigenvalues[spiral[0]].real < 0.0:
                found.append((root, eigenvalues[[*spiral, *plain]], vectors[:, spiral[0]].real))
    return found


def beside(root: np.ndarray, eigenvalues: np.ndarray, states: np.ndarray) -> str:
    """How close states (n, 5) come to a saddle-focus.  Shilnikov's inequality: the real eigenvalue is the larger."""
    return (
        f"saddle-focus {np.round(root, 4)} eigenvalues {np.round(eigenvalues, 4)} Shilnikov "
        f"{abs(eigenvalues[2].real) > abs(eigenvalues[0].real)} closest "
        f"{np.linalg.norm(states - root, axis=1).min():.2g}"
    )


def spirals(map_: ReturnMap) -> str:
    """Strange attractors to which the motions from next to a saddle-focus come that has Shilnikov's inequality.

    Motions leave it in a spiral and may come back along a line; those within 0.3 of it are printed.
    """
    told = "no such saddle-focus"
    system, p = map_.section.system, map_.section.parameters
    for root, eigenvalues, direction in saddle_foci(map_):
        if not 0.0 < eigenvalues[0].real < -eigenvalues[2].real:
            continue
        told = "not close to a saddle-focus" if told == "no such saddle-focus" else told
        start = root + 1e-2 * direction / np.linalg.norm(direction)
        start[2:] /= np.linalg.norm(start[2:])
        states = solve(system.at(p), start, np.linspace(0.0, 1500.0, 30_001), level("draft")).states[15_000:]
        if np.linalg.norm(states - root, axis=1).min() > 0.3 or np.ptp(states, axis=0).max() < 0.1:
            continue
        exponents = lyapunov_spectrum(system.at(p), states[-1], 1500.0, level("draft"))
        if (
            exponents.signs[0] == "+"
            and exponents.values[0] > 0.01
            and exponents.divergence < (-3.0 * exponents.divergence_error)
        ):
            told = "strange, close to a saddle-focus"
            dimension, error = exponents.dimension
            print(
                "SPIRAL",
                map_.section.constants,
                beside(root, eigenvalues, states),
                np.round(exponents.values, 4),
                f"D = {dimension:.3f} ± {error:.3f}",
                flush=True,
            )
    return told


def strange(map_: ReturnMap, draw: np.random.Generator, real: bool) -> str:
    """What the motion from a random place is; of a strange attractor, all that is looked for about it."""
    place = start_of(map_, draw)
    kind = regime(map_, place, 300, 100, 200.0)
    if not (kind.kind is MotionKind.CHAOTIC and kind.volume < 0):
        return kind.kind.words
    system, p = map_.section.system, map_.section.parameters
    last = map_.state_at(kind.places[-1])
    exponents = lyapunov_spectrum(system.at(p), last, 2000.0)
    if exponents.signs[0] != "+":
        return "chaotic at first"
    dimension, error = exponents.dimension
    found = dynamics_of(map_, place, 500, 1500)
    print(
        "STRANGE",
        map_.section.constants,
        np.round(place, 4),
        f"D = {dimension:.3f} ± {error:.3f}",
        np.round(exponents.values, 4),
        found.verdict,
        f"distance {found.distance:.3f} ± {found.distance_error:.2g} shared {found.shared:.2g}",
        flush=True,
    )
    if system.name == "suslov":
        states = solve(system.at(p), last, np.linspace(0.0, 2000.0, 40_001), level("draft")).states
        for root, eigenvalues, _ in saddle_foci(map_):
            print("   ", beside(root, eigenvalues, states), flush=True)
    for name in draw.permutation(list(map_.section.constants))[:3]:
        looked_at(map_, str(name), draw, place, real)
    return f"strange, {found.verdict}"


def tori(map_: ReturnMap, draw: np.random.Generator, real: bool) -> str:
    """Where an attracting focus bears an invariant curve (Neimark–Sacker) along parameters, and what is beyond."""
    place = start_of(map_, draw)
    first = regime(map_, place, 400, 60, 50.0)
    if first.period not in range(1, 9) or first.volume >= 0:
        return first.kind.words
    exact = ReturnMap(map_.section, level("precise"))
    try:
        orbit = find_periodic(exact, first.places[-first.period :], first.period)
    except NotConverged:
        return "at rest"
    told = orbit.kind
    for name in draw.permutation(list(map_.section.constants))[:4] if told == "stable focus" else ():
        here = map_.section.constants[name]
        for end in (here - 0.6, here + 0.6):
            try:
                branch = continued(lambda v, name=name: exact.moved(name, v), orbit, name, here, end, 50)
            except ModelError:
                continue
            for one in branch.bifurcations:
                if one.kind != "Neimark–Sacker" or (
                    real and name in NAMES[:4] and not is_real(map_.moved(name, one.value))
                ):
                    continue
                shrinks = abs(np.prod(branch.multipliers[one.after + 1])) < 1.0
                rising = branch.values[one.after + 1] > branch.values[one.after]
                letters = beyond(map_, name, one, -1.0 if rising == shrinks else 1.0)
                if "Q" in letters and told != _BROKEN:
                    told = _BROKEN if "C" in letters.partition("Q")[2] else "torus"
                print(
                    "CURVE",
                    map_.section.constants,
                    name,
                    f"{one.value:.8f} ± {one.error:.1g}",
                    "rotation",
                    f"{abs(np.angle(one.multipliers[0])) / math.tau:.5f}",
                    np.round(one.places[0], 4),
                    letters,
                    flush=True,
                )
    return told


def beyond(map_: ReturnMap, name: str, born: Bifurcation, sign: float) -> str:
    """What attracts beyond the birth of a curve, at growing distances: Q a closed curve, C chaos, P, F, or ?."""
    letters, m = "", len(born.places)
    place = born.places[0] + 1e-2
    for step in 5e-4 * 1.25 ** np.arange(26):
        try:
            there = map_.moved(name, born.value + sign * step)
            focus = find_periodic(there, born.places, m).places[0]
            places = there.orbit(place, 12_000 * m)[::m]
            if len(places) < 12_000:
                return f"{letters}-"
            last = there.state_at(places[-1])
            found = lyapunov_spectrum(there.section, last, 2000.0, level("draft"))
        except ModelError:
            return letters
        wide, still = (np.hypot(*apart(map_.turns, part, focus).T).max() for part in (places[3000:6000], places[9000:]))
        turns, error = rotation_number(apart(map_.turns, places[8000:], focus), (0.0, 0.0))
        period, _ = period_of(map_.turns, places[-1000:], map_.promise)
        if found.values[0] > max(0.005, 4.0 * found.errors[0]) and found.signs[0] == "+":
            letters += "C"
        elif period:
            letters += "F" if period == 1 else "P"
        else:
            # Neither on its way to a focus nor to rest, where it does not turn.
            letters += "Q" if error < 1e-5 < abs(turns) and 0.9 < still / wide < 1.1 and still > 3e-3 else "?"
        place = places[-1]
    return letters


def reversal(map_: ReturnMap, draw: np.random.Generator) -> str:
    """Whether a motion that is begun next to its repeller, a fixed point, turns the other way about the vertical."""
    found = dynamics_of(map_, start_of(map_, draw), 200, 32, 200.0)
    last = found.repeller[-1]
    if found.verdict != "dissipative" or np.abs(found.repeller - last).max() > 1e-3:
        return found.verdict
    place = last + np.array([1e-2, 1e-2 if last[1] < 1.0 else -1e-2])
    body = map_.section.body
    times = reversals(body, map_.state_at(place), 200.0, level("draft")).times
    if len(times) % 2 == 0:
        return "dissipative, does not turn round in the end"
    print(
        "REVERSAL",
        map_.section.constants,
        np.round(place, 5),
        "attractor",
        np.round(found.attractor[-1], 5),
        "times",
        np.round(times, 3),
        flush=True,
    )
    return "turns round"


def main() -> None:
    """Search and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("diagrams", "sets", "strange", "spirals", "reversal", "tori"))
    parser.add_argument("--real", action="store_true")
    parser.add_argument("--ball", action="store_true")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=600.0)
    options = parser.parse_args()
    draw = np.random.default_rng(options.seed)
    begun = time.process_time()
    told: Counter[str] = Counter()
    for _ in range(options.count):
        if time.process_time() - begun > options.seconds:
            break
        try:
            map_ = drawn(draw, options.real, options.ball)
            if options.what == "strange":
                told[strange(map_, draw, options.real)] += 1
            elif options.what == "spirals":
                told[spirals(map_)] += 1
            elif options.what == "reversal":
                told[reversal(map_, draw)] += 1
            elif options.what == "tori":
                told[tori(map_, draw, options.real)] += 1
            elif options.what == "sets":
                place = start_of(map_, draw)
                found = dynamics_of(map_, place, 500, 2000)
                print(
                    found.sentence,
                    f"{found.motion.divergence:.4f} ± {found.motion.divergence_error:.4f}",
                    map_.section.constants,
                    place,
                    flush=True,
                )
            else:
                looked_at(map_, str(draw.choice(NAMES)), draw, real=options.real)
                told["followed"] += 1
        except ModelError as error:
            told[f"refused: {type(error).__name__}"] += 1
    print(f"{told.total()} bodies of seed {options.seed}:", dict(told), flush=True)


if __name__ == "__main__":
    main()
