"""The numbers in the texts of the scenes, computed; see `support.numbers`."""

from functools import cache
from math import log

import numpy as np
from scipy.optimize import brentq

from hess_explorer.protocol import formulas
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework import periodic_search, trial
from hess_explorer.scenes.parts.sections import basins, density, section
from hess_explorer.views.plane import layered_section
from hess_mechanics import (
    LEVELS,
    ReturnMap,
    continued_orbit,
    ensemble,
    level,
    lyapunov_spectrum,
    period_doublings,
    periodic_orbit,
)
from hess_mechanics.dynamics import attraction, birkhoff, edge, megno, point_sets, regime, work_precision
from hess_mechanics.dynamics.birkhoff import rotation_number
from hess_mechanics.dynamics.return_map import section_crossings
from hess_mechanics.euler_poisson import andoyer, equations, rotation
from hess_mechanics.numerics import doubled_kernels
from hess_mechanics.suslov.additional_integral import _FORMULAS, MAX_K
from hess_mechanics.suslov.plane_potential import POTENTIALS
from hess_mechanics.suslov_hess.rotation_number import TURNS, plateaus
from support.deviations import deviations
from support.diagrams import settled
from support.lesson_on_doubling import FEIGENBAUM, cascade, cascade_of_the_ball
from support.lessons_on_tori import ends, on_the_wall, threshold
from support.lessons_on_tori import torus as torus_of
from support.mechanics import followed
from support.numbers import DIGITS, DOUBLED, of
from support.suslov import field, permanent_rotations
from support.view import example, values_of


def state(scene, name="", **changes):
    """Return the state of an example of a scene."""
    return scenes()[scene].of({**scenes()[scene].defaults(), **values_of(scenes()[scene], name), **changes})


def map_of(found):
    return ReturnMap(found.poincare, level("reference"))


# ---- ensembles of chaotic motions -----------------------------------------------------------------------------------


def starts_of(found, near):
    """Return states of 24 settled motions, all over the section of a state or next to its chosen one."""
    if near:
        places = [map_of(found).orbit(np.array(found.diagram.place) + 1e-6 * k, 1500)[-1] for k in range(24)]
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


def shared(_step):
    """Return how much of the attractor of "Touching" is shared with the repeller, and its points, twice."""
    found = state("orbit-diagram", "Touching")
    both = [settled(found.poincare, 64, 1500, 500, forward) for forward in (True, False)]
    parts = [point_sets.set_distance(found.poincare.turns, *pair).overlap for pair in zip(*both, strict=True)]
    points = len(example("orbit-diagram", "Touching", seen=("section",)).result.regime.sets[0])
    return (100.0 * np.array(parts), 5.0), points, points


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
    places = map_of(found).orbit(np.array(found.diagram.place), 4000)[1000:]
    values = np.abs(lyapunov_spectrum(found.body, found.poincare.state_at(*places[-1]), 8000.0).values)
    middle = periodic_orbit(map_of(found), tuple(birth_of_the_torus()[1].places[0]), 1).places[0]
    return I13, sum(values < 2e-3) - 2, (values[0], 2e-3), rotation_number(places, tuple(middle))[0]


def locked(I13):
    """Return the two folds of the orbit to which the torus is locked, their number, its period, and I13."""
    map_ = map_of(torus(I13))
    places = map_.orbit(np.array(torus(I13).diagram.place), 4000)[:-50:-1]
    period = 1 + int(np.argmax(np.abs(places[1:] - places[0]).max(axis=1) < 1e-6))
    orbit = periodic_orbit(map_, tuple(places[0]), period)
    assert orbit.kind == "stable focus"
    folds = [continued_orbit(map_, orbit, "I13", to).bifurcations[0] for to in (-0.2578, -0.2565)]
    return *(one.value for one in folds), sum(one.kind == "fold" for one in folds), period, I13


def is_left(I13):
    """Return whether motions come far away from the attractor of "A torus", as those of the example do not."""
    far = [
        np.abs(map_of(one).orbit(np.array(one.diagram.place), 3000)[:, 0] - 1.4).max()
        for one in (torus(I13), state("orbit-diagram", "A torus"))
    ]
    return far[0] > 3.0 and far[1] < 1.0


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
    rates = rest(step.at.values["h"])[2]
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


def come_near(distance):
    """Return whether motions of "A spiral" come nearer to the uniform rotation than this."""
    found = state("orbit-diagram", "A spiral")
    runs = ensemble(found.body, starts_of(found, True), np.linspace(0.0, 2000.0, 20_001), level("draft")).states
    return deviations(np.log(np.linalg.norm(runs - rest(found.h)[1], axis=2).min(axis=1)), log(distance)) < -5.0


def meander(_step):
    """Return the least rotation number beside the islands, how many there are, and their rotation number."""
    found = state("euler-poisson", "Meandering")
    section, middle = andoyer.AndoyerSection(found.body, found.h, found.f), (-1.85, 0.03)

    def turns(l):
        points = section_crossings(section, [section.state_at(l, middle[1])], 3000, level("standard")).states[0]
        return rotation_number(andoyer.coordinates(points), middle)[0]

    return min(map(turns, np.linspace(-1.6, -1.575, 6))), 1.0 / turns(-1.535), (turns(-1.535), 1e-6)


# ---- the rest -------------------------------------------------------------------------------------------------------


def frequencies(step, *tori):
    """Return for each (h, f) the number of frequencies of the body in space, of n3, φ and ψ, that are not 0."""
    # ψ' = f/(1 − n3²) has the sign of f.
    return [
        1 + (abs(torus_of({**step.at.values, "h": h, "f": f}).rotation_number) > 1e-9) + (f != 0.0) for h, f in tori
    ]


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


def slanting(_step):
    """Return a velocity on the line of equilibria of an example."""
    values = values_of(scenes()["free-suslov"], "Γ(t), I₁₃ ≠ 0")
    return values["w1"], -values["w1"] * values["I13"] / values["I23"]


def order(step):
    """Return the numbers of the body's axes, the moments of inertia in order."""
    return tuple(1.0 + np.argsort(of("I1", "I2", "I3")(step)))


CELLS = basins._PIXELS[0] >> basins._STAGES - 1
DIAGRAMS = {
    "chaotic where MEGNO exceeds 3 and": (megno.CHAOTIC,),
    "where 800 crossings": (regime._FEWEST,),
    "at least six of eight orbits": (regime._ENOUGH, regime._MEMBERS),
    "within which 95 %": (100.0 * point_sets._QUANTILE,),
    "beyond three standard errors": (birkhoff.ERRORS,),
    "Feigenbaum's $\\delta=4.6692$": (FEIGENBAUM,),
}
"""Rows of both orbit diagrams."""
SHARED = {
    "about a million crossings of 128 orbits": (density._ORBITS,),
    "negative by more than three times its error": (birkhoff.ERRORS,),
    "needs more than 2000 points": (periodic_search.MOST_POINTS,),
    "four levels": (len(LEVELS),),
}
"""Rows of passages that are in several scenes."""
ROWS = {
    "suslov-hess": {
        "**Three frequencies, or two**": lambda s: frequencies(s, (0.2, 0.5), (1.5, 0.6)),
        "the body in space has three": lambda s: frequencies(s, (0.2, 0.5)),
    },
    "free-suslov": {
        "For $k=1$ and $k=3$ it is": tuple(_FORMULAS),
        "every odd $k$ up to 15": (MAX_K,),
        "Here $k=1$, $k=3$, $k=1.5$ and": [
            one.values["k"] for one in scenes()["free-suslov"].presets if one.name.startswith("Γ(t), k")
        ],
        "so that $(3,-2)$ is on": slanting,
        "=(-0.49,0.26,0.88)$, as printed, has the length 1.04 and $\\Gamma=-0.531$. The first has "
        "$\\Gamma=-0.465$": as_printed,
        "With $-0.39$ instead of $-0.49$": misprint,
        "through 1 and 3 (": ends,
        "Type 1e-300 for": of("w2"),
        "and 750 for": of("span"),
    },
    "scattering": {
        # Of the start ω = (2, 1e-5) of figure 4.
        "δ is $5\\cdot10^{-6}$": (1e-5 / np.hypot(2.0, 1e-5),),
        "through 1, 2, 3 (": lambda s: tuple(np.arange(s.animation.start, s.animation.end + 1.0)),
    },
    "suslov": {
        "with 16 × 16 cells. It grows finer while you look: everywhere up to 128 × 128 cells, then only along the "
        "boundaries, up to 512 × 512. Parts of a basin thinner than 1/128 of": (
            *(CELLS, CELLS),
            *2 * (CELLS << basins._EVERYWHERE - 1,),
            *basins._PIXELS,
            1.0 / (CELLS << basins._EVERYWHERE - 1),
        ),
        "no attractor in 240 crossings": (attraction.CROSSINGS,),
        "256 orbits, spread over the section, are followed for 240 crossings, and some of them for 6000 more": (
            attraction._STARTS**2,
            attraction.CROSSINGS,
            attraction._TRANSIENT + attraction._LONG,
        ),
        "512 × 256 such cells. A set that fewer than two of these orbits approach is not seen, and only the twelve": (
            *attraction._CELLS,
            attraction._FEWEST,
            attraction._MOST,
        ),
        "when eight crossings": (attraction._ROW,),
        "halved 40 times": (edge._HALVINGS,),
        "They have rank 4": rank,
        "the other has period 7": other_period,
        "$-0.00046\\pm0.00003$ forward in time and $0.00045\\pm0.00003$": lambda s: divergences(
            "suslov", "A chaotic sea", 40_000.0
        ),
    },
    "kharlamova": {
        "chosen from three": (len(POTENTIALS),),
        "of rank 4": rank,
        "$(c_1,c_2)=(1,0.6)$": POTENTIALS["quadratic"][:2],
        "$c_1=c_2=\\lambda=1$, and *quartic*, $c_1=c_2=0.2$, $\\mu=6$": (
            POTENTIALS["Hénon–Heiles"][2],
            *POTENTIALS["quartic"][1::2],
        ),
    },
    "quartic": {"20 orbits": (section._ORBITS,)},
    "ball-section": {"20 orbits": (section._ORBITS,)},
    "rotation-number": {
        "where it exceeds 2.": threshold,
        "over 1500 returns": (TURNS,),
        "agree to $10^{-6}$": (
            lambda said: (
                plateaus(np.array([0.25, 0.25 + 0.9 * said]), np.ones(2, bool))
                and not plateaus(np.array([0.25, 0.25 + 1.1 * said]), np.ones(2, bool))
            ),
        ),
    },
    "chaplygin-ball": {"the values $m=10$,": of("D")},
    "euler-poisson": {
        "two or three $G": (andoyer.SHEETS - 1, andoyer.SHEETS),
        "Beyond 50 000 points": (layered_section._MANY,),
        "agree to 0.0001": (rotation.RESOLVED,),
        "falls to $0.1251$ and then turns. At the minimum there is no twist: $\\rho$ is the same, to first order, on "
        "neighbouring curves. There invariant curves meander. Beside them lies a chain of eight islands, all with "
        "$\\rho=1/8$": meander,
    },
    "hess-leak": {
        "the growth is 3.09107": lambda s: (on_the_wall(s).fixed_points[1].log_multiplier,),
    },
    "bridge": {
        "the body therefore has three frequencies: those of $n_3$, $\\varphi$ and $\\psi$. With cycles $\\varphi$ "
        "tends to a cycle, and two": lambda s: frequencies(s, (0.2, 0.5), (1.5, 0.6)),
        "computed in six variables": (len(equations.SYSTEM.variables),),
        "(about $10^{-16}$)": (10.0**-DIGITS / 2,),
    },
    "loxodrome": {"principal axes 1, 2, 3": order, "The middle axis 2": lambda s: order(s)[1:2]},
    "orbit-diagram": DIAGRAMS
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
        "about 7 % of its 1500 points with the repeller, as far as 1500": shared,
        "$I_{13}=-0.24899620$": lambda s: birth_of_the_torus()[:1],
        "At $-0.256$ two exponents are 0, besides those of the integrals, and the curve has the rotation number "
        "$0.1066355$": lambda s: on_the_torus(-0.256),
        "From $-0.2574134$ to $-0.2569055$, between two folds, it is locked: there is an orbit of period 10. At "
        "$-0.257$": lambda s: locked(-0.257),
        "At $-0.2605$ there is a strange attractor with $\\lambda=0.034\\pm0.003$ and the dimension "
        "$2.25\\pm0.02$": lambda s: (s.at.values["I13"], *chaos("orbit-diagram", "A torus", True)[::2]),
        "At $-0.2612$ motions": (is_left,),
        "the eigenvalues $0.282\\pm2.035i$ and $-0.723$": eigenvalues,
        "At $h=5.015931\\pm0.000001$": homoclinic,
        "within $0.1$": (come_near,),
        "$-0.0068\\pm0.0005$ forward and $0.0068\\pm0.0005$": lambda s: divergences(
            "orbit-diagram", "A chaotic sea", 20_000.0
        ),
        "dimension is about $2.94$, not 3.": dimension_of_the_sea,
    },
    "ball-diagram": DIAGRAMS
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
    "own-body": {"degree 6 at most": (formulas._DEGREE,), "with whole $n$ up to 6": (formulas._DEGREE,)},
    "suslov-hess-accuracy": {
        "once more with 31 digits": (DOUBLED,),
        "at three tolerances": (len(work_precision._TOLERANCES),),
        "order 36 in pairs": (doubled_kernels.ORDER,),
    },
    "rotation-number-accuracy": {"the four levels": (len(LEVELS),), "$1/256$ of all": (trial._COLOUR,)},
}
"""A phrase of a scene's text → the numbers in it, or a function that computes them from the step."""
