"""Cost and error of every level, for every kind of computation of every scene."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.framework.trial import Trial, bare
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.trade import Sample, enough, measure
from hess_mechanics.numerics.accuracy import LEVELS

__all__ = ["Row", "as_json", "as_text", "costliest", "names", "trade"]


@dataclass(frozen=True)
class Row:
    """One kind of computation of a scene: a sample for each level; the first level whose error is not seen."""

    scene: str
    kind: str
    unit: str
    samples: tuple[Sample, ...]
    enough: str

    @property
    def ratio(self) -> float:
        """How many times as long `reference` takes as `draft`."""
        return self.samples[-1].ms / self.samples[0].ms


def names() -> tuple[str, ...]:
    """The scenes that compute something at the level chosen."""
    return tuple(name for name, scene in scenes().items() if scene.origin is None and scene.trials)


def _example(scene: Scene[Any], trial: Trial[Any]) -> Any:
    """The first state that shows it: what a newcomer sees, or a preset."""
    defaults = scene.defaults()
    states = (bare(scene.of({**defaults, **values})) for values in ({}, *map(scene.example, scene.presets)))
    return next(state for state in states if trial.shown(state))


def _row(name: str, scene: Scene[Any], trial: Trial[Any], repeats: int) -> Row:
    state = _example(scene, trial)
    samples = measure(trial.kind, lambda plan: trial.run(state, plan), lambda *both: trial.error(state, *both), repeats)
    return Row(name, str(trial.kind), trial.unit, samples, enough(samples, trial.seen))


def trade(chosen: Sequence[str], repeats: int, progress: Callable[[str], None]) -> Iterator[Row]:
    """A row for each kind of computation of the chosen scenes, in their first state that shows it."""
    for name in chosen:
        scene = scenes()[name]
        for trial in scene.trials:
            progress(f"{name}: {trial.kind}")
            yield _row(name, scene, trial, repeats)


def costliest(rows: Sequence[Row], count: int) -> list[Row]:
    """Those that take longest at `reference`, the longest first."""
    return sorted(rows, key=lambda row: -row.samples[-1].ms)[:count]


def _round(value: float) -> str:
    return f"{value:.0f}" if value >= 10.0 else digits(value, 2)


def as_text(rows: Sequence[Row]) -> str:
    """A table in Markdown: milliseconds and error of each level, and how many times as long the last one takes."""
    head = ["scene", "computation", *LEVELS, "ratio", "enough", "error in"]
    lines = [head, ["---"] * len(head)]
    for row in rows:
        cells = (f"{_round(one.ms)} ms, {_round(one.error)}" for one in row.samples)
        lines.append([row.scene, row.kind, *cells, f"{_round(row.ratio)} ×", row.enough, row.unit])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def as_json(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """An entry for each level of each row."""
    return [{"scene": row.scene, "kind": row.kind, "level": one.level, "ms": one.ms, "error": one.error,
             "unit": row.unit, "complete": one.complete, "enough": row.enough}
            for row in rows for one in row.samples]
