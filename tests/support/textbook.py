"""Thirty systems of textbooks, each with a time span over which errors stay small."""

import numpy as np

from hess_mechanics import System
from hess_mechanics.numerics.functions import cos, exp, log, sin, sqrt


def double_pendulum(y, p):
    a, b, u, v = y
    s, c = sin(a - b), cos(a - b)
    rest = 2 + 2 * s**2
    return (
        u,
        v,
        -(3 * p[0] * sin(a) + p[0] * sin(a - 2 * b) + 2 * s * (v**2 + u**2 * c)) / rest,
        2 * s * (2 * u**2 + 2 * p[0] * cos(a) + v**2 * c) / rest,
    )


def spherical_pendulum(y, p):
    theta, _, v = y
    g, L = p
    s, c = sin(theta), cos(theta)
    return v, L / s**2, L**2 * c / s**3 - g * s


def kepler(y, p):
    x, y_, u, v = y
    cube = (x**2 + y_**2) ** 1.5
    return u, v, -p[0] * x / cube, -p[0] * y_ / cube


def restricted(y, p):
    x, y_, u, v = y
    mu = p[0]
    one, two = ((x + mu) ** 2 + y_**2) ** 1.5, ((x - 1 + mu) ** 2 + y_**2) ** 1.5
    return (
        u,
        v,
        2 * v + x - (1 - mu) * (x + mu) / one - mu * (x - 1 + mu) / two,
        -2 * u + y_ - (1 - mu) * y_ / one - mu * y_ / two,
    )


def jacobi(y, p):
    x, y_, u, v = y
    one, two = sqrt((x + p[0]) ** 2 + y_**2), sqrt((x - 1 + p[0]) ** 2 + y_**2)
    return {"C": (u**2 + v**2) / 2 - (x**2 + y_**2) / 2 - (1 - p[0]) / one - p[0] / two}


def sleigh(y, p):
    v, w, theta, _, _ = y
    m, I, a = p
    return a * w**2, -m * a * v * w / (I + m * a**2), w, v * cos(theta), v * sin(theta)


A, C = 0.25, 0.5


def rolling_disk(y, p):
    """A disk of mass and radius 1: its inclination, two angles, their rates, the spin, and the point of contact."""
    theta, psi, _, u, v, w, _, _ = y
    s, c = sin(theta), cos(theta)
    turn = w - v * c
    return (
        u,
        v,
        turn,
        (A * v**2 * s * c - (C + 1) * w * v * s - p[0] * c) / (A + 1),
        (C * w * u - 2 * A * u * v * c) / (A * s),
        u * v * s / (C + 1),
        turn * cos(psi),
        turn * sin(psi),
    )


def disk_energy(y, p):
    s = sin(y[0])
    return {"E": ((A + 1) * y[3] ** 2 + A * (y[4] * s) ** 2 + (C + 1) * y[5] ** 2) / 2 + p[0] * s}


def suslov(w1, w2, g1, g2, g3, third, p):
    momentum = p[2] * w1 + p[3] * w2 + third
    return -w2 * momentum / p[0], w1 * momentum / p[1], -g3 * w2, g3 * w1, g1 * w2 - g2 * w1


def suslov_integrals(y, p):
    return {"E": (p[0] * y[0] ** 2 + p[1] * y[1] ** 2) / 2, "γ²": y[2] ** 2 + y[3] ** 2 + y[4] ** 2}


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def contact(g, p):
    """The point of contact of a paraboloid with radii a, b and height h, and its two slopes x/a, y/b."""
    a, b, h = p[4:]
    x, y = -g[0] / g[2], -g[1] / g[2]
    return (a * x, b * y, -h + (a * x**2 + b * y**2) / 2), x, y


def turning(M, r, p):
    """The angular velocity ω with M = I ω + r × (ω × r), by Cramer's rule."""
    I11, I22, I33, I12 = p[:4]
    rows = (
        (I11 + r[1] ** 2 + r[2] ** 2, I12 - r[0] * r[1], -r[0] * r[2]),
        (I12 - r[0] * r[1], I22 + r[0] ** 2 + r[2] ** 2, -r[1] * r[2]),
        (-r[0] * r[2], -r[1] * r[2], I33 + r[0] ** 2 + r[1] ** 2),
    )
    normals = cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])
    inverse = 1 / dot(rows[0], normals[0])
    return tuple(inverse * sum(M[i] * normals[i][j] for i in range(3)) for j in range(3))


def rattleback(y, p):
    """M' = M × ω + ρ' × (ω × ρ) + ρ × γ, γ' = γ × ω for the mass 1 and g = 1."""
    M, g = y[:3], y[3:]
    r, x, z = contact(g, p)
    w = turning(M, r, p)
    turn = cross(g, w)
    a, b, _ = p[4:]
    dx, dz = -(turn[0] + x * turn[2]) / g[2], -(turn[1] + z * turn[2]) / g[2]
    dr = (a * dx, b * dz, a * x * dx + b * z * dz)
    parts = cross(M, w), cross(dr, cross(w, r)), cross(r, g)
    return *(sum(part[i] for part in parts) for i in range(3)), *turn


def rattleback_integrals(y, p):
    r, _, _ = contact(y[3:], p)
    return {"E": dot(y[:3], turning(y[:3], r, p)) / 2 - dot(r, y[3:]), "γ²": dot(y[3:], y[3:])}


def lagrange_top(y, p):
    theta, _, _, v = y
    a, b, third, g = p
    s, c = sin(theta), cos(theta)
    turn = (a - b * c) / s**2
    return v, turn, b / third - c * turn, g * s - turn * (b - a * c) / s


def stoermer(y, p):
    x, z, u, v = y
    square = x**2 + z**2
    third, fifth = square**-1.5, square**-2.5
    q = p[0] / x - x * third
    return u, v, q * (p[0] / x**2 + third - 3 * x**2 * fifth), -3 * q * x * z * fifth


def toda(y, p):
    q1, q2, q3 = y[:3]
    a, b, c = exp(q1 - q2), exp(q2 - q3), exp(q3 - q1)
    return *y[3:], c - a, a - b, b - c


def fpu(y, p):
    q = (0, *y[:5], 0)
    d = [q[i + 1] - q[i] for i in range(6)]
    force = [x + p[0] * x**3 for x in d]
    return *y[5:], *(force[i + 1] - force[i] for i in range(5))


def fpu_energy(y, p):
    q = (0, *y[:5], 0)
    d = [q[i + 1] - q[i] for i in range(6)]
    return {"E": sum(x**2 / 2 + p[0] * x**4 / 4 for x in d) + sum(v**2 for v in y[5:]) / 2}


def swinging(y, p):
    r, theta, u, w = y
    mu = p[0]
    return u, w, (r * w**2 + cos(theta) - mu) / (1 + mu), -(2 * u * w + sin(theta)) / r


def elastic(y, p):
    r, theta, u, w = y
    return u, w, r * w**2 + cos(theta) - p[0] * (r - 1), -(2 * u * w + sin(theta)) / r


def energy(potential, d):
    """A sum of squares of the last d variables over 2, and a potential."""
    return lambda y, p: {"E": sum(v**2 for v in y[-d:]) / 2 + potential(y, p)}


SYSTEMS = [
    (
        System(
            "pendulum",
            lambda y, p: (y[1], -p[0] * sin(y[0])),
            "θ w",
            {"g": 1.0},
            (2.5, 0.1),
            integrals=energy(lambda y, p: -p[0] * cos(y[0]), 1),
        ),
        40.0,
    ),
    (
        System(
            "double pendulum",
            double_pendulum,
            "a b u v",
            {"g": 1.0},
            (1.5, 0.5, 0.0, 0.3),
            integrals=lambda y, p: {
                "E": y[2] ** 2 + y[3] ** 2 / 2 + y[2] * y[3] * cos(y[0] - y[1]) - p[0] * (2 * cos(y[0]) + cos(y[1]))
            },
        ),
        15.0,
    ),
    (
        System(
            "spherical pendulum",
            spherical_pendulum,
            "θ φ v",
            {"g": 1.0, "L": 0.3},
            (1.2, 0.0, 0.4),
            integrals=lambda y, p: {"E": y[2] ** 2 / 2 + p[1] ** 2 / (2 * sin(y[0]) ** 2) - p[0] * cos(y[0])},
        ),
        30.0,
    ),
    (
        System(
            "Kepler, Cartesian",
            kepler,
            "x y u v",
            {"k": 1.0},
            (0.5, 0.0, 0.0, 1.7),
            integrals=lambda y, p: {
                "E": (y[2] ** 2 + y[3] ** 2) / 2 - p[0] / sqrt(y[0] ** 2 + y[1] ** 2),
                "L": y[0] * y[3] - y[1] * y[2],
            },
        ),
        30.0,
    ),
    (
        System(
            "Kepler, polar",
            lambda y, p: (y[2], p[1] / y[0] ** 2, p[1] ** 2 / y[0] ** 3 - p[0] / y[0] ** 2),
            "r φ u",
            {"k": 1.0, "L": 0.85},
            (0.5, 0.0, 0.0),
            integrals=lambda y, p: {"E": y[2] ** 2 / 2 + p[1] ** 2 / (2 * y[0] ** 2) - p[0] / y[0]},
        ),
        30.0,
    ),
    (
        System(
            "Lorenz",
            lambda y, p: (p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - y[1], y[0] * y[1] - p[2] * y[2]),
            "x y z",
            {"σ": 10.0, "ρ": 28.0, "β": 8 / 3},
            (1.0, 2.0, 20.0),
        ),
        6.0,
    ),
    (
        System(
            "Rössler",
            lambda y, p: (-y[1] - y[2], y[0] + p[0] * y[1], p[1] + y[2] * (y[0] - p[2])),
            "x y z",
            {"a": 0.2, "b": 0.2, "c": 5.7},
            (1.0, 2.0, 0.5),
        ),
        30.0,
    ),
    (
        System(
            "Duffing, driven",
            lambda y, p: (y[1], -p[0] * y[1] + y[0] - y[0] ** 3 + p[1] * cos(y[2]), p[2]),
            "x v τ",
            {"δ": 0.3, "γ": 0.5, "ω": 1.2},
            (0.5, 0.1, 0.0),
        ),
        30.0,
    ),
    (
        System("Van der Pol", lambda y, p: (y[1], p[0] * (1 - y[0] ** 2) * y[1] - y[0]), "x v", {"μ": 2.0}, (0.5, 0.1)),
        20.0,
    ),
    (
        System(
            "Hénon–Heiles",
            lambda y, p: (y[2], y[3], -y[0] - 2 * y[0] * y[1], -y[1] - y[0] ** 2 + y[1] ** 2),
            "x y px py",
            example=(0.1, 0.2, 0.3, 0.4),
            integrals=energy(lambda y, p: (y[0] ** 2 + y[1] ** 2) / 2 + y[0] ** 2 * y[1] - y[1] ** 3 / 3, 2),
        ),
        40.0,
    ),
    (
        System("restricted three bodies", restricted, "x y u v", {"μ": 0.0121}, (0.5, 0.1, 0.2, 0.8), integrals=jacobi),
        10.0,
    ),
    (
        System(
            "Chaplygin sleigh",
            sleigh,
            "v w θ x y",
            {"m": 1.0, "I": 0.5, "a": 0.7},
            (-0.5, 1.0, 0.0, 0.0, 0.0),
            integrals=lambda y, p: {"E": (p[0] * y[0] ** 2 + (p[1] + p[0] * p[2] ** 2) * y[1] ** 2) / 2},
        ),
        20.0,
    ),
    (
        System(
            "rolling disk",
            rolling_disk,
            "θ ψ φ u v w x y",
            {"g": 1.0},
            (1.2, 0.0, 0.0, 0.1, 0.3, 1.5, 0.0, 0.0),
            integrals=disk_energy,
        ),
        20.0,
    ),
    (
        System(
            "Suslov gyrostat",
            lambda y, p: suslov(*y, p[4], p),
            "w1 w2 γ1 γ2 γ3",
            {"I11": 2.0, "I22": 1.0, "I13": 0.3, "I23": 0.5, "k": 0.7},
            (0.8, -0.4, 0.6, 0.0, 0.8),
            integrals=suslov_integrals,
        ),
        30.0,
    ),
    (
        System(
            "Suslov body, driven",
            lambda y, p: (*suslov(*y[:5], p[4] * sin(y[5]), p), p[5]),
            "w1 w2 γ1 γ2 γ3 τ",
            {"I11": 2.0, "I22": 1.0, "I13": 0.3, "I23": 0.5, "k": 0.7, "ω": 1.3},
            (0.8, -0.4, 0.6, 0.0, 0.8, 0.0),
            integrals=suslov_integrals,
        ),
        30.0,
    ),
    (
        System(
            "Euler top",
            lambda y, p: ((p[2] - p[1]) * y[1] * y[2], (p[0] - p[2]) * y[2] * y[0], (p[1] - p[0]) * y[0] * y[1]),
            "M1 M2 M3",
            {"a1": 1.0, "a2": 0.6, "a3": 0.3},
            (0.1, 1.0, 0.2),
            integrals=lambda y, p: {"M²": dot(y, y), "E": (p[0] * y[0] ** 2 + p[1] * y[1] ** 2 + p[2] * y[2] ** 2) / 2},
        ),
        50.0,
    ),
    (
        System(
            "rattleback",
            rattleback,
            "M1 M2 M3 γ1 γ2 γ3",
            {"I11": 0.2, "I22": 1.5, "I33": 1.6, "I12": 0.1, "a": 0.8, "b": 6.0, "h": 0.5},
            (0.05, 0.02, 0.9, 0.02, 0.01, 0.99975),
            integrals=rattleback_integrals,
        ),
        10.0,
    ),
    (
        System(
            "Lagrange top",
            lagrange_top,
            "θ φ ψ v",
            {"a": 1.2, "b": 1.5, "C": 0.5, "g": 1.0},
            (0.9, 0.0, 0.0, 0.2),
            integrals=lambda y, p: {
                "E": y[3] ** 2 / 2 + (p[0] - p[1] * cos(y[0])) ** 2 / (2 * sin(y[0]) ** 2) + p[3] * cos(y[0])
            },
        ),
        30.0,
    ),
    (
        System(
            "Lotka–Volterra",
            lambda y, p: (y[0] * (p[0] - p[1] * y[1]), y[1] * (p[3] * y[0] - p[2])),
            "x y",
            {"a": 1.0, "b": 0.5, "c": 1.2, "d": 0.4},
            (1.0, 2.0),
            integrals=lambda y, p: {"V": p[3] * y[0] - p[2] * log(y[0]) + p[1] * y[1] - p[0] * log(y[1])},
        ),
        30.0,
    ),
    (
        System(
            "Brusselator",
            lambda y, p: (p[0] + y[0] ** 2 * y[1] - (p[1] + 1) * y[0], p[1] * y[0] - y[0] ** 2 * y[1]),
            "x y",
            {"A": 1.0, "B": 3.0},
            (1.0, 1.5),
        ),
        20.0,
    ),
    (
        System(
            "Chua, cubic",
            lambda y, p: (p[0] * (y[1] - y[0] ** 3 - p[2] * y[0]), y[0] - y[1] + y[2], -p[1] * y[1]),
            "x y z",
            {"α": 10.0, "β": 16.0, "c": -0.143},
            (0.3, 0.1, -0.2),
        ),
        10.0,
    ),
    (
        System(
            "Arnold–Beltrami–Childress",
            lambda y, p: (
                p[0] * sin(y[2]) + p[2] * cos(y[1]),
                p[1] * sin(y[0]) + p[0] * cos(y[2]),
                p[2] * sin(y[1]) + p[1] * cos(y[0]),
            ),
            "x y z",
            {"A": 1.0, "B": 0.8165, "C": 0.5774},
            (0.1, 0.2, 0.3),
        ),
        30.0,
    ),
    (
        System(
            "Störmer",
            stoermer,
            "ρ z u v",
            {"L": 1.0},
            (0.9, 0.1, 0.05, 0.1),
            integrals=energy(lambda y, p: (p[0] / y[0] - y[0] / sqrt(y[0] ** 2 + y[1] ** 2) ** 3) ** 2 / 2, 2),
        ),
        20.0,
    ),
    (
        System(
            "Toda",
            toda,
            "q1 q2 q3 p1 p2 p3",
            example=(0.5, 0.0, -0.3, 0.4, -0.5, 0.1),
            integrals=energy(lambda y, p: exp(y[0] - y[1]) + exp(y[1] - y[2]) + exp(y[2] - y[0]), 3),
        ),
        30.0,
    ),
    (
        System(
            "Fermi–Pasta–Ulam",
            fpu,
            " ".join([f"q{i}" for i in range(1, 6)] + [f"p{i}" for i in range(1, 6)]),
            {"β": 0.8},
            (0.5, 0.9, 1.0, 0.7, 0.4, 0.0, 0.1, 0.0, -0.1, 0.0),
            integrals=fpu_energy,
        ),
        20.0,
    ),
    (
        System(
            "swinging Atwood machine",
            swinging,
            "r θ u w",
            {"μ": 3.0},
            (1.0, 1.5, 0.0, 0.0),
            integrals=lambda y, p: {"E": ((1 + p[0]) * y[2] ** 2 + (y[0] * y[3]) ** 2) / 2 + y[0] * (p[0] - cos(y[1]))},
        ),
        10.0,
    ),
    (
        System(
            "elastic pendulum",
            elastic,
            "r θ u w",
            {"k": 5.0},
            (1.2, 1.0, 0.0, 0.2),
            integrals=lambda y, p: {
                "E": (y[2] ** 2 + (y[0] * y[3]) ** 2 + p[0] * (y[0] - 1) ** 2) / 2 - y[0] * cos(y[1])
            },
        ),
        20.0,
    ),
    (
        System(
            "Nosé–Hoover",
            lambda y, p: (y[1], -y[0] - y[2] * y[1], (y[1] ** 2 - p[0]) / p[1], y[2]),
            "q p ζ η",
            {"T": 1.0, "Q": 1.0},
            (0.0, 1.5, 0.2, 0.0),
            integrals=lambda y, p: {"H": (y[0] ** 2 + y[1] ** 2 + p[1] * y[2] ** 2) / 2 + p[0] * y[3]},
        ),
        20.0,
    ),
    (
        System(
            "Thomas",
            lambda y, p: (sin(y[1]) - p[0] * y[0], sin(y[2]) - p[0] * y[1], sin(y[0]) - p[0] * y[2]),
            "x y z",
            {"b": 0.19},
            (1.0, 0.2, -0.5),
        ),
        30.0,
    ),
    (
        System("Sprott B", lambda y, p: (y[1] * y[2], y[0] - y[1], 1 - y[0] * y[1]), "x y z", example=(0.5, 0.2, 0.1)),
        20.0,
    ),
]
"""Each system with a time span."""

TEXTBOOK = {system.name: (system, span) for system, span in SYSTEMS}


def states_of(system, span, samples=9):
    """Times, and states from SciPy's DOP853."""
    from scipy.integrate import solve_ivp

    state, p = system.example
    times = np.linspace(0.0, span, samples)
    found = solve_ivp(lambda _, y: system.field(y, p), (0.0, span), state, "DOP853", times, rtol=1e-13, atol=1e-13)
    return times, found.y.T
