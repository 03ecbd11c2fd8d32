"""The Hénon–Heiles system: a system of one's own, with a section."""

from hess_mechanics import System

SYSTEM = System(
    "henon-heiles",
    lambda y, p: (y[2], y[3], -y[0] - 2 * p[0] * y[0] * y[1], -y[1] - p[0] * (y[0] ** 2 - y[1] ** 2)),
    "x y px py",
    {"lam": 1.0},
    example=(0.0, 0.1, 0.35, 0.2),
    integrals=lambda y, p: {
        "E": (y[0] ** 2 + y[1] ** 2 + y[2] ** 2 + y[3] ** 2) / 2 + p[0] * (y[0] ** 2 * y[1] - y[1] ** 3 / 3)
    },
)
