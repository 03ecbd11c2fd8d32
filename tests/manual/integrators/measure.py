"""Errors and times: run every setting once, find the cheapest one for each target error, and time these in turn."""

import gc
import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from .method import named
from .works import Workload


@dataclass(frozen=True)
class Effort:
    """Limits on the measuring time; times in seconds.

    tries : runs of each setting; enough : no further run after this long; slow : a slower run ends its ladder;
    budget : for all settings of one method in one work; turns : rounds of the race; turn : length of one turn in it
    (at least one run); share : a run leaves the race after this long.
    """

    tries: int
    enough: float
    slow: float
    budget: float
    turns: int
    turn: float
    share: float


FULL = Effort(tries=3, enough=0.1, slow=3.0, budget=20.0, turns=15, turn=0.02, share=1.0)
QUICK = Effort(tries=1, enough=0.0, slow=0.5, budget=1.0, turns=2, turn=0.0, share=0.1)


@dataclass(frozen=True)
class MethodSample:
    """One setting of a method: its error, the fastest of its first runs in seconds, and the run for more."""

    setting: tuple
    error: float
    seconds: float
    run: Callable


@dataclass(frozen=True)
class Timing:
    """Timing of one method in the race: minimum and median in seconds, and the number of runs."""

    minimum: float
    median: float
    runs: int


def cheapest(samples, target):
    """The fastest sample whose error is at most the target, or None."""
    return min(
        (sample for sample in samples if sample.error <= target), key=lambda sample: sample.seconds, default=None
    )


def climb(work, method, effort):
    """Return one sample per setting, and a message for each setting that was skipped as too slow."""
    samples = []
    notes = []
    spent = 0.0
    for ladder in method.ladders(work):
        for i, setting in enumerate(ladder):
            if spent > effort.budget:
                notes.append(_left_out(method, work, ladder[i:], f"its other settings took {spent:.0f} s"))
                break
            run = method.prepare(work, setting)
            seconds = []
            for _ in range(effort.tries):
                start = time.perf_counter()
                result = run()
                seconds.append(time.perf_counter() - start)
                if sum(seconds) > effort.enough:
                    break
            spent += sum(seconds)
            samples.append(MethodSample(setting, work.error(result), min(seconds), run))
            if min(seconds) > effort.slow and i + 1 < len(ladder):
                notes.append(_left_out(method, work, ladder[i + 1 :], f"{named(setting)} takes {min(seconds):.1f} s"))
                break
    return samples, notes


def _left_out(method, work, settings, why):
    return f"{method.name}, work {work.name}: left out {named(settings[0])} to {named(settings[-1])}, as {why}."


def race(runs, effort):
    """Time the runs in turn, so that other load on the machine affects all of them alike."""
    seconds = [[] for _ in runs]
    collecting = gc.isenabled()
    gc.disable()
    try:
        for _ in range(effort.turns):
            for run, own in zip(runs, seconds, strict=True):
                if sum(own) < effort.share:
                    _turn(run, own, effort.turn)
    finally:
        if collecting:
            gc.enable()
    return [Timing(min(own), statistics.median(own), len(own)) for own in seconds]


def _turn(run, seconds, length):
    begin = time.perf_counter()
    while True:
        start = time.perf_counter()
        run()
        now = time.perf_counter()
        seconds.append(now - start)
        if now - begin >= length:
            return


@dataclass(frozen=True)
class Chosen:
    """The setting that a method needs for one target, and how long it takes."""

    sample: MethodSample
    timing: Timing


@dataclass(frozen=True)
class MeasuredWorkload:
    """One work: the samples of each method, what each needs for each target (where it reaches it), sentences."""

    work: Workload
    samples: Mapping[str, Sequence[MethodSample]]
    chosen: Mapping[str, Mapping[float, Chosen]]
    notes: Sequence[str]


def measure(work, methods, targets, effort, progress):
    """All methods in one work."""
    samples = {}
    notes = []
    for method in methods:
        if work.name in method.without:
            notes.append(f"{method.name}, work {work.name}: {method.without[work.name]}.")
            continue
        progress(f"work {work.name}: the settings of {method.name}")
        samples[method.name], said = climb(work, method, effort)
        notes += said
    best = {
        (name, target): sample
        for name, found in samples.items()
        for target in targets
        if (sample := cheapest(found, target)) is not None
    }
    # One setting may be the cheapest for several targets.
    runners = list({id(sample): sample for sample in best.values()}.values())
    progress(f"work {work.name}: {len(runners)} runs in turn")
    timings = dict(zip(map(id, runners), race([sample.run for sample in runners], effort), strict=True))
    chosen = {
        name: {
            target: Chosen(best[name, target], timings[id(best[name, target])])
            for target in targets
            if (name, target) in best
        }
        for name in samples
    }
    return MeasuredWorkload(work, samples, chosen, notes)
