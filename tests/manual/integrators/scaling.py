"""Measure the speed-up of two threads over one."""

from dataclasses import dataclass, replace

import numpy as np

from .measure import Timing, race
from .works import MotionWorkload, works


@dataclass(frozen=True)
class Scaling:
    """One method in one work (`title`), at one setting, on one and on two threads."""

    title: str
    method: str
    setting: tuple
    one: Timing
    two: Timing

    @property
    def factor(self):
        """One thread's time over that of two."""
        return self.one.minimum / self.two.minimum


def _many(work):
    """A work that threads can share: the work itself; for D, which is one orbit, the sections of 64 orbits."""
    ensemble = works()["B2"]
    if work.name != "D" or not (isinstance(work, MotionWorkload) and isinstance(ensemble, MotionWorkload)):
        return work
    return replace(
        work,
        title="crossings of γ3 = 0 by 64 random orbits up to t = 200",
        initial=ensemble.initial[:64],
        times=np.array([200.0]),
    )


def scaling(measured, methods, effort, progress):
    """Every method in the works that it can share between threads, at its setting for the smallest error it reached."""
    found = []
    for one in measured:
        for method in methods:
            chosen = one.chosen.get(method.name)
            if one.work.name in method.threaded and chosen:
                progress(f"work {one.work.name}: {method.name} on two threads")
                work, setting = _many(one.work), chosen[min(chosen)].sample.setting
                timings = race([method.prepare(work, setting, threads) for threads in (1, 2)], effort)
                found.append(Scaling(f"{work.name}: {work.title}", method.name, setting, *timings))
    return found
