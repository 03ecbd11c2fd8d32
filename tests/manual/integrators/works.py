"""The works of the benchmark: their initial data, and the error of a result against the stored reference."""

import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

BODY = (2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0)
"""p = (I11, I22, I13, I23, b1, b2, b3) of the Suslov problem."""
REFERENCES = Path(__file__).with_name("references.npz")
"""Initial states and exact results, made by tests/manual/make_benchmark_references.py."""
DENSE = np.linspace(0.0, 200.0, 4000)
"""Times of work A."""
END, LONG_END = np.array([60.0]), np.array([2000.0])
"""End of the ensemble, and of the long motions."""


@dataclass(frozen=True, eq=False)
class Workload:
    """Motions of the Suslov problem.

    name, title : identifier and words; initial : states (n, 5); times : of the results, or the end; shape : of a
    result; reference : the exact results in its `rows` (all, or indices), rounded to double.
    """

    name: str
    title: str
    initial: np.ndarray
    times: np.ndarray
    shape: tuple[int, ...]
    reference: np.ndarray
    rows: object = ...
    parameters: tuple[float, ...] = BODY

    def error(self, result):
        """Return the largest absolute error; ∞ for a result that has another shape or is not finite."""
        if result.shape != self.shape or not np.all(np.isfinite(result)):
            return math.inf
        return float(np.max(np.abs(result[self.rows] - self.reference)))


@cache
def works():
    """Return all works by name, with the stored references."""
    with np.load(REFERENCES) as file:
        stored = dict(file)
    start, crossings = stored["A_initial"], stored["D"]
    upward = f"all {len(crossings)} upward crossings of γ3 = 0 up to t = 2000"
    many = "512 random orbits, their states at t = 60"
    found = [
        Workload("A", "one orbit, 4000 states", start, DENSE, (4000, 5), stored["A"], stored["A_rows"]),
        Workload("A2", "one orbit, its state at t = 2000", start, LONG_END, (1, 5), stored["A2"]),
        Workload("B2", many, stored["B2_initial"], END, (512, 5), stored["B2"]),
        Workload("D", upward, start, LONG_END, crossings.shape, crossings),
    ]
    return {work.name: work for work in found}
