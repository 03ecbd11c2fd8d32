"""The numbers in the texts of the scenes, computed; see `support.numbers`."""

from functools import cache

import numpy as np
from scipy.optimize import brentq

from hess_explorer.scenes import scenes
from hess_mechanics import (
    ReturnMap,
    continued_orbit,
    level,
    lyapunov_spectrum,
    period_doublings,
    periodic_orbit,
)
from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.euler_poisson import andoyer
from support.deviations import deviations
from support.diagrams import settled
from support.lesson_on_doubling import FEIGENBAUM, cascade, cascade_of_the_ball
from support.lessons_on_tori import on_the_wall
from support.mechanics import followed
from support.suslov import field, permanent_rotations
from support.view import values_of


def state(scene, name="", **changes):
    """Return the state of an example of a scene."""
    return scenes()[scene].of({**scenes()[scene].defaults(), **values_of(scenes()[scene], name), **changes})


def map_of(found):
    return ReturnMap(found.poincare, level("reference"))


# ---- ensembles of chaotic motions -----------------------------------------------------------------------------------


def starts_of(found, near):
    """Return states of 24 settled motions, all over the section of a state or next to its chosen one."""
    if near:
        places = [map_of(found).orbit(np.array(found.diagram.point) + 1e-6 * k, 1500)[-1] for k in range(24)]
    else:
        places = settled(found.poincare, 24, 1, 500)[:, 0]
    return found.poincare.states_at(*np.transpose(places))[0]


@cache
def spectra(scene, name, time, near=False):
    found = state(scene, name)
    return [lyapunov_spectrum(found.body, tuple(start), time) for start in starts_of(found, near)]


def chaos(scene, name, near=False):
    """Return the largest exponents, the mean divergences and the dimensions of the motions of an example."""
    found = spectra(scene, name, 8000.0, near)
    return tuple(map(np.array, zip(*((one.values[0], one.divergence, one.dimension[0]) for one in found), strict=True)))


def divergences(scene, name, time):
    """Return mean divergences of motions that run forward, and of motions that run backward."""
    return tuple(np.array([sign * one.divergence for one in spectra(scene, name, sign * time)]) for sign in (1, -1))


def dimension_of_the_sea(_step):
    """Return the Kaplan–Yorke dimension 3 + div/|λ3| of motions, and whether it is less than a number."""
    first, divergence, _ = chaos("orbit-diagram", "A chaotic sea")
    found = 3.0 + divergence / (first - divergence)
    # Means of 24 motions lie between 2.939 and 2.946, with errors of 0.003, of which there are five on each side.
    return (found, 0.03), lambda whole: deviations(found, whole) < -5.0


# ---- periodic orbits ------------------------------------------------------------------------------------------------


def torus(I13):
    return state("orbit-diagram", "A torus", I13=I13)


@cache
def birth_of_the_torus():
    """Return the value of I13 at which the multipliers lie on the unit circle, and the orbit there."""

    def orbit(I13):
        return periodic_orbit(map_of(torus(I13)), (1.15, 1.40), 1)

    value = brentq(lambda I13: abs(orbit(I13).multipliers[0]) - 1.0, -0.2495, -0.2485, xtol=1e-11)
    return value, orbit(value)


def on_the_torus(I13):
    """Return I13, how many exponents are 0 besides those of the integrals, the largest, and the rotation number."""
    found = torus(I13)
    places = map_of(found).orbit(np.array(found.diagram.point), 4000)[1000:]
    values = np.abs(lyapunov_spectrum(found.body, found.poincare.state_at(*places[-1]), 8000.0).values)
    middle = periodic_orbit(map_of(found), tuple(birth_of_the_torus()[1].points[0]), 1).points[0]
    return I13, sum(values < 2e-3) - 2, (values[0], 2e-3), rotation_number(places, tuple(middle))[0]


def locked(I13):
    """Return the two folds of the orbit to which the torus is locked, their number, its period, and I13."""
    map_ = map_of(torus(I13))
    places = map_.orbit(np.array(torus(I13).diagram.point), 4000)[:-50:-1]
    period = 1 + int(np.argmax(np.abs(places[1:] - places[0]).max(axis=1) < 1e-6))
    orbit = periodic_orbit(map_, tuple(places[0]), period)
    assert orbit.kind == "stable focus"
    folds = [continued_orbit(map_, orbit, "I13", to).bifurcations[0] for to in (-0.2578, -0.2565)]
    return *(one.value for one in folds), sum(one.kind == "fold" for one in folds), period, I13


def other_period(_step):
    """Return the periods of the attractors of an example, but for the fixed point."""
    ends = settled(state("suslov", "Two attractors").poincare, 24, 30, 2000)[:, ::-1]
    periods = {1 + int(np.argmax(np.abs(end[1:] - end[0]).max(axis=1) < 1e-6)) for end in ends}
    return tuple(periods - {1})


def flip_of_the_ball(_step):
    """Return the period of the orbit, and 𝒟 where it doubles."""
    map_ = map_of(state("ball-diagram", D=3.0))
    found = period_doublings(map_, periodic_orbit(map_, (-2.75, 1.006), 1), "D", 2.5, 1)
    return *found.periods, *found.values


def rest(h):
    """Return body, state, and rates and vectors of the linear motion of the uniform rotation of "A spiral"."""
    found = state("orbit-diagram", "A spiral", h=h)
    rotations = permanent_rotations(found.body, found.poincare.E)
    y = next(one for one in rotations if abs(np.hypot(*one[:2]) - 2.1) < 0.01 and one[0] > 0.0)
    # The field is quadratic: central differences are exact.
    columns = [(field(found.body, y + e) - field(found.body, y - e)) / 2.0 for e in np.eye(5)]
    return found.body, y, *np.linalg.eig(np.column_stack(columns))


def eigenvalues(step):
    """Return the real and the imaginary part of the eigenvalue of the spiral, and the last eigenvalue."""
    rates = rest(step.state.values["h"])[2]
    spiral, last = rates[np.argmax(rates.imag)], min(rates.real)
    return spiral.real, spiral.imag, last


def homoclinic(_step):
    """Return the energy at which the motion that tends to the saddle-focus also comes from it, by SciPy.

    Backward in time along the line on which motions come, this one comes back nearly, and passes on one side.
    """

    def side(h):
        body, y, rates, vectors = rest(h)
        last = np.argmin(rates.real)
        line, across = vectors[:, last].real, np.linalg.inv(vectors)[last].real
        start = y + 1e-6 * line / line[4]
        back = followed(lambda _, x: -field(body, x), start, np.linspace(0.0, 36.0, 361))[300:] - y
        assert np.linalg.norm(back, axis=1).min() < 0.1
        return float(back[-1] @ across * line[4])

    return (brentq(side, 5.015925, 5.015935, xtol=1e-8),)


def meander(_step):
    """Return the least rotation number beside the islands, how many there are, and their rotation number."""
    found = state("euler-poisson", "Meandering")
    section, middle = andoyer.AndoyerSection(found.body, found.h, found.f), (-1.85, 0.03)

    def turns(l):
        points = section_crossings(section, [section.state_at(l, middle[1])], 3000, level("standard")).states[0]
        return rotation_number(andoyer.coordinates(points), middle)[0]

    return min(map(turns, np.linspace(-1.6, -1.575, 6))), 1.0 / turns(-1.535), (turns(-1.535), 1e-6)


# ---- the rest -------------------------------------------------------------------------------------------------------


def rank(_step):
    """Return the rank of the brackets of ω1, ω2, γ1, γ2, γ3, of which four are not 0."""
    upper = np.zeros((5, 5))
    upper[[0, 1, 0, 1], [3, 2, 4, 4]] = -0.7, 1.0, 0.4, -0.3
    return (np.linalg.matrix_rank(upper - upper.T),)


PRINTED = (-0.88, -0.48, 0.0), (-0.49, 0.26, 0.88)
"""The two γ(0) of figure 3 d, as the paper prints them."""


def Gamma(gamma):
    values = values_of(scenes()["free-suslov"], "Γ(t), I₁₃ ≠ 0")
    xi = values["I23"], -values["I13"], 0.0
    return np.dot(xi, gamma) / (np.linalg.norm(xi) * np.linalg.norm(gamma))


def as_printed(_step):
    """Return the second γ(0), its length, and Γ of both."""
    return *PRINTED[1], np.linalg.norm(PRINTED[1]), *map(Gamma, PRINTED[::-1])


def misprint(_step):
    """Return the γ1 with which both have one Γ, which one digit in print can only come near to, and the printed one."""
    _, second = PRINTED
    return (brentq(lambda g1: Gamma((g1, *second[1:])) - Gamma(PRINTED[0]), second[0], -0.3), 0.01), second[0]


DELTA = {"Feigenbaum's $\\delta=4.6692$": lambda s: (FEIGENBAUM,)}
ROWS = {
    "free-suslov": {
        "=(-0.49,0.26,0.88)$, as printed, has the length 1.04 and $\\Gamma=-0.531$. The first has "
        "$\\Gamma=-0.465$": as_printed,
        "With $-0.39$ instead of $-0.49$": misprint,
    },
    # Of the start ω = (2, 1e-5) of figure 4.
    "scattering": {"δ is $5\\cdot10^{-6}$": lambda s: (1e-5 / np.hypot(2.0, 1e-5),)},
    "suslov": {
        "of rank 4": rank,
        "the other has period 7": other_period,
        "$-0.00046\\pm0.00003$ forward in time and $0.00045\\pm0.00003$": lambda s: divergences(
            "suslov", "A chaotic sea", 40_000.0
        ),
    },
    "kharlamova": {"of rank 4": rank},
    "euler-poisson": {
        "falls to $0.1251$ and then turns. At the minimum there is no twist: $\\rho$ is the same, to first order, on "
        "neighbouring curves. There invariant curves meander. Beside them lies a chain of eight islands, all with "
        "$\\rho=1/8$": meander,
    },
    "hess-leak": {
        "the growth is 3.09107": lambda s: (on_the_wall(s).fixed_points[1].log_multiplier,),
    },
    "orbit-diagram": DELTA
    | {
        "Six were located in all. Orbits of period 1, 2, 4, … double at $I_{23}=-0.0498281$, $0.0873376$, $0.1281912$, "
        "$0.1376316$, $0.1396679$, $0.1401049$": lambda s: (
            len(cascade().values),
            *cascade().periods[:3],
            *cascade().values,
        ),
        "distances, 3.357, 4.328, 4.636, 4.659": lambda s: cascade().ratios,
        "$\\lambda=0.039\\pm0.001$. The Kaplan–Yorke dimension of the attractor is $2.174\\pm0.003$": lambda s: chaos(
            "orbit-diagram", "Apart: a strange"
        )[::2],
        "$\\lambda=0.146\\pm0.004$, and the dimension is $2.252\\pm0.007$": lambda s: chaos(
            "orbit-diagram", "Touching"
        )[::2],
        "$I_{13}=-0.24899620$": lambda s: birth_of_the_torus()[:1],
        "At $-0.256$ two exponents are 0, besides those of the integrals, and the curve has the rotation number "
        "$0.1066355$": lambda s: on_the_torus(-0.256),
        "From $-0.2574134$ to $-0.2569055$, between two folds, it is locked: there is an orbit of period 10. At "
        "$-0.257$": lambda s: locked(-0.257),
        "At $I_{13}=-0.2605$ there is a strange attractor with $\\lambda=0.034\\pm0.003$ and the dimension "
        "$2.25\\pm0.02$": lambda s: (s.state.values["I13"], *chaos("orbit-diagram", "A torus", True)[::2]),
        "the eigenvalues $0.282\\pm2.035i$ and $-0.723$": eigenvalues,
        "At $h=5.015931\\pm0.000001$": homoclinic,
        "$-0.0068\\pm0.0005$ forward and $0.0068\\pm0.0005$": lambda s: divergences(
            "orbit-diagram", "A chaotic sea", 20_000.0
        ),
        "dimension is about $2.94$, not 3.": dimension_of_the_sea,
    },
    "ball-diagram": DELTA
    | {
        "period 2, 4, 8, 16 double at $\\mathcal{D}=1.5872085$, $1.4256035$, $1.3934895$, $1.3866210$": lambda s: (
            *cascade_of_the_ball().periods,
            *cascade_of_the_ball().values,
        ),
        "distances, 5.032, 4.676": lambda s: cascade_of_the_ball().ratios,
        "The orbit of period 1 doubles at $\\mathcal{D}=2.7347985$": flip_of_the_ball,
        "$\\lambda=0.038\\pm0.003$, and volume shrinks at the mean rate $-0.0922\\pm0.0003$. The Kaplan–Yorke "
        "dimension of the attractor is $2.29\\pm0.02$": lambda s: chaos("ball-diagram", "Apart: a strange"),
    },
}
"""A phrase of a scene's text → the function that computes the numbers in it from the step."""
