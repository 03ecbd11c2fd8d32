"""Check the labels of "labelled_motions.json".

Usage: `pip install heyoka; python tests/oracle/make_labelled_motions.py` (15 minutes).  Each row of the table names a
motion of a section and its kind.  This script shares no code with the package: it has its own right-hand sides,
sections and variational equations, and integrates with Taylor series of heyoka at machine precision.  A kind is known
by a theorem (an integrable case, the trace of a Möbius map) or by computation.  In the second case these indicators
agree after T and after 2T, for the start and for another one 1e-6 away (only for the start if the row is `exact`):

growth : ln|δ| of a neighbour, linear in t on chaotic motions, at most 2.2 ln t on regular ones;
SALI : the angle between two neighbours (Skokos 2001), which falls exponentially on chaotic motions only;
drift : the change of the main frequency from the first half to the second (Laskar 1990), or
K : the 0–1 test of the crossings (Gottwald and Melbourne 2009), close to 1 on chaotic motions, to 0 on regular ones.

Where they disagree, the script stops with an error.
"""

import json
import math
import time
from collections.abc import Callable
from math import atan2, log, pi, sin, sqrt
from pathlib import Path
from typing import Any

import heyoka as hy
import numpy as np
from scipy.optimize import brentq, minimize_scalar

TAU = 2.0 * pi


# ---- equations of motion


def suslov_field(y, p):
    w1, w2, g1, g2, g3 = y
    I11, I22, I13, I23, b1, b2, b3 = p
    s = I13 * w1 + I23 * w2
    return [
        (b3 * g2 - b2 * g3 - s * w2) / I11,
        (b1 * g3 - b3 * g1 + s * w1) / I22,
        -g3 * w2,
        g3 * w1,
        g1 * w2 - g2 * w1,
    ]


def ball_field(y, p):
    w1, w2, g1, g2, g3 = y
    I11, I22, I13, I23, D, b1, b2, b3 = p
    s = I13 * w1 + I23 * w2
    F1, F2 = b3 * g2 - b2 * g3 - s * w2, b1 * g3 - b3 * g1 + s * w1
    a, b, c = I11 + D * (g2 * g2 + g3 * g3), -D * g1 * g2, I22 + D * (g1 * g1 + g3 * g3)
    det = a * c - b * b
    return [(c * F1 - b * F2) / det, (a * F2 - b * F1) / det, -g3 * w2, g3 * w1, g1 * w2 - g2 * w1]


def top_field(y, p):
    """M' = M × AM + μ r × γ, γ' = γ × AM, for the potential −μ(r, γ) with this sign of the torque."""
    M, g, A, mr = y[:3], y[3:], p[:3], [p[6] * r for r in p[3:6]]
    w = [a * m for a, m in zip(A, M, strict=True)]

    def cross(u, v):
        return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]

    return [a + b for a, b in zip(cross(M, w), cross(mr, g), strict=True)] + cross(g, w)


# ---- what grows through 0 on a section; `value` is the constant of the section


def third_gamma(y, value):
    return y[4]


def second_omega(y, value):
    return y[1]


def minus_first_omega(y, value):
    return -y[0]


def across_momentum(y, value):
    """G²γ3 − f M3, 0 where g = ±π/2."""
    return (y[0] * y[0] + y[1] * y[1] + y[2] * y[2]) * y[5] - value * y[2]


# ---- sections: a state at a place, and the place of a state


def angle_of_w(y):
    psi = np.arctan2(y[3], y[2])
    delta = np.angle(np.exp(1j * (np.arctan2(y[1], y[0]) - psi)))
    return np.array([psi, abs(delta)])


class Suslov:
    d, angles, value = 5, (True, False), 0.0
    rhs, event, place = staticmethod(suslov_field), staticmethod(third_gamma), staticmethod(angle_of_w)

    def __init__(self, I, b, E):
        self.p, self.E = [*I, *b], E

    def start(self, psi, delta):
        u = np.array([math.cos(psi + delta), sin(psi + delta)])
        kinetic = self.E - self.p[4] * math.cos(psi) - self.p[5] * sin(psi)
        w = u * sqrt(2.0 * kinetic / (self.p[0] * u[0] ** 2 + self.p[1] * u[1] ** 2))
        return np.array([*w, math.cos(psi), sin(psi), 0.0])

    def energy(self, y):
        p = self.p
        return 0.5 * (p[0] * y[0] ** 2 + p[1] * y[1] ** 2) + p[4] * y[2] + p[5] * y[3] + p[6] * y[4]


class Quartic(Suslov):
    angles = (False, False)

    def __init__(self, I, b3, h):
        super().__init__([*I, 0.0, 0.0], [0.0, 0.0, b3], h)
        self.across = 0 if I[0] > I[1] else 1
        assert b3 > 0.0
        self.event = second_omega if self.across == 0 else minus_first_omega

    def start(self, x, y):
        I11, I22, b3 = self.p[0], self.p[1], self.p[6]
        q = (0.0, x) if self.across == 0 else (x, 0.0)
        g3 = self.E / b3 - 0.5 * b3 * (q[0] ** 2 / I22 + q[1] ** 2 / I11)
        other = -sqrt(1.0 - g3 * g3 - y * y)
        p = (other, y) if self.across == 0 else (y, other)
        return np.array([-b3 * q[1] / I11, b3 * q[0] / I22, *p, g3])

    def place(self, y):
        q = self.p[1] * y[1] / self.p[6], -self.p[0] * y[0] / self.p[6]
        along = 1 - self.across
        return np.array([q[along], y[2 + along]])


class Ball:
    d, angles, value = 5, (True, False), 0.0
    rhs, event, place = staticmethod(ball_field), staticmethod(third_gamma), staticmethod(angle_of_w)

    def __init__(self, I, D, b, h):
        self.p, self.E = [*I, D, *b], h

    def start(self, psi, delta):
        g, u = (math.cos(psi), sin(psi)), (math.cos(psi + delta), sin(psi + delta))
        I11, I22, _, _, D, b1, b2, _ = self.p
        twice = I11 * u[0] ** 2 + I22 * u[1] ** 2 + D * (g[0] * u[1] - g[1] * u[0]) ** 2
        w = sqrt(2.0 * (self.E - b1 * g[0] - b2 * g[1]) / twice)
        return np.array([w * u[0], w * u[1], *g, 0.0])

    def energy(self, y):
        I11, I22, _, _, D, *b = self.p
        w1, w2, g1, g2, g3 = y
        return 0.5 * (I11 * w1**2 + I22 * w2**2 + D * ((g1 * w2 - g2 * w1) ** 2 + g3**2 * (w1**2 + w2**2))) + np.dot(
            b, y[2:]
        )


class Top:
    d, angles = 6, (True, False)
    rhs, event = staticmethod(top_field), staticmethod(across_momentum)

    def __init__(self, A, r, mu, h, f):
        self.p, self.E, self.f = [*A, *r, mu], h, f
        self.A, self.mr = np.array(A), mu * np.array(r)
        self.value = f

    def state(self, l, x, G):
        s, c = sqrt(1.0 - x * x), self.f / G
        M = G * np.array([s * sin(l), s * math.cos(l), x])
        # On g = π/2 the part of γ across M is along v.
        return np.array([*M, *(c * M / G + sqrt(1.0 - c * c) * np.array([math.cos(l), -sin(l), 0.0]))])

    def excess(self, l, x, G):
        """The energy minus its value at the momenta G of a place."""
        s = sqrt(1.0 - x * x)
        n = np.array([s * sin(l), s * math.cos(l), x])
        cos = self.f / G
        across = math.cos(l) * self.mr[0] - sin(l) * self.mr[1]
        return (
            0.5 * self.A @ n**2 * G * G
            - cos * (self.mr @ n)
            - np.sqrt(1.0 - np.minimum(1.0, cos * cos)) * across
            - self.E
        )

    def momentum(self, l, x):
        """The largest G with this energy."""
        top = sqrt(2.0 * (self.E + np.linalg.norm(self.mr)) / self.A.min()) + abs(self.f) + 1.0
        low = max(abs(self.f) * (1.0 + 1e-15), 1e-9)
        G = low + (top - low) * np.linspace(0.0, 1.0, 1001) ** 3
        last = np.flatnonzero(self.excess(l, x, G) < 0.0)[-1]
        return brentq(lambda one: self.excess(l, x, one), G[last], G[last + 1], xtol=1e-15)

    def start(self, l, x):
        return self.state(l, x, self.momentum(l, x))

    def place(self, y):
        return np.array([atan2(y[0], y[1]), y[2] / np.linalg.norm(y[:3])])

    def energy(self, y):
        return 0.5 * self.A @ y[:3] ** 2 - self.mr @ y[3:]

    def counts(self, y):
        """Return whether a crossing has g = π/2 and lies on the sheet with the largest G."""
        if y[3] * y[1] - y[4] * y[0] <= 0.0:
            return False
        if self.f == 0.0:
            return True
        G = np.linalg.norm(y[:3])
        # dh/dG > 0 there, and no larger root: the first sheet.
        return self.momentum(*self.place(y)) * (1.0 - 1e-6) <= G


# ---- integration

_MADE = {}


def tangent_system(of):
    """The field with two neighbours by the variational equations."""
    d = of.d
    y = hy.make_vars(*[f"y{i}" for i in range(d)])
    p = [hy.par[i] for i in range(len(of.p))]
    rate = of.rhs(y, p)
    J = [[hy.diff(r, x) for x in y] for r in rate]
    eqs = list(zip(y, rate, strict=True))
    for k in range(2):
        v = hy.make_vars(*[f"v{k}_{i}" for i in range(d)])
        eqs += [(v[i], sum((J[i][j] * v[j] for j in range(d)), hy.expression(0.0))) for i in range(d)]
    return eqs


class Crossed:
    """Collects the states at crossings."""

    def __init__(self):
        self.times, self.states = [], []

    def __call__(self, ta, time, sign):
        ta.update_d_output(time)
        self.times.append(time)
        self.states.append(ta.d_output.copy())

    def __deepcopy__(self, memo):
        return self


def integrators(of):
    key = (of.rhs, of.event)
    if key not in _MADE:
        d, collected = of.d, Crossed()
        eqs = tangent_system(of)
        y = [one for one, _ in eqs[:d]]
        plain = hy.taylor_adaptive(
            eqs[:d],
            [0.1] * d,
            nt_events=[
                hy.nt_event(of.event(y, hy.par[len(of.p)]), callback=collected, direction=hy.event_direction.positive)
            ],
        )
        near = hy.taylor_adaptive(eqs, [0.1] * len(eqs))
        smooth = hy.taylor_adaptive(eqs[:d], [0.1] * d)
        _MADE[key] = plain, near, smooth, collected
    return _MADE[key]


def set_up(ta, of, state):
    ta.time = 0.0
    ta.state[:] = state
    ta.pars[:] = [*of.p, of.value][: len(ta.pars)]


def crossings(of, start, count, longest=1e6):
    """States (n, d) of the next crossings."""
    plain, _, _, collected = integrators(of)
    set_up(plain, of, start)
    collected.times, collected.states = [], []
    states, seen = [], 0
    while len(states) < count and plain.time < longest:
        plain.propagate_for(20.0)
        while seen < len(collected.times):
            t, y = collected.times[seen], collected.states[seen]
            seen += 1
            if t > 1e-9 and (not hasattr(of, "counts") or of.counts(y)):
                states.append(y)
    return np.array(states[:count])


def places_of(of, states):
    return np.array([of.place(y) for y in states])


def embedded(of, places):
    """Angles as points of circles."""
    parts = []
    for i, turning in enumerate(of.angles):
        parts += [np.cos(places[:, i]), np.sin(places[:, i])] if turning else [places[:, i]]
    return np.stack(parts, axis=1)


def closings(of, places, most):
    """The largest distance of places m apart (most,), m = 1, 2, …"""
    e = embedded(of, places)
    return np.array([np.abs(e[m:] - e[:-m]).max() for m in range(1, most + 1)])


# ---- indicators


def growth(of, start, T):
    """ln|δ| and SALI after T and 2T."""
    near, d = integrators(of)[1], of.d
    v = np.random.default_rng(5).normal(size=(2, d))
    set_up(near, of, [*start, *(v / np.linalg.norm(v, axis=1)[:, None]).ravel()])
    total, found = 0.0, []
    for t in range(5, int(2 * T) + 1, 5):
        near.propagate_until(float(t))
        v = near.state[d : 3 * d].reshape(2, d)
        size = np.linalg.norm(v, axis=1)
        total += log(size[0])
        v = v / size[:, None]
        near.state[d : 3 * d] = v.ravel()
        if t in (int(T), int(2 * T)):
            found.append((total, min(np.linalg.norm(v[0] + v[1]), np.linalg.norm(v[0] - v[1]))))
    return found


def frequency(t, signal, near=None):
    """The frequency with the largest amplitude, or that next to another one, by a window (1 − cos)³ (Laskar 1990)."""
    n, dt = len(t), t[1] - t[0]
    w = (1.0 - np.cos(TAU * (np.arange(n) + 0.5) / n)) ** 3
    s = (signal - np.average(signal, weights=w)) * w
    width = TAU / (n * dt)
    grid = np.fft.fftfreq(n, dt) * TAU
    spectrum = np.abs(np.fft.fft(s))
    if near is not None:
        spectrum[np.abs(grid - near) > 10.0 * width] = 0.0
    f0 = grid[int(np.argmax(spectrum))]

    def loss(f):
        return -abs(np.sum(s * np.exp(-1j * f * (t - t[0]))))

    return minimize_scalar(
        loss, bounds=(f0 - width, f0 + width), method="bounded", options={"xatol": 1e-13 * max(1.0, abs(f0))}
    ).x


def drift(of, start, T, n=1 << 14):
    """The relative change of the main frequency of two signals from [0, T/2] to [T/2, T], the larger one."""
    smooth = integrators(of)[2]
    set_up(smooth, of, start)
    grid = np.linspace(0.0, T, 2 * n, endpoint=False)
    y = smooth.propagate_grid(grid)[-1]
    i = of.d - 3
    found = []
    for signal in (y[:, i] + 1j * y[:, i + 1], y[:, i + 2] + 1j * y[:, 1]):
        first = frequency(grid[:n], signal[:n])
        found.append(abs(frequency(grid[n:], signal[n:], first) / first - 1.0))
    return max(found)


def zero_one(series):
    """K of the 0–1 test, the median over 40 frequencies."""
    n = len(series)
    lags = np.arange(1, n // 10 + 1)
    found = []
    for c in np.random.default_rng(7).uniform(0.2, pi - 0.2, 40):
        steps = np.exp(1j * c * np.arange(n)) * (series - series.mean())
        path = np.cumsum(steps)
        square = [np.mean(np.abs(path[m:] - path[:-m]) ** 2) for m in lags]
        found.append(np.corrcoef(lags, square)[0, 1])
    return float(np.median(found))


# ---- rows

OF: dict[str, Callable[..., Any]] = {
    "suslov": Suslov,
    "quartic": Quartic,
    "ball": Ball,
    "euler-poisson": Top,
}
"""By the names of the command `regime`, with the names of its options."""


QUASI_CLEAR = 2e-3
"""Crossings of quasi-periodic rows are farther apart than this after any of up to 64 returns."""
SAME = 1e-8


def measured(motion, of, place):
    """Return the numbers of one start."""
    start, T = of.start(*place), motion["T"]
    states = crossings(of, start, 4000)
    places = places_of(of, states)
    assert abs(of.energy(states[-1]) - of.E) < 1e-10
    near = closings(of, places[2000:], 600)
    again = np.flatnonzero(near < SAME)
    series = np.cos(places[:, 0]) if of.angles[0] else places[:, 0]
    (early, _), (late, sali) = growth(of, start, T)
    return {
        "ln_growth": (early, late),
        "sali": sali,
        "drift": drift(of, start, 2.0 * T),
        "K": zero_one(series),
        "closing": float(near[:64].min()),
        "period": int(again[0]) + 1 if again.size else 0,
    }


def judged(m, T):
    """Return the kind and the period that the numbers of one start agree on; ("", 0) where they do not."""
    (early, late), sali = m["ln_growth"], m["sali"]
    if early > 30.0 and late > early + 30.0 and sali < 1e-10 and (m["K"] > 0.8 or m["drift"] > 1e-4):
        return "CHAOTIC", 0
    # After t a neighbour of a regular motion has grown at most as t², and hardly more from T to 2T.
    if not (late < 2.2 * log(2.0 * T) and late - early < 2.5 and sali > 1e-8):
        return "", 0
    if period := m["period"]:
        return "FIXED_POINT" if period == 1 else "PERIODIC" if period <= 64 else "LONG_PERIOD", period
    if (m["drift"] < 1e-5 or m["K"] < 0.3) and m["closing"] > QUASI_CLEAR:
        return "QUASI_PERIODIC", 0
    return "", 0


def contradicted(motion, found):
    """Return whether the numbers of the starts contradict the label of the motion."""
    kinds, period, m = {judged(one, motion["T"]) for one in found}, motion["period"], found[0]
    if not motion["theorem"]:
        return kinds != {(motion["kind"], period)}
    if motion["kind"] == "QUASI_PERIODIC":
        agrees = not m["period"] and m["closing"] > QUASI_CLEAR
    else:
        agrees = m["period"] == period or motion["settling"]
    return not agrees or ("CHAOTIC", 0) in kinds


def check(motion):
    """Raise `ArithmeticError` where the label of a motion does not hold."""
    of, place = OF[motion["system"]](**motion["parameters"]), np.array(motion["place"])
    starts = [place] if motion["exact"] else [place, place + 1e-6]
    found = [measured(motion, of, one) for one in starts]
    if contradicted(motion, found):
        raise ArithmeticError(f"{motion['name']} is not {motion['kind']}, period {motion['period']}: {found}")


if __name__ == "__main__":
    for motion in json.loads(Path(__file__).with_name("labelled_motions.json").read_text()):
        # Those of the Suslov–Hess case have the trace of a Möbius map, which `circle_maps.py` computes.
        if motion["system"] == "hess":
            continue
        check(motion)
        print(f"{time.process_time():6.0f} s  {motion['kind']:15} {motion['period']:4}  {motion['name']}", flush=True)
