"""Cost and error of every level: `python tests/manual/benchmark_trade.py` measures the pictures of all scenes.

It prints a row for each computation of each scene, and writes the table by kind to the text of "Speed and accuracy".
`--catalogue KEY…` prints the table of these computations of the catalogue instead.
"""

import argparse
import math
import sys
from dataclasses import dataclass
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.protocol.specs import ChoiceSpec
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.trial import bare
from hess_explorer.views.text import digits
from hess_mechanics.catalogue import catalogue, find
from hess_mechanics.dynamics.trade import LevelCost, enough, measure
from hess_mechanics.errors import InvalidParameter, ModelError
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS, MEANINGS, PLANS, REFERENCE, Kind
from manual.timing import conditions
from support.measured import line, table, write_measured

ROOT = Path(__file__).resolve().parents[2]
WORDS = ROOT / "app" / "hess_explorer" / "scenes"


@dataclass(frozen=True)
class Row:
    """A computation of the catalogue or a scene: a sample for each level; the first level whose error is not seen."""

    name: str
    kind: str
    unit: str
    samples: tuple[LevelCost, ...]
    enough: str

    @property
    def ratio(self):
        """Ratio of the run times at `reference` and at `draft`."""
        return self.samples[-1].ms / self.samples[0].ms


def names():
    """Return the scenes whose computations depend on the accuracy level."""
    return tuple(name for name, scene in scenes().items() if scene.origin is None and scene.trials)


@dataclass(frozen=True)
class Failed:
    """A kind of computation that could not be measured, and why."""

    name: str
    kind: str
    why: str


def _states(scene):
    """Yield the default state, the presets, and variants of each with a single choice changed."""
    shown = [{**scene.defaults(), **values} for values in ({}, *map(scene.example, scene.presets))]
    yield from shown
    for values in shown:
        for spec in scene.specs:
            if isinstance(spec, ChoiceSpec) and spec.name != "accuracy":
                yield from ({**values, spec.name: option} for option in spec.options)


def _example(scene, trial):
    """Return the first state that shows this computation.  Raises `InvalidParameter`."""
    for values in _states(scene):
        state = bare(scene.of(values))
        if trial.shown(state):
            return state
    raise InvalidParameter(
        f"No example of the scene {scene.name} and no single choice in one shows {trial.kind}: give "
        "it an example that does."
    )


def _row(name, scene, trial):
    try:
        state = _example(scene, trial)
        samples = tuple(
            measure(
                trial.kind,
                lambda plan: trial.run(state, plan),
                lambda *both: trial.error(state, *both),
                3,
                trial.alike,
            )
        )
    except ModelError as error:
        return Failed(name, str(trial.kind), str(error))
    least = enough(samples, trial.seen) if any(one.is_measured for one in samples) else "–"
    return Row(name, str(trial.kind), trial.unit, samples, least)


def trade(chosen):
    """Yield a row for each kind of computation of the chosen scenes, in their first state that shows it."""
    for name in chosen:
        scene = scenes()[name]
        for trial in scene.trials:
            yield _row(name, scene, trial)


def trade_of_catalogue(keys):
    """Yield a row for each computation of the catalogue, with its default values."""
    for key in keys:
        of = find(key)
        try:
            yield Row(key, str(of.kind), of.unit, of.trade(repeats=3), "–")
        except ModelError as error:
            yield Failed(key, str(of.kind), str(error))


def _round(value):
    return f"{value:.0f}" if value >= 10.0 else digits(value, 2)


def _error(value):
    return "not measured" if math.isnan(value) else _round(value)


def heading():
    """The first lines of the table whose others are `line_of` each row."""
    return table(["computation of", "kind", *LEVELS, "ratio", "enough", "error in"], []) + "\n"


def line_of(row):
    """A line in Markdown: milliseconds and error of each level, and how many times as long the last one takes."""
    if isinstance(row, Failed):
        return line([row.name, row.kind, *["–"] * (len(LEVELS) + 2), row.why]) + "\n"
    cells = (f"{_round(one.ms)} ms, {_error(one.error)}" for one in row.samples)
    return line([row.name, row.kind, *cells, f"{_round(row.ratio)} ×", row.enough, row.unit]) + "\n"


def by_kind(rows):
    """A table in Markdown, a line for each kind of computation.

    It says what `draft` leaves out, how many times as long `reference` takes in the scenes (from the least to the
    most), and the largest error of each level among them.
    """
    lines = []
    for kind in Kind:
        own = [row for row in rows if row.kind == kind]
        if own:
            ratios = sorted(row.ratio for row in own)
            least, most = _round(ratios[0]), _round(ratios[-1])
            measured = ([row.samples[i].error for row in own if row.samples[i].is_measured] for i in range(len(LEVELS)))
            errors = (_error(max(some, default=math.nan)) for some in measured)
            takes = f"{least} ×" if least == most else f"{least} to {most} ×"
            lines.append([str(kind), _draft_computes(kind), takes, *errors, own[0].unit])
    return table(["computation", "draft computes", "reference takes", *LEVELS, "error in"], lines) + "\n"


def _draft_computes(kind):
    draft, last = PLANS[kind][DRAFT.name], PLANS[kind][REFERENCE.name]
    counted = MEANINGS[kind].share, MEANINGS[kind].cells
    parts = zip((draft.share, draft.cells), (last.share, last.cells), counted, strict=True)
    return (
        " and ".join(f"{100.0 * one / other:.0f} % of the {what}" for one, other, what in parts if one < other)
        or "as much"
    )


def main():
    """Measure for two minutes, print all, write the table by kind."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--catalogue", nargs="*", metavar="KEY", help="these computations, or all")
    keys = parser.parse_args().catalogue
    print(heading(), end="", flush=True)
    rows, failed = [], []
    for row in trade(names()) if keys is None else trade_of_catalogue(keys or catalogue()):
        print(line_of(row), end="", flush=True)
        (failed if isinstance(row, Failed) else rows).append(row)
    kinds = by_kind(rows)
    print(f"\n{kinds}")
    if keys is None and not failed:
        write_measured(WORDS / "shared" / "levels.md", f"{conditions()}.\n\n{kinds}")
    return len(failed)


if __name__ == "__main__":
    sys.exit(main())
