"""Computes "labelled_motions.json" anew: `pip install heyoka; python tests/oracle/make_labelled_motions.py`.

Every row names a motion of a section and its kind, found without any code of the package: own right-hand sides and
sections, Taylor series of heyoka at machine precision, own variational equations.  A kind is known by a theorem (an
integrable case, the trace of a Möbius map), or by computation.  Then these agree for the start and for another one
1e-6 away, after T and after 2T:

growth : ln|δ| of a neighbour, linear in t on chaotic motions, at most 2.2 ln t on regular ones;
SALI : the angle of two neighbours (Skokos 2001), which falls exponentially on chaotic motions, not on regular ones;
drift : the change of the main frequency from the first half to the second (Laskar 1990), or
K : the 0–1 test of the crossings (Gottwald and Melbourne 2009), close to 1 on chaotic motions, to 0 on regular ones.

A row for which they disagree is left out, with a message.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import heyoka as hy
import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.special import ellipk

TAU = 2.0 * math.pi


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


def torus_field(y, p):
    w1, w2, n1, n2, n3 = y
    a = p[0]
    return [-a * w2 * w2 - n2, a * w1 * w2 + n1, -(a * n2 + n3) * w2, a * w2 * n1 + w1 * n3, n1 * w2 - n2 * w1]


# ---- what grows through 0 on a section; `value` is the constant of the section


def third_gamma(y, value):
    return y[4]


def second_omega(y, value):
    return y[1]


def minus_first_omega(y, value):
    return -y[0]


def above_middle(y, value):
    return y[4] - value


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
        u = np.array([math.cos(psi + delta), math.sin(psi + delta)])
        kinetic = self.E - self.p[4] * math.cos(psi) - self.p[5] * math.sin(psi)
        w = u * math.sqrt(2.0 * kinetic / (self.p[0] * u[0] ** 2 + self.p[1] * u[1] ** 2))
        return np.array([*w, math.cos(psi), math.sin(psi), 0.0])

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
        other = -math.sqrt(1.0 - g3 * g3 - y * y)
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
        g, u = (math.cos(psi), math.sin(psi)), (math.cos(psi + delta), math.sin(psi + delta))
        I11, I22, _, _, D, b1, b2, _ = self.p
        twice = I11 * u[0] ** 2 + I22 * u[1] ** 2 + D * (g[0] * u[1] - g[1] * u[0]) ** 2
        w = math.sqrt(2.0 * (self.E - b1 * g[0] - b2 * g[1]) / twice)
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
        s, c = math.sqrt(1.0 - x * x), self.f / G
        M = G * np.array([s * math.sin(l), s * math.cos(l), x])
        # On g = π/2 the part of γ across M is along v.
        return np.array([*M, *(c * M / G + math.sqrt(1.0 - c * c) * np.array([math.cos(l), -math.sin(l), 0.0]))])

    def excess(self, l, x, G):
        """The energy minus its value at the momenta G of a place."""
        s = math.sqrt(1.0 - x * x)
        n = np.array([s * math.sin(l), s * math.cos(l), x])
        cos = self.f / G
        across = math.cos(l) * self.mr[0] - math.sin(l) * self.mr[1]
        return (
            0.5 * self.A @ n**2 * G * G
            - cos * (self.mr @ n)
            - np.sqrt(1.0 - np.minimum(1.0, cos * cos)) * across
            - self.E
        )

    def momentum(self, l, x):
        """The largest G with this energy."""
        top = math.sqrt(2.0 * (self.E + np.linalg.norm(self.mr)) / self.A.min()) + abs(self.f) + 1.0
        low = max(abs(self.f) * (1.0 + 1e-15), 1e-9)
        G = low + (top - low) * np.linspace(0.0, 1.0, 1001) ** 3
        last = np.flatnonzero(self.excess(l, x, G) < 0.0)[-1]
        return brentq(lambda one: self.excess(l, x, one), G[last], G[last + 1], xtol=1e-15)

    def start(self, l, x):
        return self.state(l, x, self.momentum(l, x))

    def place(self, y):
        return np.array([math.atan2(y[0], y[1]), y[2] / np.linalg.norm(y[:3])])

    def energy(self, y):
        return 0.5 * self.A @ y[:3] ** 2 - self.mr @ y[3:]

    def counts(self, y):
        """Whether a crossing is one of g = π/2 and of the sheet with the largest G."""
        if y[3] * y[1] - y[4] * y[0] <= 0.0:
            return False
        if self.f == 0.0:
            return True
        G = np.linalg.norm(y[:3])
        # dh/dG > 0 there, and no larger root: the first sheet.
        return self.momentum(*self.place(y)) * (1.0 - 1e-6) <= G


class Torus:
    d, angles = 5, (True,)
    rhs, event = staticmethod(torus_field), staticmethod(above_middle)

    def __init__(self, a, h, f):
        self.p, self.E, self.f = [a], h, f
        roots = np.sort(np.roots([-2.0, -2.0 * h, 2.0, 2.0 * h - f * f]).real)
        self.roots = roots
        self.n3 = self.value = 0.5 * (roots[1] + roots[2])

    def start(self, phi):
        rho = math.sqrt(2.0 * (self.E + self.n3))
        along = self.f / rho
        across = math.sqrt(1.0 - self.n3**2 - along**2)
        s, c = math.sin(phi), math.cos(phi)
        return np.array([rho * s, rho * c, along * s + across * c, along * c - across * s, self.n3])

    def place(self, y):
        return np.array([math.atan2(y[0], y[1])])

    def energy(self, y):
        return 0.5 * (y[0] ** 2 + y[1] ** 2) - y[4]


# ---- integration

_MADE = {}


def tangent_system(of):
    """The field with two neighbours by the variational equations, and ∫ div."""
    d = of.d
    y = hy.make_vars(*[f"y{i}" for i in range(d)])
    p = [hy.par[i] for i in range(len(of.p))]
    rate = of.rhs(y, p)
    J = [[hy.diff(r, x) for x in y] for r in rate]
    eqs = list(zip(y, rate, strict=True))
    for k in range(2):
        v = hy.make_vars(*[f"v{k}_{i}" for i in range(d)])
        eqs += [(v[i], sum((J[i][j] * v[j] for j in range(d)), hy.expression(0.0))) for i in range(d)]
    eqs.append((hy.make_vars("vol"), sum((J[i][i] for i in range(d)), hy.expression(0.0)) + 0.0 * y[0]))
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
    """Times (n,), states (n, d) of the next crossings."""
    plain, _, _, collected = integrators(of)
    set_up(plain, of, start)
    collected.times, collected.states = [], []
    times, states, seen = [], [], 0
    while len(times) < count and plain.time < longest:
        plain.propagate_for(20.0)
        while seen < len(collected.times):
            t, y = collected.times[seen], collected.states[seen]
            seen += 1
            if t > 1e-9 and (not hasattr(of, "counts") or of.counts(y)):
                times.append(t)
                states.append(y)
    return np.array(times[:count]), np.array(states[:count])


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
    """ln|δ| and SALI after T and 2T, and the mean divergence over 2T."""
    near, d = integrators(of)[1], of.d
    v = np.random.default_rng(5).normal(size=(2, d))
    set_up(near, of, [*start, *(v / np.linalg.norm(v, axis=1)[:, None]).ravel(), 0.0])
    total, found = 0.0, []
    for t in range(5, int(2 * T) + 1, 5):
        near.propagate_until(float(t))
        v = near.state[d : 3 * d].reshape(2, d)
        size = np.linalg.norm(v, axis=1)
        total += math.log(size[0])
        v = v / size[:, None]
        near.state[d : 3 * d] = v.ravel()
        if t in (int(T), int(2 * T)):
            found.append((total, min(np.linalg.norm(v[0] + v[1]), np.linalg.norm(v[0] - v[1]))))
    return found, near.state[3 * d] / (2 * T)


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
    for c in np.random.default_rng(7).uniform(0.2, math.pi - 0.2, 40):
        steps = np.exp(1j * c * np.arange(n)) * (series - series.mean())
        path = np.cumsum(steps)
        square = [np.mean(np.abs(path[m:] - path[:-m]) ** 2) for m in lags]
        found.append(np.corrcoef(lags, square)[0, 1])
    return float(np.median(found))


# ---- periodic orbits


def after(of, place, m):
    """The place after m crossings."""
    return places_of(of, crossings(of, of.start(*place), m)[1])[-1]


def shifted(of, away):
    """Differences of places, angles to the nearest turn."""
    return np.array([math.remainder(x, TAU) if turning else x for x, turning in zip(away, of.angles, strict=True)])


def derivative(of, place, m, step=1e-6):
    """D Pᵐ by central differences."""
    return np.stack(
        [
            shifted(of, after(of, place + e, m) - after(of, place - e, m)) / (2.0 * step)
            for e in step * np.eye(len(place))
        ],
        axis=1,
    )


def closed(of, place, m):
    """The place next to this one that m crossings bring back, by Newton's method."""
    place = np.array(place, float)
    for _ in range(12):
        away = shifted(of, after(of, place, m) - place)
        if np.abs(away).max() < 2e-13:
            break
        place = place - np.linalg.solve(derivative(of, place, m) - np.eye(len(place)), away)
    return place


def multipliers(of, place, m):
    return sorted((complex(x) for x in np.linalg.eigvals(derivative(of, np.array(place, float), m))), key=abs)


# ---- the Möbius map of a torus of the Suslov–Hess case


def trace(a, h, f):
    """Trace of the matrix in SU(1, 1) by which z = e^{iφ} is mapped in one period of n3.

    φ' = α + β cos φ with α = −f/ρ², β = −aρ, ρ² = 2(h + n3) is linear in the homogeneous coordinates of z.
    """
    if "torus" not in _MADE:
        n, v, ar, ai, br, bi = hy.make_vars("n", "v", "ar", "ai", "br", "bi")
        square = 2.0 * (hy.par[1] + n)
        alpha, beta = -0.5 * hy.par[2] / square, -0.5 * hy.par[0] * hy.sqrt(square)
        _MADE["torus"] = hy.taylor_adaptive(
            [
                (n, v),
                (v, 1.0 - n * n - square * n),
                (ar, beta * bi - alpha * ai),
                (ai, alpha * ar + beta * br),
                (br, beta * ai - alpha * bi),
                (bi, alpha * br + beta * ar),
            ],
            [0.1] * 6,
        )
    ta = _MADE["torus"]
    n0, n1, n2 = Torus(a, h, f).roots
    ta.time = 0.0
    ta.state[:] = [n1, 0.0, 1.0, 0.0, 0.0, 0.0]
    ta.pars[:] = [a, h, f]
    ta.propagate_until(2.0 * math.sqrt(2.0 / (n2 - n0)) * ellipk((n2 - n1) / (n2 - n0)))
    return 2.0 * ta.state[2]


def torus_with(value, a, f, low, high):
    """h of the torus (a, h, f) with this trace."""
    return brentq(lambda h: trace(a, h, f) - value, low, high, xtol=1e-15)


# ---- rows

OF: dict[str, Callable[..., Any]] = {
    "suslov": Suslov,
    "quartic": Quartic,
    "ball": Ball,
    "euler-poisson": Top,
    "hess": Torus,
}
"""By the names of the command `regime`, with the names of its options."""


@dataclass
class Row:
    """A motion; what it is by a theorem, where there is one.

    exact : the kind is that of this start and not of those near it; settling : the transient outlasts 500 crossings.
    """

    name: str
    system: str
    parameters: dict[str, Any]
    place: tuple[float, ...]
    category: str
    theorem: str = ""
    kind: str = ""
    period: int = 0
    T: float = 4000.0
    exact: bool = False
    settling: bool = False
    numbers: dict[str, Any] = field(default_factory=dict)

    @property
    def of(self):
        return OF[self.system](**self.parameters)


QUASI_CLEAR = 2e-3
"""Crossings of quasi-periodic rows are farther apart than this after any of up to 64 returns."""
SAME = 1e-8


def measured(row, place):
    """The numbers of one start."""
    of = row.of
    start = of.start(*place)
    times, states = crossings(of, start, 4000)
    places = places_of(of, states)
    found, divergence = growth(of, start, row.T)
    near = closings(of, places[2000:], 600)
    again = np.flatnonzero(near < SAME)
    series = np.cos(places[:, 0]) if of.angles[0] else places[:, 0]
    return {
        "return_time": float(times[-1] / len(times)),
        "energy_error": float(abs(of.energy(states[-1]) - of.E)),
        "ln_growth": [float(one[0]) for one in found],
        "sali": [float(one[1]) for one in found],
        "exponent": float(found[1][0] / (2.0 * row.T)),
        "divergence": float(divergence),
        "drift": [drift(of, start, row.T), drift(of, start, 2.0 * row.T)],
        "K": [zero_one(series[:2000]), zero_one(series)],
        "closing": float(near[:64].min()),
        "period": int(again[0]) + 1 if again.size else 0,
    }


def judged(m, T):
    """The kind that the numbers of one start agree on; "" where they do not."""
    (early, late), (_, sali) = m["ln_growth"], m["sali"]
    if early > 30.0 and late > early + 30.0 and sali < 1e-10 and (m["K"][1] > 0.8 or m["drift"][1] > 1e-4):
        return "CHAOTIC", 0
    # After t a neighbour of a regular motion has grown at most as t², and hardly more from T to 2T.
    if not (late < 2.2 * math.log(2.0 * T) and late - early < 2.5 and sali > 1e-8):
        return "", 0
    if m["period"]:
        m_ = m["period"]
        return ("FIXED_POINT" if m_ == 1 else "PERIODIC" if m_ <= 64 else "LONG_PERIOD"), m_
    if (m["drift"][1] < 1e-5 or m["K"][1] < 0.3) and m["closing"] > QUASI_CLEAR:
        return "QUASI_PERIODIC", 0
    return "", 0


def labelled(row):
    """The row as JSON has it; None where nothing is certain."""
    place = np.array(row.place, float)
    starts = [place] if row.exact else [place, place + 1e-6]
    found = [measured(row, one) for one in starts]
    kinds = {judged(m, row.T) for m in found}
    if row.theorem:
        kind, period = row.kind, row.period
        m = found[0]
        # What the theorem says is seen too; indicators may take longer.
        agrees = {
            "FIXED_POINT": row.settling or m["period"] == 1,
            "PERIODIC": m["period"] == period,
            "LONG_PERIOD": m["period"] == period,
            "QUASI_PERIODIC": not m["period"] and m["closing"] > QUASI_CLEAR,
        }[kind]
        if not agrees or ("CHAOTIC", 0) in kinds:
            print("NOT AS THE THEOREM SAYS:", row.name, kinds, found)
            return None
    else:
        kind, period = kinds.pop() if len(kinds) == 1 else ("", 0)
        if not kind:
            print("UNCERTAIN:", row.name, kinds, found)
            return None
    numbers = {**found[0], **row.numbers}
    numbers["exponents"] = [m["exponent"] for m in found]
    if period and row.system != "hess":
        of = row.of
        last = places_of(of, crossings(of, of.start(*place), 2000)[1])[-1]
        mu = multipliers(of, place if row.exact else last, period)
        numbers["multipliers"] = [[x.real, x.imag] for x in mu]
    return {
        "name": row.name,
        "system": row.system,
        "parameters": row.parameters,
        "place": list(map(float, row.place)),
        "category": row.category,
        "kind": kind,
        "period": 1 if kind == "FIXED_POINT" else period,
        "settling": row.settling,
        "how": f"theorem: {row.theorem}"
        if row.theorem
        else f"computed: Newton's method, T = {row.T:g} and {2 * row.T:g}"
        if row.exact
        else f"computed: T = {row.T:g} and {2 * row.T:g}, two starts",
        "numbers": {key: rounded(value) for key, value in numbers.items() if key not in ("period", "exponent")},
    }


def rounded(value):
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return float(f"{value:.4g}")


def suslov(name, I, b, E, place, category, **more):
    return Row(name, "suslov", {"I": I, "b": b, "E": E}, place, category, **more)


def above(I, b, h):
    """A body of the Suslov problem at the energy h above the bottom."""
    return {"I": I, "b": b, "E": h - math.hypot(*b)}


def in_field(I, D, b, h):
    """A ball at the energy h above the lowest on its section."""
    return {"I": I, "D": D, "b": b, "h": h - math.hypot(b[0], b[1])}


def hess_top(I, strength, h, f, away=0.0):
    """A heavy body in the Hess case, its centre of mass turned away by an angle."""
    a = [1.0 / one for one in I]
    angle = math.atan2(math.sqrt(abs(a[2] - a[1])), math.sqrt(abs(a[1] - a[0]))) + away
    return {"A": a, "r": [math.cos(angle), 0.0, math.sin(angle)], "mu": strength, "h": h, "f": f}


def top(A, r, mu, h, f):
    return {"A": list(A), "r": list(r), "mu": mu, "h": h, "f": f}


EULER = {"A": (1.0, 0.625, 0.25), "r": (0.0, 0.0, 1.0), "mu": 0.0, "h": 1.5, "f": 0.7}
IN_EULER = "Euler's case, μ = 0: M and γ move by elliptic functions on tori"
IN_LAGRANGE = "Lagrange's case, a1 = a2, r along e3: M3 is an integral"
IN_KOVALEVSKAYA = "Kovalevskaya's case, A ∝ (1, 1, 2), r across e3: her integral"
IN_GC = "case of Goryachev and Chaplygin, A ∝ (1, 1, 4), r across e3, (M, γ) = 0"
CENTRAL = "I11 = I22, a point in a central potential: q1p2 − q2p1 is an integral"
MOEBIUS = "a circle map of Möbius"
CLOSED = "I13 = I23 = 0, b3 = 0: every orbit closes"


def resonant(period, x0, x1):
    """x = L/G of an orbit of Euler's case at l = 0 that closes after so many crossings and not before."""
    of = Top(**EULER)

    def off(x):
        return float(shifted(of, after(of, (0.0, x), period) - (0.0, x))[0])

    x = np.linspace(x0, x1, 40)
    values = [off(one) for one in x]
    for i in range(len(x) - 1):
        if values[i] * values[i + 1] < 0.0 and abs(values[i] - values[i + 1]) < 1.0:
            root = brentq(off, x[i], x[i + 1], xtol=1e-16)
            if closings(of, places_of(of, crossings(of, of.start(0.0, root), 2 * period)[1]), period)[:-1].min() > 1e-3:
                return root
    raise ValueError(f"no orbit of period {period} between {x0} and {x1}")


def euler_rows():
    def row(name, place, category, kind="QUASI_PERIODIC", period=0, **changes):
        return Row(
            f"Euler, {name}",
            "euler-poisson",
            top(**{**EULER, **changes}),
            place,
            category,
            IN_EULER,
            kind,
            period,
            exact=bool(period),
        )

    yield row("next to the separatrix", (0.001, 0.001), "near-separatrix")
    yield row("next to the separatrix, on its other side", (3.14, 0.002), "near-separatrix")
    yield row("near the separatrix", (0.02, 0.0), "near-separatrix")
    yield row("about the third axis", (0.8, 0.3), "integrable")
    yield row("about the first axis", (1.2, 0.2), "integrable")
    yield row("another body", (0.5, 0.4), "integrable", A=(0.9, 0.7, 0.5), h=2.0, f=-1.0)
    yield row("rotation about the first axis", (0.5 * math.pi, 0.0), "integrable", "FIXED_POINT", 1)
    for period, x0, x1 in ((5, 0.2, 0.9), (37, 0.6, 0.7), (89, 0.6, 0.65)):
        yield row(
            f"an orbit that closes after {period} returns",
            (0.0, resonant(period, x0, x1)),
            "long-period" if period > 16 else "integrable",
            "LONG_PERIOD" if period > 64 else "PERIODIC",
            period,
        )


def integrable_rows():
    def at(name, parameters, place, theorem, category="integrable"):
        return Row(name, "euler-poisson", parameters, place, category, theorem, "QUASI_PERIODIC")

    lagrange = top((1.0, 1.0, 0.5), (0.0, 0.0, 1.0), 1.0, 1.5, 0.7)
    for place in ((0.3, 0.2), (1.0, -0.5), (0.0, 0.8)):
        yield at(f"Lagrange, L/G = {place[1]}", lagrange, place, IN_LAGRANGE)
    # M3 = f = 1 and h = a3/2 + 1 is a sleeping top, unstable: f² < 4 I1 μ.
    sleeping = top((1.0, 1.0, 0.5), (0.0, 0.0, 1.0), -1.0, 1.25, 1.0)
    of = Top(**sleeping)
    for M3 in (0.999, 0.9999):
        x = brentq(lambda x, M3=M3: of.momentum(0.0, x) * x - M3, 0.3, 0.9999)
        yield at(
            f"Lagrange, next to the unstable sleeping top, M3 = {M3}",
            sleeping,
            (0.0, x),
            IN_LAGRANGE,
            "near-separatrix",
        )
    for h, f, places in ((1.0, 0.6, ((0.3, 0.2), (0.0, 0.8), (2.0, 0.1))), (2.0, 0.3, ((1.0, -0.5), (-2.0, 0.4)))):
        for place in places:
            yield at(
                f"Kovalevskaya, h = {h}, l = {place[0]}",
                top((0.5, 0.5, 1.0), (1.0, 0.0, 0.0), 1.0, h, f),
                place,
                IN_KOVALEVSKAYA,
            )
    for h, places in ((2.0, ((0.3, 0.2), (1.0, -0.5), (2.0, 0.1))), (0.5, ((0.3, 0.2), (0.0, 0.8)))):
        for place in places:
            yield at(
                f"Goryachev–Chaplygin, h = {h}, l = {place[0]}",
                top((1.0, 1.0, 4.0), (1.0, 0.0, 0.0), 1.0, h, 0.0),
                place,
                IN_GC,
            )


def principal_rows():
    def central(name, I, h, place, category):
        return Row(
            f"Quartic, {name}", "quartic", {"I": [I, I], "b3": 1.0, "h": h}, place, category, CENTRAL, "QUASI_PERIODIC"
        )

    yield central("slow: past the top of the potential", 1.3, 0.999, (0.01, 0.02), "slow")
    yield central("slower: past the top of the potential", 1.0, 0.99999, (0.02, 0.001), "slow")
    yield central("near its separatrix", 1.0, 0.995, (0.3, 0.0), "near-separatrix")
    yield central("equal moments", 1.0, 0.6, (0.5, 0.3), "integrable")
    yield central("equal moments, in a ring", 1.0, 1.5, (1.8, 0.2), "integrable")
    yield Row(
        "Ball, equal moments",
        "ball",
        in_field([1.0, 1.0, 0.0, 0.0], 3.0, [0.0, 0.0, 1.0], 1.5),
        (1.0, 1.5),
        "integrable",
        "I11 = I22, b along e3: ω1γ1 + ω2γ2 is an integral",
        "QUASI_PERIODIC",
    )
    yield Row(
        "Ball, b3 = 0",
        "ball",
        in_field([1.0, 2.0, 0.0, 0.0], 1.0, [1.0, 0.5, 0.0], 2.618),
        (0.5, 1.5),
        "integrable",
        CLOSED,
        "FIXED_POINT",
        1,
    )
    yield suslov(
        "Kharlamova, b3 = 0",
        [2.0, 1.0, 0.0, 0.0],
        [0.4, 0.7, 0.0],
        1.2,
        (1.0, 1.2),
        "integrable",
        theorem=CLOSED,
        kind="FIXED_POINT",
        period=1,
    )
    yield suslov(
        "Kharlamova, equal moments",
        [1.0, 1.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        0.3,
        (2.0, 0.8),
        "integrable",
        theorem=CLOSED,
        kind="FIXED_POINT",
        period=1,
    )


def torus_rows():
    def row(name, a, h, f, place, category, period=0, settling=False):
        tr = trace(a, h, f)
        more = {"trace": tr}
        if abs(tr) > 2.0:
            more["multiplier"] = (0.5 * (abs(tr) - math.sqrt(tr * tr - 4.0))) ** 2
        else:
            more["rotation_number"] = math.acos(0.5 * tr) / math.pi
        theorem = f"{MOEBIUS}, |trace| {'above' if abs(tr) > 2.0 else 'below'} 2"
        kind = (
            "FIXED_POINT"
            if abs(tr) > 2.0
            else "QUASI_PERIODIC"
            if not period
            else "PERIODIC"
            if period <= 64
            else "LONG_PERIOD"
        )
        return Row(
            f"Torus, {name}",
            "hess",
            {"a": a, "h": h, "f": f},
            (place,),
            category,
            theorem,
            kind,
            1 if abs(tr) > 2.0 else period,
            exact=bool(period),
            settling=settling,
            numbers=more,
        )

    yield row("locked", 0.5, 1.5, 0.6, 0.3, "integrable")
    yield row("locked, a = 0.7", 0.7, 0.5, 0.6, 1.0, "integrable")
    yield row("it winds", 0.1, 0.8, 0.6, 0.3, "integrable")
    yield row("it winds, a = 0.5", 0.5, 0.2, 0.5, 0.3, "integrable")
    yield row("f near 0, rotation, locked", 0.3, 1.5, 1e-3, 0.3, "near-separatrix")
    yield row("near the separatrix, h near 1", 0.2, 1.001, 0.01, 0.3, "near-separatrix")
    for p, q in ((2, 7), (5, 16), (13, 60), (20, 89)):
        h = torus_with(2.0 * math.cos(math.pi * p / q), 0.3, 0.6, 0.0, 1.05)
        yield row(f"rotation number {p}/{q}", 0.3, h, 0.6, 0.3, "long-period" if q > 16 else "integrable", q)
    # Next to the edge of the lock zone: 2 − trace is small.
    for off in (1e-3, -1e-3):
        h = torus_with(2.0 - off, 0.3, 0.6, 1.0, 1.2)
        side = "outside" if off > 0.0 else "inside"
        yield row(f"next to the edge of the lock zone, {side}", 0.3, h, 0.6, 0.3, "slow")
    h = torus_with(2.0 + 1e-5, 0.3, 0.6, 1.0, 1.2)
    yield row("at the edge of the lock zone, inside: 2000 returns to settle", 0.3, h, 0.6, 0.3, "slow", settling=True)


def doubling(I23):
    return above([1.1, 2.9, -0.9, I23], [-1.7, -1.6, 1.2], 2.3)


def breaking(I13):
    return above([1.5, 1.0, I13, 0.4], [1.1, -1.6, 1.8], 4.2)


def attractor_rows():
    start = (0.7248, 1.8925)
    for I23, category in (
        (-0.1, "attractor"),
        (0.0, "attractor"),
        (0.1, "attractor"),
        (0.133, "attractor"),
        (0.139, "attractor"),
        (0.1399, "long-period"),
        (0.14015, "long-period"),
        (0.140207, "long-period"),
        (0.1402135, "long-period"),
        (0.140221, "long-period"),
    ):
        # Motions that begin elsewhere are chaotic for hundreds of returns.
        of = Suslov(**doubling(I23))
        place = np.round(places_of(of, crossings(of, of.start(*start), 12_000)[1])[-1], 8)
        yield Row(f"Suslov, cascade, I23 = {I23}", "suslov", doubling(I23), tuple(place), category)
    for I13, category in (
        (-0.257, "attractor"),
        (-0.2585, "attractor"),
        (-0.25925, "long-period"),
        (-0.258, "long-period"),
        (-0.247, "attractor"),
        (-0.25, "attractor"),
    ):
        yield Row(f"Suslov, a torus is born and locks, I13 = {I13}", "suslov", breaking(I13), (1.2, 1.45), category)
    yield Row("Suslov, a torus attracts, I13 = -0.256", "suslov", breaking(-0.256), (1.2, 1.45), "attractor")
    two = {"I": [1.5, 1.0, 0.4, 0.0], "b": [0.3, -0.5, 1.0], "E": 1.842}
    yield Row("Suslov, the first of two attractors", "suslov", two, (1.5, 1.2), "attractor")
    yield Row("Suslov, the second of two attractors", "suslov", two, (-2.0, 2.0), "attractor")
    yield suslov(
        "Suslov, reversal: a permanent rotation attracts",
        [1.0, 3.0, 0.6, 0.6],
        [1.0, 0.7, 0.3],
        1.743,
        (1.0, 1.0),
        "attractor",
    )
    for D, place, category in (
        (1.39, (-2.680708, 0.992949), "long-period"),
        (1.41, (-2.6813, 0.9923), "attractor"),
        (1.5, (-2.6813, 0.9923), "attractor"),
        (1.65, (-2.6813, 0.9923), "attractor"),
    ):
        yield Row(
            f"Ball, cascade, D = {D}",
            "ball",
            in_field([1.5, 3.0, -0.3, 0.0], D, [1.0, -0.7, 0.7], 2.72),
            place,
            category,
        )
    yield Row(
        "Ball, cascade, D = 1.592: close to a doubling, settles slowly",
        "ball",
        in_field([1.5, 3.0, -0.3, 0.0], 1.592, [1.0, -0.7, 0.7], 2.72),
        (-2.6813, 0.9923),
        "slow",
        settling=True,
    )
    strange = "strange attractor"
    yield suslov("Suslov, strange attractor", [1.0, 2.5, 0.6, 0.6], [-1.0, -0.5, 0.7], 0.681, (1.0, 1.0), strange)
    yield Row(
        "Suslov, touching its repeller",
        "suslov",
        above([2.7, 1.4, -0.2, 0.8], [-0.4, 1.9, -1.4], 4.6),
        (-0.5986, 1.6433),
        strange,
    )
    yield Row(
        "Suslov, back to a saddle-focus",
        "suslov",
        above([0.7, 2.8, 0.2, 0.2], [1.0, -1.8, -1.2], 5.015931),
        (-2.62543193, 3.13213405),
        strange,
    )
    yield Row(
        "Ball, strange attractor",
        "ball",
        in_field([1.5, 3.0, -0.3, 0.0], 1.0, [1.0, -0.7, 0.7], 2.72),
        (2.5, 1.5),
        strange,
    )
    yield Row(
        "Ball, a wide strange attractor",
        "ball",
        in_field([1.5, 3.0, -0.1, 0.4], 4.0, [-0.8, -0.3, -0.7], 1.0),
        (0.4, 1.5),
        strange,
    )
    yield Row("Suslov, beyond the cascade, I23 = 0.2", "suslov", doubling(0.2), start, "weakly chaotic")
    yield Row("Suslov, the torus has broken up", "suslov", breaking(-0.2605), (1.2, 1.45), "weakly chaotic", T=8000.0)
    yield Row(
        "Suslov, a sea with a small divergence",
        "suslov",
        {"I": [1.5, 1.7, 0.1, -0.3], "b": [-1.7, 1.0, 2.0], "E": -0.9089144},
        (-1.0063, 1.1872),
        "chaotic",
    )


def mixed_rows():
    axis = above([1.5, 1.0, 0.0, 0.0], [0.4, -0.3, 0.8], 1.643398)
    yield Row("Suslov on a principal axis, in the sea", "suslov", axis, (0.0, 1.5), "chaotic")
    yield Row("Suslov on a principal axis, in an island", "suslov", axis, (1.0, 1.0), "mixed")
    plain = {"I": [1.5, 4.0, 0.0, 0.8], "b": [0.0, 1.0, 0.7], "E": -0.521}
    yield Row("Suslov, a curve", "suslov", plain, (-1.5, 1.0), "regular")
    yield Row(
        "Suslov, in the middle of the curves", "suslov", plain, (-0.5 * math.pi, 0.5 * math.pi), "regular", exact=True
    )
    for ratio, h, place, category in (
        (2.0, 0.8, (0.2, 0.0), "mixed"),
        (2.0, 0.8, (0.6, 0.4), "chaotic"),
        (2.0, 0.8, (0.9, 0.1), "weakly chaotic"),
        (3.0, 1.2, (1.5, 0.3), "chaotic"),
        (1.05, 0.6, (1.0, 0.2), "regular"),
        (1.05, 0.6, (0.2, 0.1), "regular"),
        (1.5, 0.8, (0.6, 0.05), "weakly chaotic"),
        (1.2, 0.8, (0.6, 0.05), "weakly chaotic"),
        (1.5, 3.0, (2.8, 0.15), "slow"),
    ):
        yield Row(
            f"Quartic, I11/I22 = {ratio}, h = {h}, q = {place[0]}",
            "quartic",
            {"I": [ratio, 1.0], "b3": 1.0, "h": h},
            place,
            category,
            T=10_000.0 if category == "weakly chaotic" else 4000.0,
        )
    ball = in_field([1.0, 3.0, 0.0, 0.0], 5.0, [0.5, 0.0, 0.8], 2.0)
    for name, system, parameters, period, guess in (
        ("Quartic, an elliptic fixed point", "quartic", {"I": [2.0, 1.0], "b3": 1.0, "h": 0.8}, 1, (0.2, 0.0)),
        ("Quartic, an elliptic orbit of period 2", "quartic", {"I": [1.05, 1.0], "b3": 1.0, "h": 0.6}, 2, (0.5, 0.3)),
        ("Ball, an elliptic orbit of period 2", "ball", ball, 2, (2.0, 2.5)),
        ("Ball, an elliptic orbit of period 3", "ball", ball, 3, (2.0, 2.5)),
        (
            "Figure 13 f, an elliptic fixed point",
            "euler-poisson",
            hess_top((1.0, 1.5, 2.0), -math.sqrt(0.5), 2.0, 0.0),
            1,
            (-1.5, -0.2),
        ),
    ):
        place = closed(of := OF[system](**parameters), guess, period)
        if of.angles[0]:
            place[0] = math.remainder(place[0], TAU)
        yield Row(name, system, parameters, tuple(place), "mixed", exact=True)
    yield Row("Ball, in the sea", "ball", ball, (0.1, 1.5), "weakly chaotic", T=10_000.0)
    yield Row("Ball, a curve", "ball", ball, (-1.0, 0.5), "mixed")
    yield Row(
        "Ball, a sea nearly everywhere",
        "ball",
        in_field([1.0, 4.0, 0.0, 0.0], 2.0, [0.3, 0.0, 1.0], 0.8),
        (1.0, 1.5),
        "chaotic",
    )
    for letter, h, f, place, category in (
        ("13 a", -0.4, 0.0, (2.8, 0.3), "regular"),
        ("13 c", 0.5, 0.0, (2.8, 0.3), "weakly chaotic"),
        ("13 c", 0.5, 0.0, (-1.5, -0.2), "weakly chaotic"),
        ("13 d", math.sqrt(0.5), 0.0, (2.8, 0.3), "regular"),
        ("13 f", 2.0, 0.0, (2.8, 0.3), "chaotic"),
        ("13 f", 2.0, 0.0, (-1.5, -0.2), "mixed"),
        ("14 b", 0.2, 1.0, (-1.54, -0.86), "regular"),
        ("14 f", 1.3, 1.0, (2.8, 0.3), "chaotic"),
        ("14 f", 1.3, 1.0, (-1.54, -0.86), "mixed"),
    ):
        yield Row(
            f"Figure {letter}, l = {place[0]}",
            "euler-poisson",
            hess_top((1.0, 1.5, 2.0), -math.sqrt(0.5), h, f),
            place,
            category,
            T=10_000.0 if category == "weakly chaotic" else 4000.0,
        )
    eleven = hess_top((1.0, 1.6, 4.0), 1.0, 1.5, -0.76)
    yield Row("Figure 11, in the layer", "euler-poisson", eleven, (0.0, 0.2), "chaotic")
    yield Row("Figure 11, in the other layer", "euler-poisson", eleven, (-1.0, -0.8), "chaotic")
    yield Row(
        "Euler with a little weight, at the separatrix",
        "euler-poisson",
        top((1.0, 0.625, 0.25), (0.6, 0.0, 0.8), 0.01, 1.5, 0.7),
        (0.03, 0.02),
        "near-separatrix",
        T=10_000.0,
    )
    yield Row(
        "Goryachev–Chaplygin with f = 0.1",
        "euler-poisson",
        top((1.0, 1.0, 4.0), (1.0, 0.0, 0.0), 1.0, 2.0, 0.1),
        (2.0, 0.1),
        "chaotic",
    )
    yield Row(
        "Next to Kovalevskaya, A3 = 1.2",
        "euler-poisson",
        top((0.5, 0.5, 1.2), (1.0, 0.0, 0.0), 1.0, 1.0, 0.6),
        (1.0, -0.5),
        "chaotic",
    )
    yield Row(
        "Next to Kovalevskaya, A3 = 1.05",
        "euler-poisson",
        top((0.5, 0.5, 1.05), (1.0, 0.0, 0.0), 1.0, 1.0, 0.6),
        (0.1, 0.0),
        "regular",
    )
    yield Row(
        "Next to Lagrange, r1 = 0.1",
        "euler-poisson",
        top((1.0, 1.0, 0.5), (0.1, 0.0, 1.0), 1.0, 1.5, 0.7),
        (0.1, 0.0),
        "regular",
    )


TABLE = Path(__file__).with_name("labelled_motions.json")

if __name__ == "__main__":
    known = []
    for make in (euler_rows, integrable_rows, principal_rows, torus_rows, attractor_rows, mixed_rows):
        for row in make():
            if (one := labelled(row)) is not None:
                known.append(one)
                print(f"{time.process_time():6.0f} s  {one['kind']:15} {one['period']:4}  {row.name}", flush=True)
    TABLE.write_text("[\n" + ",\n".join(json.dumps(one, ensure_ascii=False) for one in known) + "\n]\n")
    print(len(known), "rows")
