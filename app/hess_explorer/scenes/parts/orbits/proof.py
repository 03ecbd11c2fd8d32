"""Rigorous error bounds on the orbit: its distance from the true orbit at each sample."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.scene import Motion
from hess_explorer.scenes.framework.sliders import SHOWN
from hess_explorer.views.space.poisson_sphere import Circle
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.tube import ProvedOrbit, tube
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.balls import has_flint
from hess_mechanics.numerics.results import Array, Orbit
from hess_mechanics.suslov_hess.torus import Track

_DIGITS, _MOST_WORK = 16, 1e6
"""Digits and work limit of a tube: far below double round-off; about 1.5 s of CPU time, 4 s for the ball."""
_HALF, _FAR = 0.5, 150.0
"""Smallest and largest error that is drawn, in pixels: a larger one would fill the picture."""
_BOXES, _CIRCLES = 300, 16


@dataclass(frozen=True)
class ProvedError:
    """A proved error, and regions that enclose the true orbit where the error is visible.

    Attributes
    ----------
    sentence : str
        Entry in the status line.
    band : tuple of array (n, 2)
        Convex polygons in (ω1, ω2).
    circles : tuple
        Pairs of a centre γ (3,) and an angular radius in radians.
    """

    sentence: str
    band: tuple[Array, ...] = ()
    circles: tuple[tuple[tuple[float, float, float], float], ...] = ()


class _Host(Host, Protocol):
    @property
    def orbit_task(self) -> Task[Orbit | Track]:
        """The task of the orbit, an `Orbit` or a `Track`.  Raises `ModelError`."""

    def motion(self) -> Motion:
        """Return the motion of the orbit.  Raises `ModelError`."""


@dataclass(frozen=True, eq=False)
class OrbitProof(Part[_Host]):
    """The proved error of the orbit of a traced system.

    Attributes
    ----------
    certain : str
        `SHOWN` or `HIDDEN`.
    units : tuple
        Factors from ω1 and ω2 of the computation to those of the picture.
    """

    certain: str
    units: tuple[float, float] = (1.0, 1.0)

    @cached_property
    def error(self) -> ProvedError | None:
        """The proved error, or why there is none; None until known, if it is hidden, and during a drag."""
        if self.work.is_preview or self.certain != SHOWN:
            return None
        if not has_flint():
            return ProvedError("proofs need python-flint: pip install 'hess-explorer[prove]'")
        return self.work.need(Task(proved_error, self.host.orbit_task, self.host.motion(), self.units), preview=None)

    @property
    def band(self) -> list[list[Array]]:
        """Polygons that enclose the true orbit where the error is visible, for a `region`; empty until known."""
        return [] if self.error is None else [[one] for one in self.error.band]

    @property
    def circles(self) -> list[Circle]:
        """Circles on the sphere that enclose the true orbit at some samples with a visible error; empty until known."""
        found = () if self.error is None else self.error.circles
        return [Circle(gamma, float(np.cos(radius)), "muted") for gamma, radius in found]

    def status(self) -> Iterator[str]:
        """Yield the proved error, or the reason why there is none."""
        if self.error is not None:
            yield self.error.sentence


def proved_error(orbit_task: Task[Orbit | Track], motion: Motion, units: tuple[float, float]) -> ProvedError:
    """Prove the error of an orbit by a rigorous enclosure (tube) of its motion.

    If the proof fails or takes too long, the sentence states this.

    Parameters
    ----------
    orbit_task : Task
        The task of the orbit, whose states end with γ.
    motion : Motion
        The motion of the orbit.
    units : tuple of float
        Factors from ω1 and ω2 of the computation to those of the picture.
    """
    found: Orbit | Track = orbit_task.get()
    orbit, omega, gamma = (
        (found.orbit, found.omega, found.gamma)
        if isinstance(found, Track)
        else (found, found.states[:, :2], found.states[:, -3:])
    )
    try:
        true = tube(motion, motion.start, orbit.times, _DIGITS, _MOST_WORK)
    except ModelError as error:
        return ProvedError(f"not proved: {error}")
    proved = ProvedOrbit(orbit, true)
    errors = proved.bounds
    if len(errors) < 2:
        return ProvedError("not proved: that would take too long")
    first, pixels = motion.system.angular_velocities, errors * np.array(motion.weights)
    sizes = [np.linalg.norm(part, axis=1) for part in (pixels[:, :first], pixels[:, first:])]
    wrong = np.flatnonzero(np.maximum(*sizes) > _HALF)
    last = (wrong[0] if wrong.size else len(errors)) - 1
    whole = len(errors) == orbit.times.size
    until = (
        "to its end"
        if whole and not wrong.size
        else (
            f"until t = {digits(float(orbit.times[last]) * motion.unit)}"
            + ("" if wrong.size else ", where the proof breaks off")
        )
    )
    sentence = f"proved error ≤ {errors[: last + 1].max():.1e}, certainly right to ½ pixel {until}"
    if proved.least > orbit.error_estimate:
        sentence += f"; the estimate is too small, as the error reaches {proved.least:.1e}"
    band, around = [], []
    if first == 2 and motion.weights[0] > 0.0:
        band = _band(omega[: len(errors)], errors[:, :2] * np.array(units), sizes[0])
    seen = _visible_samples(sizes[1])
    for i in seen[:: max(1, -(-len(seen) // _CIRCLES))]:
        x, y, z = (float(value) for value in gamma[i] / np.linalg.norm(gamma[i]))
        # An angle is a little larger than its chord, and the computed γ is slightly off the sphere.
        around.append(((x, y, z), 1.05 * float(np.linalg.norm(errors[i, first:]))))
    return ProvedError(sentence, tuple(band), tuple(around))


def _visible_samples(sizes: Array) -> list[int]:
    """Return the indices of samples with a visible error, up to the first error that would fill the picture."""
    far = np.flatnonzero(sizes > _FAR)
    end = int(far[0]) if far.size else len(sizes)
    return [int(i) for i in np.flatnonzero(sizes[:end] > _HALF)]


def _band(omega: Array, errors: Array, sizes: Array) -> list[Array]:
    """Return the convex hulls of the error boxes of neighbouring samples."""
    seen = _visible_samples(sizes)
    step = max(1, -(-len(seen) // _BOXES))
    found = []
    for begin in range(0, len(seen), step):
        some = seen[begin : begin + step + 1]
        corners = [omega[some] + errors[some] * np.array(signs) for signs in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
        # Samples of different pieces of an orbit are not neighbours.
        if some[-1] - some[0] == len(some) - 1:
            found.append(hull(np.vstack(corners)))
    return found


def hull(points: Array) -> Array:
    """Return the closed convex hull (m, 2) of points (n, 2)."""
    from scipy.spatial import ConvexHull  # Imported here because the import is slow and few states draw a band.

    # Qhull's option QJ joggles the input, so that collinear points raise no error.
    corners = ConvexHull(points, qhull_options="QJ").vertices
    return np.asarray(points[[*corners, corners[0]]])
