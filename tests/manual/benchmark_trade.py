"""Cost and error of every level: `python tests/manual/benchmark_trade.py` measures the pictures of all scenes.

The table by kind goes to the text of "Speed and accuracy".
"""

import math
import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.protocol.specs import ChoiceSpec
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.trial import bare_state
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.trade import measure
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS, MEANINGS, PLANS, REFERENCE, Kind
from manual.timing import report

APP = Path(__file__).resolve().parents[2] / "app"


def trials():
    """Yield (scene, trial) for each computation of the scenes that depends on the level of accuracy."""
    for scene in scenes().values():
        if scene.origin is None:
            yield from ((scene, trial) for trial in scene.trials)


def example(scene, trial):
    """Return a state that shows this computation: the default one, an example, or one with a single choice changed."""
    shown = [{**scene.defaults(), **values} for values in ({}, *map(scene.example, scene.presets))]
    choices = [spec for spec in scene.specs if isinstance(spec, ChoiceSpec) and spec.name != "accuracy"]
    changed = ({**values, spec.name: one} for values in shown for spec in choices for one in spec.options)
    states = (bare_state(scene.of(values)) for values in (*shown, *changed))
    return next(state for state in states if trial.condition(state))


def measured(scene, trial):
    """Return the cost of each level."""
    state = example(scene, trial)
    return list(
        measure(
            trial.kind,
            lambda plan: trial.run(state, plan),
            lambda *both: trial.error(state, *both),
            3,
            trial.shared_setting,
        )
    )


def rounded(value):
    """Return two digits, or the words for what was not measured."""
    return "not measured" if math.isnan(value) else f"{value:.0f}" if value >= 10.0 else digits(value, 2)


def draft_computes(kind):
    """Return in words which part of the computation of `reference` that of `draft` is."""
    draft, last = PLANS[kind][DRAFT.name], PLANS[kind][REFERENCE.name]
    counted = MEANINGS[kind].share, MEANINGS[kind].cells
    parts = zip((draft.share, draft.cells), (last.share, last.cells), counted, strict=True)
    return (
        " and ".join(f"{100.0 * one / other:.0f} % of the {what}" for one, other, what in parts if one < other)
        or "as much"
    )


def main():
    """Measure for two minutes, print all, write the table by kind."""
    found = [(scene, trial, measured(scene, trial)) for scene, trial in trials()]
    rows = []
    for kind in Kind:
        own = [(trial, samples) for _, trial, samples in found if trial.kind == kind]
        if own:
            ratios = [samples[-1].ms / samples[0].ms for _, samples in own]
            takes = " to ".join(dict.fromkeys(map(rounded, (min(ratios), max(ratios)))))
            levels = zip(*(samples for _, samples in own), strict=True)
            errors = [max((one.error for one in level if one.is_measured), default=math.nan) for level in levels]
            rows.append([str(kind), draft_computes(kind), f"{takes} ×", *map(rounded, errors), own[0][0].unit])
    head = ["computation", "draft computes", "reference takes", *LEVELS, "error in"]
    report(head, rows, APP / "hess_explorer/scenes/shared/levels.md")


if __name__ == "__main__":
    main()
