"""Check the labels of "labelled_motions.json".

Usage: `pip install heyoka; python tests/oracle/make_labelled_motions.py` (7 minutes).  Each row of the table names a
motion of a section and its kind.  Equations and sections are those of the package; orbits, crossings and variational
equations are Taylor series of heyoka at machine precision, and no kernel enters.  A kind is known by a theorem (an
integrable case, the trace of a Möbius map) or by computation.  In the second case these indicators agree after T and
after 2T, for the start and for another one 1e-6 away (only for the start if the row is `exact`):

growth : ln|δ| of a neighbour, linear in t on chaotic motions, at most 2.2 ln t on regular ones;
SALI : the angle between two neighbours (Skokos 2001), which falls exponentially on chaotic motions only;
K : the 0–1 test of the crossings (Gottwald and Melbourne 2009), close to 1 on chaotic motions; on regular ones close
to 0, but for slowly modulated ones.

Where they disagree, the script stops with an error.
"""

import sys
import time
from functools import cache
from math import log, pi
from pathlib import Path

import heyoka as hy
import numpy as np

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_mechanics import Plane, systems
from oracle.labelled import MOTIONS, returns_of

# ---- integration


class Crossed:
    """Collects the states at crossings after the start."""

    def __init__(self):
        self.states = []

    def __call__(self, ta, time, sign):
        if time > 1e-9:
            ta.update_d_output(time)
            self.states.append(ta.d_output.copy())

    def __deepcopy__(self, memo):
        return self


def height(surface, y):
    """Return the quantity that increases through 0 at a crossing; on g = ±π/2 it is G²γ3 − f M3."""
    if isinstance(surface, Plane):
        return surface.sense * (sum(n * x for n, x in zip(surface.normal, y, strict=True)) - surface.offset)
    return (y[0] ** 2 + y[1] ** 2 + y[2] ** 2) * y[5] - surface.f * y[2]


@cache
def integrators(name, surface):
    """With crossings, and with two neighbours by the variational equations; and what collects the crossings."""
    system, collected = systems()[name], Crossed()
    d = len(system.variables)
    y = hy.make_vars(*[f"y{i}" for i in range(d)])
    rates = system.field(y, [hy.par[i] for i in range(len(system.parameters))])
    plain = list(zip(y, rates, strict=True))
    crossing = hy.nt_event(height(surface, y), callback=collected, direction=hy.event_direction.positive)
    near = list(plain)
    for k in range(2):
        v = hy.make_vars(*[f"v{k}_{i}" for i in range(d)])
        near += [(v[i], sum(hy.diff(rates[i], y[j]) * v[j] for j in range(d))) for i in range(d)]
    return (
        hy.taylor_adaptive(plain, [0.1] * d, nt_events=[crossing]),
        hy.taylor_adaptive(near, [0.1] * len(near)),
        collected,
    )


def begun(section, start, neighbours=()):
    """The integrator without or with neighbours at the start, and what collects crossings."""
    plain, near, collected = integrators(section.system.name, section.surface)
    ta = near if len(neighbours) else plain
    ta.time = 0.0
    ta.state[:] = [*start, *np.ravel(neighbours)]
    ta.pars[:] = section.parameters[: len(ta.pars)]
    collected.states.clear()
    return ta, collected


def crossings(section, start, count, longest=1e6):
    """States (n, d) of the next crossings."""
    ta, collected = begun(section, start)
    found = []
    while len(found) < count and ta.time < longest:
        ta.propagate_for(20.0)
        if collected.states:
            states = np.array(collected.states)
            counted = section.is_on(states)
            if not isinstance(section.surface, Plane):
                # There g is π/2, and not −π/2.
                counted &= states[:, 3] * states[:, 1] > states[:, 4] * states[:, 0]
            found.extend(states[counted])
            collected.states.clear()
    return np.array(found[:count])


def closings(section, places, most):
    """The largest distance of places m apart (most,), m = 1, 2, …, with angles as points of circles."""
    parts = []
    for one, turn in zip(places.T, section.turns, strict=True):
        parts += [np.cos(one), np.sin(one)] if np.isfinite(turn) else [one]
    e = np.stack(parts, axis=1)
    return np.array([np.abs(e[m:] - e[:-m]).max() for m in range(1, most + 1)])


# ---- indicators


def growth(section, start, T):
    """ln|δ| and SALI after T and 2T."""
    d = len(start)
    v = np.random.default_rng(5).normal(size=(2, d))
    near, _ = begun(section, start, v / np.linalg.norm(v, axis=1)[:, None])
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


QUASI_CLEAR = 2e-3
"""Crossings of quasi-periodic rows are farther apart than this after any of up to 64 returns."""
SAME = 1e-8


def measured(motion, returns, place):
    """Return the numbers of one start."""
    section, start, T = returns.section, returns.state_at(place), motion["T"]
    states = crossings(section, start, 4000)
    before, after = (next(iter(section.system.integrals(y, section.parameters).values())) for y in (start, states[-1]))
    assert abs(after - before) < 1e-10
    places = section.points_of(states)
    near = closings(section, places[2000:], 600)
    again = np.flatnonzero(near < SAME)
    series = np.cos(places[:, 0]) if np.isfinite(section.turns[0]) else places[:, 0]
    (early, _), (late, sali) = growth(section, start, T)
    return {
        "ln_growth": (early, late),
        "sali": sali,
        "K": zero_one(series),
        "closing": float(near[:64].min()),
        "period": int(again[0]) + 1 if again.size else 0,
    }


def judged(m, T):
    """Return the kind and the period that the numbers of one start agree on; ("", 0) where they do not."""
    (early, late), sali = m["ln_growth"], m["sali"]
    if early > 30.0 and late > early + 30.0 and sali < 1e-10 and m["K"] > 0.8:
        return "CHAOTIC", 0
    # After t a neighbour of a regular motion has grown at most as t², and hardly more from T to 2T.
    if not (late < 2.2 * log(2.0 * T) and late - early < 2.5 and sali > 1e-8):
        return "", 0
    if period := m["period"]:
        return "FIXED_POINT" if period == 1 else "PERIODIC" if period <= 64 else "LONG_PERIOD", period
    return ("QUASI_PERIODIC", 0) if m["closing"] > QUASI_CLEAR else ("", 0)


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
    returns, place = returns_of(motion), np.array(motion["place"])
    starts = [place] if motion["exact"] else [place, place + 1e-6]
    found = [measured(motion, returns, one) for one in starts]
    if contradicted(motion, found):
        raise ArithmeticError(f"{motion['name']} is not {motion['kind']}, period {motion['period']}: {found}")


if __name__ == "__main__":
    for motion in MOTIONS:
        # Those of the Suslov–Hess case have the trace of a Möbius map, which `circle_maps.py` computes.
        if motion["system"] != "hess":
            check(motion)
            print(f"{time.process_time():6.0f} s  {motion['kind']:15} {motion['name']}", flush=True)
