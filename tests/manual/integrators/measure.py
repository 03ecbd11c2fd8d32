"""Run every setting of each method once, find the cheapest for each target error, and time these in turn."""

import sys
import time
from dataclasses import dataclass

from manual.timing import in_turn
from support.measured import table

from .method import OURS, named, short

SLOW, BUDGET = 3.0, 20.0
"""Seconds: a run that takes longer ends its ladder; the settings of one method in one work take no longer in all."""


@dataclass(frozen=True)
class Sample:
    """One setting of a method: its error, the seconds of its fastest run, and the run."""

    setting: tuple
    error: float
    seconds: float
    run: object


def climb(work, method):
    """Yield a sample for each setting, as long as there is time."""
    spent = 0.0
    for ladder in method.ladders(work):
        for setting in ladder:
            run, seconds = method.prepare(work, setting), []
            for _ in range(3):
                begun = time.perf_counter()
                result = run()
                seconds.append(time.perf_counter() - begun)
            spent += sum(seconds)
            yield Sample(setting, work.error(result), min(seconds), run)
            if spent > BUDGET:
                return
            if min(seconds) > SLOW:
                break


def cheapest(samples, target):
    """Return the fastest sample whose error is at most the target, or None."""
    return min((one for one in samples if one.error <= target), key=lambda one: one.seconds, default=None)


def measure(work, methods, targets):
    """Return the rows of the table: milliseconds of each method for each target, and their ratio to this project's."""
    samples = {}
    for method in methods:
        print(f"work {work.name}: {method.name} …", file=sys.stderr, flush=True)
        samples[method.name] = list(climb(work, method))
    rows = []
    for target in targets:
        best = {name: cheapest(own, target) for name, own in samples.items()}
        reached = {name: sample for name, sample in best.items() if sample is not None}
        seconds = dict(zip(reached, in_turn([sample.run for sample in reached.values()]), strict=True))
        rows.append([work.name, short(target), *(_cell(name, best[name], seconds) for name in samples)])
    return rows


def _cell(name, sample, seconds):
    if sample is None:
        return "–"
    text = f"{1e3 * seconds[name]:.3g}"
    if name == OURS:
        return f"{text} ({short(sample.error)}; {named(sample.setting)})"
    return f"{text} ({seconds[name] / seconds[OURS]:.2g} ×)" if OURS in seconds else text


def report(works, methods, targets):
    """Return the table of all works."""
    rows = [row for work in works for row in measure(work, methods, targets)]
    return table(["work", "error", *(method.name for method in methods)], rows)
