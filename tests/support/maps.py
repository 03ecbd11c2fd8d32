"""Maps with known periodic orbits, bifurcations and manifolds: `Formula` makes a map from formulas."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hess_mechanics.errors import NoReturn


@dataclass(frozen=True)
class Formula:
    """A map by its formula, its derivative and its inverse; exact but for round-off."""

    of: Callable
    derivative: Callable
    back: Callable = None
    back_derivative: Callable = None
    turns: tuple[float, ...] = (math.inf, math.inf)
    names: tuple[str, ...] = ("x", "y")
    promise: float = 1e-12
    level: str = "reference"
    is_floor: bool = True
    preserves_volume: bool = False
    symmetries_of: Callable = lambda places, near: ()

    def image(self, place):
        places = np.asarray(place, float)
        return np.array([self.of(*one) for one in np.atleast_2d(places)], float).reshape(places.shape)

    def iterate(self, place, count):
        for _ in range(count):
            place = self.image(place)
        return place

    def orbit(self, place, count):
        found = []
        for _ in range(count):
            place = self.image(place)
            if not np.abs(place).max() < 1e6:
                break
            found.append(place)
        return np.array(found).reshape(-1, len(self.turns))

    def with_derivative(self, place):
        places = np.asarray(place, float)
        derivatives = np.array([self.derivative(*one) for one in np.atleast_2d(places)], float)
        return self.image(places), derivatives.reshape(*places.shape, places.shape[-1])

    def inverse(self):
        if self.back is None:
            raise NoReturn("This map has no inverse: follow it forwards.")
        return Formula(self.back, self.back_derivative, self.of, self.derivative, self.turns, self.names)

    def tighter(self):
        return self


def henon(a, b=0.3):
    """x′ = 1 − a x² + y, y′ = b x."""
    return Formula(
        lambda x, y: (1.0 - a * x * x + y, b * x),
        lambda x, y: [[-2.0 * a * x, 1.0], [b, 0.0]],
        lambda x, y: (y / b, x - 1.0 + a * (y / b) ** 2),
        lambda x, y: [[0.0, 1.0 / b], [1.0, 2.0 * a * y / b**2]],
    )


def delayed_logistic(a):
    """x′ = y, y′ = a y (1 − x): a Neimark–Sacker bifurcation of x = y = 1 − 1/a at a = 2, multipliers e^{±iπ/3}."""
    return Formula(lambda x, y: (y, a * y * (1.0 - x)), lambda x, y: [[0.0, 1.0], [-a * y, a * (1.0 - x)]])


def pitchfork(r):
    """x′ = r x − x³, y′ = y/2, symmetric under x → −x: a pitchfork of 0 at r = 1, a flip at r = −1."""
    return Formula(lambda x, y: (r * x - x**3, 0.5 * y), lambda x, y: [[r - 3.0 * x * x, 0.0], [0.0, 0.5]])


def arnold(omega, k=0.8):
    """φ′ = φ + ω − k sin φ: two fixed points for |ω| < k, multipliers 1 ∓ √(k² − ω²), born in folds at ω = ±k."""
    return Formula(
        lambda phi: (phi + omega - k * math.sin(phi),),
        lambda phi: [[1.0 - k * math.cos(phi)]],
        turns=(2.0 * math.pi,),
        names=("φ",),
    )


def bent_saddle(stretch=2.5, shrink=0.3, bend=1.0):
    """A linear saddle (u, v) → (s u, c v) seen through x = u, y = v + bend u²: manifolds y = bend x² and x = 0."""

    def there(x, y):
        u, v = stretch * x, shrink * (y - bend * x * x)
        return u, v + bend * u * u

    def back(x, y):
        u, v = x / stretch, (y - bend * x * x) / shrink
        return u, v + bend * u * u

    def slope(s, c):
        return lambda x, y: [[s, 0.0], [-2.0 * c * bend * x + 2.0 * s * s * bend * x, c]]

    return Formula(there, slope(stretch, shrink), back, slope(1.0 / stretch, 1.0 / shrink))


def pendulum(epsilon, mu=1.5, ripple=0.0):
    """McMillan's map x′ = y, y′ = −(1 − ε)x + 2μy/(1 + y²), which keeps x² + y² + x²y² − 2μxy for ε = 0; a saddle at 0.

    For ε = 0 the zero level is a separatrix, a loop; for others friction parts its two sides.  A ripple, δ y³ added to
    y′, keeps areas, and (x, y) → (y, x) goes on to be a reversor.
    """
    rest = 1.0 - epsilon

    def kick(y):
        return 2.0 * mu * y / (1.0 + y * y) + ripple * y**3

    def slope(y):
        return 2.0 * mu * (1.0 - y * y) / (1.0 + y * y) ** 2 + 3.0 * ripple * y * y

    return Formula(
        lambda x, y: (y, -rest * x + kick(y)),
        lambda x, y: [[0.0, 1.0], [-rest, slope(y)]],
        lambda x, y: ((kick(x) - y) / rest, x),
        lambda x, y: [[slope(x) / rest, -1.0 / rest], [1.0, 0.0]],
    )
