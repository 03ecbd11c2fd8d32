"""The results as text (Markdown) and as JSON."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from support.measured import table

from .measure import MeasuredWorkload
from .method import OURS, named, short
from .scaling import Scaling


@dataclass(frozen=True)
class BenchmarkReport:
    """A whole benchmark.

    facts : day, machine, Python; versions : by method and library; missing : peers that are not here, and why;
    targets : errors asked for; measured : one for each work; scaling : on one and on two threads.
    """

    facts: Mapping[str, str | int]
    versions: Mapping[str, str]
    missing: Mapping[str, str]
    targets: Sequence[float]
    measured: Sequence[MeasuredWorkload]
    scaling: Sequence[Scaling]

    @property
    def methods(self):
        """Return the names of all methods that solved a problem, in order of appearance."""
        return list(dict.fromkeys(name for one in self.measured for name in one.samples))


def _digits(x, digits):
    """Format with at least this many digits, without an exponent."""
    return f"{x:.{max(0, digits - 1 - math.floor(math.log10(x)))}f}"


def _ms(seconds):
    return _digits(1e3 * seconds, 3)


def _cell(name, chosen, ours):
    if chosen is None:
        return "–"
    text = _ms(chosen.timing.minimum)
    if name == OURS:
        return f"{text} ({short(chosen.sample.error)}; {named(chosen.sample.setting)})"
    return f"{text} ({_digits(_ratio(chosen, ours), 2)} ×)" if ours is not None else text


def _ratio(chosen, ours):
    return chosen.timing.minimum / ours.timing.minimum


def as_text(report):
    """Return Markdown: machine and versions, the problems, the table, threads, and omissions with reasons."""
    facts = report.facts
    versions = ", ".join(f"{name} {version}" for name, version in report.versions.items())
    methods = report.methods
    rows = [
        [
            one.work.name,
            short(target),
            *(
                _cell(name, one.chosen.get(name, {}).get(target), one.chosen.get(OURS, {}).get(target))
                for name in methods
            ),
        ]
        for one in report.measured
        for target in report.targets
    ]
    blocks = [
        f"{facts['date']}, {facts['processor']}, {facts['cores']} cores, Python {facts['python']}, {versions}.",
        "One thread; milliseconds, the minimum of runs in turn; each method at the cheapest setting whose measured "
        f"error keeps the target.  {OURS}: also this error, and order and tolerance of the Taylor steps; the "
        f"others: also their time as a multiple of {OURS}'s.  –: the target is not reached.",
        "\n".join(f"- {one.work.name}: {one.work.title}" for one in report.measured),
        table(["work", "error", *methods], rows),
    ]
    if report.scaling:
        blocks += [
            "Two cores: milliseconds on one and on two threads.",
            table(
                ["work", "method", "setting", "1 thread", "2 threads", "faster by"],
                [
                    [
                        one.title,
                        one.method,
                        named(one.setting),
                        _ms(one.one.minimum),
                        _ms(one.two.minimum),
                        f"{one.factor:.2f} ×",
                    ]
                    for one in report.scaling
                ],
            ),
        ]
    notes = [f"{name}: {why}." for name, why in report.missing.items()]
    notes += [note for one in report.measured for note in one.notes]
    if notes:
        blocks.append("\n".join(f"- {note}" for note in notes))
    return "\n\n".join(blocks) + "\n"


def as_json(report):
    """All that was measured, for strict JSON: times in seconds, errors as numbers, null for a result that failed."""
    return {
        **report.facts,
        "versions": dict(report.versions),
        "missing": dict(report.missing),
        "targets": list(report.targets),
        "works": [_work(one) for one in report.measured],
        "two_cores": [
            {
                "work": one.title,
                "method": one.method,
                "setting": named(one.setting),
                "one_thread": one.one.minimum,
                "two_threads": one.two.minimum,
                "factor": one.factor,
            }
            for one in report.scaling
        ],
    }


def _work(one):
    ours = one.chosen.get(OURS, {})
    return {
        "name": one.work.name,
        "title": one.work.title,
        "notes": list(one.notes),
        "samples": {
            name: [
                {
                    "setting": named(sample.setting),
                    "seconds": sample.seconds,
                    "error": sample.error if math.isfinite(sample.error) else None,
                }
                for sample in samples
            ]
            for name, samples in one.samples.items()
        },
        "chosen": [
            {
                "method": name,
                "target": target,
                "setting": named(chosen.sample.setting),
                "error": chosen.sample.error,
                "minimum": chosen.timing.minimum,
                "median": chosen.timing.median,
                "runs": chosen.timing.runs,
                "ratio": _ratio(chosen, ours[target]) if target in ours else None,
            }
            for name, by_target in one.chosen.items()
            for target, chosen in by_target.items()
        ],
    }
