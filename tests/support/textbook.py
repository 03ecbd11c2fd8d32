"""Twelve systems of textbooks, each with a time span over which errors stay small."""

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


def sleigh(y, p):
    v, w, theta, _, _ = y
    m, I, a = p
    return a * w**2, -m * a * v * w / (I + m * a**2), w, v * cos(theta), v * sin(theta)


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


def energy(potential, d):
    """A sum of squares of the last d variables over 2, and a potential."""
    return lambda y, p: {"E": sum(v**2 for v in y[-d:]) / 2 + potential(y, p)}


SYSTEMS = [
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
            "Duffing, driven",
            lambda y, p: (y[1], -p[0] * y[1] + y[0] - y[0] ** 3 + p[1] * cos(y[2]), p[2]),
            "x v τ",
            {"δ": 0.3, "γ": 0.5, "ω": 1.2},
            (0.5, 0.1, 0.0),
        ),
        30.0,
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
            "Nosé–Hoover",
            lambda y, p: (y[1], -y[0] - y[2] * y[1], (y[1] ** 2 - p[0]) / p[1], y[2]),
            "q p ζ η",
            {"T": 1.0, "Q": 1.0},
            (0.0, 1.5, 0.2, 0.0),
            integrals=lambda y, p: {"H": (y[0] ** 2 + y[1] ** 2 + p[1] * y[2] ** 2) / 2 + p[0] * y[3]},
        ),
        20.0,
    ),
]
"""Each system with a time span."""

TEXTBOOK = {system.name: (system, span) for system, span in SYSTEMS}
