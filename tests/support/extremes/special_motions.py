"""The rows of `test_extremes` for the bridge to Euler–Poisson, the loxodromic pendulum and e on a principal axis."""

from functools import cache
from math import atan2, cos, inf, sin, sqrt

import numpy as np

from hess_mechanics import HessBody, f_max, solve, systems, turning_points
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.euler_poisson.hess_manifold import run_free
from hess_mechanics.euler_poisson.loxodromic_pendulum import LoxodromicPendulum, loxodromic_motion
from hess_mechanics.suslov import kharlamova, quartic
from hess_mechanics.suslov.kharlamova import PlaneBody
from hess_mechanics.suslov.quartic import QuarticBody
from support.loxodrome import closed_form

SUSLOV = systems()["suslov"]
GESS1 = Bridge.of_heavy(HeavyBody.hess((1.0, 0.625, 0.375), 9.975))
SADDLE = "the saddle magnifies the rounding of the start"


def heavy(moments, mu):
    return Bridge.of_heavy(HeavyBody.hess(moments, mu))


def bridge_row(Row, name, bridge, h, share=0.3, periods=20, samples=801):
    """Euler–Poisson held on the manifold against Suslov's motion at `reference`, relative to the fastest ω."""
    turning = turning_points(h, share * f_max(h))
    start = tuple(bridge.from_reduced(bridge.hess.from_units_of_b(turning.state_at_lower_turn(0.5))))
    end = periods * turning.period / bridge.hess.frequency_unit

    @cache
    def truth():
        other = solve(
            bridge.hess.suslov,
            bridge.hess.from_reduced(bridge.to_reduced(start)),
            np.linspace(0.0, end, samples),
            "reference",
        )
        return bridge.hess.in_units_of_b(bridge.hess.to_reduced(other.states))

    def error(grade):
        run = run_free(bridge.heavy, start, end, samples, grade, held=True)
        # Off the manifold the two have no state in common.
        return (
            inf
            if np.max(np.abs(run.off)) >= 1e-12
            else float(np.max(bridge.distance(run.states, truth())) / sqrt(2.0 * (h + 1.0)))
        )

    return Row(f"bridge: {name}", f"Suslov's motion, {periods} periods", error, floor=2e-11)


def pendulum_row(Row, name, span, moments=(1.0, 1.5, 2.0), h=1.5, l=0.4, mu=0.7, because=""):
    """Both directions in space against the closed form, in units of their speed."""
    one = LoxodromicPendulum(HeavyBody.hess(moments, mu), h, l)
    scale = 4.0 * sqrt(2.0 * (h + 1.0) + 4.0)

    def motion(grade):
        return loxodromic_motion(one, span / one.frequency_unit, grade)

    def error(grade):
        found = motion(grade)
        axes = found.attitude.axes
        if np.max(np.abs(axes @ axes.transpose(0, 2, 1) - np.eye(3))) >= 1e-14:
            return inf
        centre, middle = closed_form(one, found.orbit.times)
        return float(max(np.max(np.abs(found.centre - centre)), np.max(np.abs(found.middle - middle)))) / scale

    def admitted(grade):
        return error(grade) <= motion(grade).orbit.error_estimate

    return Row(f"loxodrome: {name}", "Jacobi's functions", error, because=because, admitted=admitted)


def arc_row(Row, name, body, q, p, floor=1e-12, because=""):
    """Return a row for the closure error of an orbit with b3 = 0 after its closed-form period; ω is relative."""
    start = np.array(kharlamova.state_at(body, q, p))
    arc = kharlamova.arc(body, start)
    unit = np.array([arc.rate, arc.rate, 1.0, 1.0, 1.0])

    def error(grade):
        there = solve(body, start, [arc.period], grade).states[0]
        return float(np.max(np.abs(there - start) / unit))

    return Row(
        f"principal axis, b3 = 0: {name}", "closed after the period in closed form", error, floor=floor, because=because
    )


def quartic_row(Row, name, body, q):
    """γ² = 1, with γ1 and γ2 from the momenta, and γ3 against the height of the place, relative to h/b3."""
    start = quartic.state_at(body, q, 0.5)
    times = np.linspace(0.0, 5.0 * sqrt(body.I11 / abs(body.b3)), 60)
    ratio = abs(body.E / body.b3)

    def error(grade):
        states = solve(body, start, times, grade).states
        places, p = body.to_plane(states)
        # The error of γ² is twice that of γ, whose length is at most √3 times a component's.
        length = np.abs(np.sum(p * p, axis=1) + states[:, 4] ** 2 - 1.0) / (2.0 * sqrt(3.0))
        return float(max(length.max(), np.abs(states[:, 4] - body.height(places)).max() / max(1.0, ratio)))

    # γ3 from ω cancels where ω is large: what h/b3 loses of it.
    return Row(f"quartic potential: {name}", "γ² = 1", error, floor=1e-12 + 1e-15 * ratio)


def rows(Row):
    """The rows."""
    plane = PlaneBody(1.5, 1.0, 0.4, 0.7)
    weak = PlaneBody(1.5, 1.0, 1e-10, 2e-10)
    round_body = PlaneBody(1.0, 1.0, 1.0, 0.0)

    def beside_asymptotic(angle):
        """The parabola that touches the equator has tan α = 1/2 at this place."""
        alpha = atan2(1.0, 0.5) + angle
        return (0.5, -0.5), (sqrt(1.25) * cos(alpha), sqrt(1.25) * sin(alpha))

    return [
        bridge_row(Row, "gess1", GESS1, 2.0),
        bridge_row(Row, "h = 1e8", GESS1, 1e8, 0.5),
        bridge_row(Row, "f = f_max (1 − 1e-9)", GESS1, 0.3, 1.0 - 1e-9),
        bridge_row(Row, "moments 1e3, 1, 1e-3", heavy((1e3, 1.0, 1e-3), 1.0), 1.5),
        bridge_row(Row, "μ|r| = −1e-6", heavy((1.0, 0.625, 0.375), -1e-6), 1.5),
        bridge_row(Row, "a = 50", Bridge.of_suslov(HessBody(1.0, 50.0, -1.0)), 1.5),
        pendulum_row(Row, "h = −1 + 1e-4", 50.0, h=-1.0 + 1e-4),
        pendulum_row(Row, "h = 1, to the top", 20.0, h=1.0, because=SADDLE),
        pendulum_row(Row, "h = 1e4", 1.0, h=1e4),
        pendulum_row(Row, "t = 500", 500.0, h=0.3),
        pendulum_row(Row, "a = 1e-6", 30.0, (1.0, 1.0 + 1e-6, 1.0 + 2e-6)),
        pendulum_row(Row, "a = 9 (not a body)", 30.0, (1.0, 10.0, 1000.0)),
        arc_row(Row, "I11/I22 = 1e4", PlaneBody(1e2, 1e-2, 0.4, 0.7), (3.0, -0.02), (1.0, 0.5)),
        arc_row(Row, "b = 1e-10, from rest, T = 6e5", weak, (0.3, -0.2), (0.0, 0.0)),
        arc_row(Row, "|p| = 1e3", plane, (0.3, -0.2), (1e3, 10.0)),
        arc_row(Row, "1e-12 inside the edge", plane, (0.0, -sqrt(1.0 - 1e-11)), (1.0, 0.5)),
        arc_row(
            Row, "1e-6 from the asymptotic orbit", round_body, *beside_asymptotic(1e-6), floor=1e-9, because=SADDLE
        ),
        quartic_row(Row, "I11/I22 = 1e4", QuarticBody(1e2, 1e-2, 1.0, 0.8), (0.05, 3.0)),
        quartic_row(Row, "h = 1e6 |b3|", QuarticBody(2.0, 1.0, 1.0, 1e6), (sqrt(2e6), 0.0)),
        quartic_row(Row, "1e-9 above the bottom", QuarticBody(2.0, 1.0, 1.0, -1.0 + 1e-9), (1e-5, 0.0)),
    ]
