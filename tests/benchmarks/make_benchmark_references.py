"""Make tests/benchmarks/integrators/references.npz: `python tests/benchmarks/make_benchmark_references.py` (15 min).

Taylor series in fixed-point numbers: an integer c stands for c/2^bits.  Everything is computed twice, with other
precision and order and so with other steps, and the two must agree to 1e-30.  Before that the same code must give the
20 digits of tests/reference.json.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import mul
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import mpmath
import numpy as np

from benchmarks.integrators.works import (
    FIELD_BODY,
    FREE_BODY,
    MAP_TORUS,
    REFERENCES,
    dense_times,
    end,
    long_end,
    phases,
)

SAMPLES = 200
SCAN = 16  # sub-points of a step at which the sign of γ3 is looked at

Terms = list[dict[tuple[int, ...], Fraction]]
Step = tuple[int, int, list[list[int]]]


@dataclass(frozen=True)
class Digits:
    """Working precision: bits after the binary point, and the order of the series."""

    bits: int
    order: int

    def fixed(self, x: float | Fraction) -> int:
        """A number as fixed-point integer."""
        return math.floor(Fraction(x) * 2**self.bits)

    def doubles(self, x: Any) -> Any:
        """Integers, and lists of them, as floats: correctly rounded, as Python's division of integers is."""
        return [self.doubles(part) for part in x] if isinstance(x, list) else x / (1 << self.bits)

    def value(self, c: list[int], s: int) -> int:
        """Σ c[k] s^k."""
        total = 0
        for coefficient in reversed(c):
            total = (total * s >> self.bits) + coefficient
        return total

    def slope(self, c: list[int], s: int) -> int:
        """Σ k c[k] s^(k−1)."""
        return self.value([k * coefficient for k, coefficient in enumerate(c)][1:], s)


RUNS = (Digits(bits=136, order=48), Digits(bits=168, order=60))
# The orbit up to t = 2000 is unstable, and takes many steps.
LONG_RUNS = (Digits(bits=232, order=80), Digits(bits=280, order=96))


def suslov(p: Sequence[float | Fraction]) -> Terms:
    """`Biz131`: for each of (ω1, ω2, γ1, γ2, γ3) which product of variables has which factor in its rate."""
    I11, I22, I13, I23, b1, b2, b3 = map(Fraction, p)
    return [
        {(0, 1): -I13 / I11, (1, 1): -I23 / I11, (3,): b3 / I11, (4,): -b2 / I11},
        {(0, 0): I13 / I22, (0, 1): I23 / I22, (4,): b1 / I22, (2,): -b3 / I22},
        {(1, 4): Fraction(-1)},
        {(0, 4): Fraction(1)},
        {(1, 2): Fraction(1), (0, 3): Fraction(-1)},
    ]


def pendulum_and_matrix(a: Fraction) -> Terms:
    """(w1, w2, n1, n2, n3) of `eq01` at a = 0 and b = 1, then re and im of A and B (see models/circle_map.py)."""
    half, one = a / 2, Fraction(1)
    return [
        {(3,): -one},
        {(2,): one},
        {(1, 4): -one},
        {(0, 4): one},
        {(1, 2): one, (0, 3): -one},
        {(1, 8): -half, (0, 7): -half},
        {(1, 7): -half, (0, 8): half},
        {(1, 6): -half, (0, 5): -half},
        {(1, 5): -half, (0, 6): half},
    ]


def motion(terms: Terms, state: Iterable[int], until: int, digits: Digits) -> Iterator[Step]:
    """The solution step by step as (t, length of the step, series of each variable), fixed-point like `state`."""
    bits, order = digits.bits, digits.order
    linear = [[(digits.fixed(c), ij[0]) for ij, c in term.items() if len(ij) == 1] for term in terms]
    quadratic = [[(digits.fixed(c), ij) for ij, c in term.items() if len(ij) == 2] for term in terms]
    pairs = {ij for term in terms for ij in term if len(ij) == 2}
    t, y = 0, list(state)
    while t < until:
        c = [[value] for value in y]
        for k in range(order):
            product = {(i, j): sum(map(mul, c[i], reversed(c[j]))) >> bits for i, j in pairs}
            for row, ones, twos in zip(c, linear, quadratic, strict=True):
                rate = sum(factor * c[i][k] for factor, i in ones) + sum(factor * product[ij] for factor, ij in twos)
                row.append((rate >> bits) // (k + 1))
        # The last two terms come out below the last bit.
        last = max(math.log2(1 + abs(row[k])) / k for row in c for k in (order - 1, order))
        step = min(digits.fixed(2.0**-last), until - t)
        yield t, step, c
        y = [digits.value(row, step) for row in c]
        t += step


def states_at(times: Iterable[int], steps: Iterable[Step], digits: Digits) -> list[list[int]]:
    """The states at the given increasing times."""
    found = []
    left = list(times)
    for t, step, c in steps:
        while left and left[0] <= t + step:
            s = left.pop(0) - t
            found.append([digits.value(row, s) for row in c])
    return found


def upward_crossings(steps: Iterable[Step], digits: Digits) -> list[list[int]]:
    """The states at which γ3 grows through 0."""
    found = []
    for _, step, c in steps:
        points = [step * i // SCAN for i in range(SCAN + 1)]
        values = [digits.value(c[4], s) for s in points]
        for i in range(SCAN):
            if values[i] < 0 <= values[i + 1]:
                s = (points[i] + points[i + 1]) // 2
                for _ in range(12):
                    s -= (digits.value(c[4], s) << digits.bits) // digits.slope(c[4], s)
                if not points[i] <= s <= points[i + 1]:
                    raise ArithmeticError("Newton's method left the interval of a crossing.")
                found.append([*(digits.value(row, s) for row in c[:4]), 0])
    return found


def long_orbit(start: np.ndarray, rows: np.ndarray, digits: Digits) -> dict[str, list[list[int]]]:
    """A, A2 and D from one orbit."""
    state = [digits.fixed(x) for x in start]
    until = digits.fixed(long_end()[0])
    steps = list(motion(suslov(FIELD_BODY), state, until, digits))
    return {
        "A": states_at([digits.fixed(t) for t in dense_times()[rows]], steps, digits),
        "A2": states_at([until], steps[-1:], digits),
        "D": upward_crossings(steps, digits),
    }


def ensemble(p: Sequence[float], initial: np.ndarray, digits: Digits) -> list[list[int]]:
    """The end states of B or B2."""
    terms, until = suslov(p), digits.fixed(end()[0])
    found = []
    for i, start in enumerate(initial):
        if i % 64 == 0:
            print(f"  orbit {i} of {len(initial)}", file=sys.stderr, flush=True)
        state = [digits.fixed(x) for x in start]
        found += states_at([until], motion(terms, state, until, digits), digits)
    return found


def circle_map(h: Fraction, f: Fraction, a: Fraction, phi: Iterable[float], digits: Digits) -> list[int]:
    """Θ(φ) of the torus (h, f), units b = 1: the matrix from the lower to the upper turning point, and back."""
    # Twice the bits: an angle near 0 has half of those of its cosine.
    with mpmath.workprec(2 * digits.bits):
        h_, f_ = (mpmath.mpf(x.numerator) / x.denominator for x in (h, f))
        # 2(h+n)(1−n²) = f² is t³ + pt + q = 0 for t = n + h/3.
        p, q = -1 - h_**2 / 3, 2 * h_**3 / 27 - 2 * h_ / 3 + f_**2 / 2
        angle = mpmath.acos(3 * q / (2 * p) * mpmath.sqrt(-3 / p)) / 3
        n0, n1, n2 = sorted(
            2 * mpmath.sqrt(-p / 3) * mpmath.cos(angle - 2 * k * mpmath.pi / 3) - h_ / 3 for k in range(3)
        )
        half_period = mpmath.sqrt(2 / (n2 - n0)) * mpmath.ellipk((n2 - n1) / (n2 - n0))
        w = mpmath.sqrt(2 * (h_ + n1))

        def fixed(x: mpmath.mpf) -> int:
            return int(mpmath.floor(x * 2**digits.bits))

        state = [fixed(x) for x in (0, w, 0, f_ / w, n1, 1, 0, 0, 0)]
        until = fixed(half_period)
        (last,) = states_at([until], motion(pendulum_and_matrix(a), state, until, digits), digits)
        w1, w2, _, _, _, *matrix = (mpmath.mpf(x) / 2**digits.bits for x in last)
        turn = mpmath.expj(mpmath.atan2(w1, w2) / 2)
        A, B = (mpmath.mpc(*matrix[:2]) * turn, mpmath.mpc(*matrix[2:]) * turn)
        alpha, beta = A * A - mpmath.conj(B) ** 2, 2j * (A * B).imag
        angles = []
        for angle in phi:
            z = mpmath.expj(angle)
            angles.append(fixed(mpmath.arg((alpha * z + beta) / (mpmath.conj(beta) * z + mpmath.conj(alpha)))))
        return angles


def check(digits: Digits) -> None:
    """The 20 digits of tests/reference.json.  Raises `ArithmeticError`."""
    reference = json.loads((Path(__file__).parents[1] / "support" / "reference.json").read_text())
    pairs: list[tuple[int, str]] = []
    for row in reference["trajectories"]:
        if row["system"] == "suslov":
            terms = suslov([Fraction(x) for x in (*row["params"]["I"], *row["params"]["b"])])
            times = [digits.fixed(Fraction(state["t"])) for state in row["states"]]
            state = [digits.fixed(Fraction(x)) for x in row["y0"]]
            found = states_at(times, motion(terms, state, times[-1], digits), digits)
            for ours, state in zip(found, row["states"], strict=True):
                pairs += zip(ours, state["y"], strict=True)
    for row in reference["hess_monodromy"]:
        h, f, a = (Fraction(row[name]) for name in ("h", "f", "a"))
        pairs += zip(circle_map(h, f, a, (0.0, 1.0, 2.0), digits), row["theta_of_phi_0_1_2"], strict=True)
    for found, expected in pairs:
        # The initial states there have 22 digits.
        if abs(Fraction(found, 2**digits.bits) - Fraction(expected)) > Fraction("1e-17"):
            raise ArithmeticError(f"{digits.doubles(found)!r} is not {expected}.")


def initial_states() -> dict[str, np.ndarray]:
    """Return the initial states of A (A2, D), B and B2.

    They are stored, as sine, cosine and square root may differ from machine to machine.
    """
    gamma = np.array([0.3, 0.2, 0.93])
    # B: the circle at π/2 about ξ = (I23, −I13, 0)/|…|.
    xi, axis = np.array([FREE_BODY[3], -FREE_BODY[2], 0.0]), np.array([0.0, 0.0, 1.0])
    phi = np.linspace(0.0, 2 * math.pi, 512, endpoint=False)[:, None]
    circle = np.cos(phi) * np.cross(axis, xi / np.linalg.norm(xi)) + np.sin(phi) * axis
    # B2: normal ω, γ uniform on the sphere.
    random = np.random.default_rng(1)
    omega, sphere = random.standard_normal((512, 2)), random.standard_normal((512, 3))
    return {
        "A_initial": np.array([[0.8, -0.4, *gamma / np.linalg.norm(gamma)]]),
        "B_initial": np.hstack([np.tile([2.0, 1e-5], (512, 1)), circle]),
        "B2_initial": np.hstack([omega, sphere / np.linalg.norm(sphere, axis=1, keepdims=True)]),
    }


Results = dict[str, tuple[list[int] | list[list[int]], Digits]]


def compute(initial: dict[str, np.ndarray], rows: np.ndarray, digits: Digits, long: Digits) -> Results:
    """All results, as fixed-point integers with their digits."""
    return {
        **{name: (found, long) for name, found in long_orbit(initial["A_initial"][0], rows, long).items()},
        "B": (ensemble(FREE_BODY, initial["B_initial"], digits), digits),
        "B2": (ensemble(FIELD_BODY, initial["B2_initial"], digits), digits),
        "C": (circle_map(*map(Fraction, MAP_TORUS), phases(), digits), digits),
    }


def compare(name: str, first: tuple[list, Digits], second: tuple[list, Digits]) -> None:
    """Raise `ArithmeticError` unless the two have one shape and differ by at most 1e-30."""
    (one, digits), (two, finer) = first, second
    left, right = np.array(one, dtype=object), np.array(two, dtype=object)
    if left.shape != right.shape or np.max(np.abs((left << (finer.bits - digits.bits)) - right)) > finer.fixed(1e-30):
        raise ArithmeticError(f"The two computations of {name} differ.")


def main() -> None:
    """Compute everything twice, compare, store."""
    check(RUNS[0])
    initial = initial_states()
    inside = np.random.default_rng(0).choice(dense_times().size - 1, SAMPLES - 1, replace=False)
    rows = np.sort(np.append(inside, dense_times().size - 1))
    first, second = (compute(initial, rows, digits, long) for digits, long in zip(RUNS, LONG_RUNS, strict=True))
    for name in first:
        compare(name, first[name], second[name])
    found = {name: np.array(digits.doubles(value)) for name, (value, digits) in first.items()}
    np.savez_compressed(REFERENCES, A_rows=rows.astype(np.int16), **initial, **found)
    print(f"{REFERENCES}: {REFERENCES.stat().st_size} bytes, {len(found['D'])} crossings")


if __name__ == "__main__":
    main()
