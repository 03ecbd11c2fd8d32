"""Tables of cost and error: no computation is lost, and one table says what a level costs."""

from dataclasses import replace
from math import nan

import pytest

from hess_explorer.__main__ import main
from hess_explorer.scenes import scenes
from hess_mechanics import LEVELS
from hess_mechanics.dynamics.trade import LevelCost
from hess_mechanics.numerics.accuracy import PLANS, Kind, levels_table
from manual.benchmark_trade import (
    Row,
    _draft_computes,
    _example,
    by_kind,
    line_of,
    names,
)
from support.measured import line
from support.mechanics import ROOT


@pytest.mark.parametrize("name", names())
def test_every_computation_of_every_scene_is_shown_by_some_state(name):
    """No preset of the Suslov problem showed the indicator, and the table lost all rows."""
    scene = scenes()[name]
    for trial in scene.trials:
        assert trial.shown(_example(scene, trial)), trial.kind


def row(scene, kind, times=(1.0, 2.0, 3.0, 4.0), errors=(0.1, 0.01, 0.001, 0.0)):
    return Row(
        scene,
        kind,
        "pixels",
        tuple(LevelCost(name, ms, error, True) for name, ms, error in zip(LEVELS, times, errors, strict=True)),
        "standard",
    )


def test_a_row_without_a_measurement_says_so():
    """The section of the Suslov problem had error 0 at every level, of 0 orbits."""
    rows = [row("a", "section", errors=(nan,) * 4), row("b", "section", errors=(nan, 0.2, 0.1, 0.0))]
    assert line_of(rows[0]).split(" | ")[2:6] == [f"{ms} ms, not measured" for ms in (1, 2, 3, 4)]
    assert by_kind(rows).splitlines()[-1].split(" | ")[3:7] == ["not measured", "0.2", "0.1", "0"]


def measured_by_kind(file):
    """The cells of the table of all kinds in a file, by kind."""
    text = (ROOT / file).read_text(encoding="utf-8")
    table = text.partition("<!-- measured by tests/manual/benchmark_trade.py -->")[2].partition("<!-- end")[0]
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line[:1] == "|"]
    return {cells[0]: cells[1:] for cells in lines[2:] if cells[0] in set(Kind)}


def test_the_tables_are_one_with_what_a_draft_computes():
    found = measured_by_kind("app/hess_explorer/scenes/shared/levels.md")
    assert found.keys() == {str(trial.kind) for name in names() for trial in scenes()[name].trials}
    for kind, (computed, *_) in found.items():
        assert computed == _draft_computes(Kind(kind))


def test_the_page_and_the_command_print_the_table_of_the_levels(capsys):
    head, *rows = levels_table()
    for name in ("suslov-accuracy", "suslov-hess-accuracy"):
        printed = scenes()[name].words.replace("\\|", "|")
        assert all(line(row) in printed for row in (head, *rows))
    assert main(["levels"]) == 0
    said = capsys.readouterr().out
    assert all(cell in said for row in rows for cell in row[:-1])


def test_a_level_that_changes_nothing_says_so():
    for kind, *cells, _ in levels_table()[1:]:
        own = list(PLANS[kind].values())
        for before, after, cell in zip(own, own[1:], cells[1:], strict=False):
            same = replace(before, level=after.level) == after
            assert same == cell.startswith("as "), (kind, cell)
