"""The works of the benchmark: their initial data, and the error of a result against the stored reference."""

import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

FIELD_BODY = (2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0)
"""p = (I11, I22, I13, I23, b1, b2, b3) of the works A, A2, B2, D."""
FREE_BODY = (3.56, 1.0, 0.0, 0.8, 0.0, 0.0, 0.0)
"""p of the work B."""
MAP_TORUS = (1.5, 0.6, 1.0)
"""(h, f, a) of the work C, units b = 1."""

REFERENCES = Path(__file__).with_name("references.npz")
"""Initial states and exact results, made by tests/manual/make_benchmark_references.py."""


def dense_times():
    """The times of work A, shape (4000,)."""
    return np.linspace(0.0, 200.0, 4000)


def end():
    """The end of the ensembles' motions, shape (1,)."""
    return np.array([60.0])


def long_end():
    """The end of the long motions, shape (1,)."""
    return np.array([2000.0])


def phases():
    """The angles of work C, shape (256,)."""
    return np.linspace(-math.pi, math.pi, 256, endpoint=False)


@dataclass(frozen=True, eq=False)
class Workload:
    """One work.

    name, title : identifier and words; shape : of a result; rows : which of its rows the reference holds (all, or
    indices); reference : the exact results there, rounded to double; period : what a difference is taken modulo, or
    None.
    """

    name: str
    title: str
    shape: tuple[int, ...]
    rows: np.ndarray | slice
    reference: np.ndarray
    period: float | None

    def error(self, result):
        """The largest absolute error; ∞ for a result that has another shape or is not finite."""
        if result.shape != self.shape or not np.all(np.isfinite(result)):
            return math.inf
        difference = result[self.rows] - self.reference
        if self.period is not None:
            difference -= self.period * np.round(difference / self.period)
        return float(np.max(np.abs(difference)))


@dataclass(frozen=True, eq=False)
class MotionWorkload(Workload):
    """Motions of the Suslov problem: p (7,), initial states (n, 5), and times: of the results, or the end."""

    parameters: tuple[float, ...]
    initial: np.ndarray
    times: np.ndarray


@dataclass(frozen=True, eq=False)
class MapWorkload(Workload):
    """The circle map of the torus (h, f), units b = 1, at the angles phi (n,)."""

    h: float
    f: float
    a: float
    phi: np.ndarray


@cache
def works():
    """All works by name, with the stored references."""
    with np.load(REFERENCES) as file:
        stored = dict(file)
    every = slice(None)
    crossings = stored["D"]
    start = stored["A_initial"]
    found = [
        MotionWorkload(
            "A",
            "one orbit, 4000 states up to t = 200",
            (4000, 5),
            stored["A_rows"],
            stored["A"],
            None,
            FIELD_BODY,
            start,
            dense_times(),
        ),
        MotionWorkload(
            "A2", "one orbit, its state at t = 2000", (1, 5), every, stored["A2"], None, FIELD_BODY, start, long_end()
        ),
        MotionWorkload(
            "B",
            "512 free orbits of one ω, their states at t = 60",
            (512, 5),
            every,
            stored["B"],
            None,
            FREE_BODY,
            stored["B_initial"],
            end(),
        ),
        MotionWorkload(
            "B2",
            "512 random orbits, their states at t = 60",
            (512, 5),
            every,
            stored["B2"],
            None,
            FIELD_BODY,
            stored["B2_initial"],
            end(),
        ),
        MapWorkload("C", "the circle map at 256 angles", (256,), every, stored["C"], 2 * math.pi, *MAP_TORUS, phases()),
        MotionWorkload(
            "D",
            f"all {len(crossings)} upward crossings of γ3 = 0 up to t = 2000",
            crossings.shape,
            every,
            crossings,
            None,
            FIELD_BODY,
            start,
            long_end(),
        ),
    ]
    return {work.name: work for work in found}
