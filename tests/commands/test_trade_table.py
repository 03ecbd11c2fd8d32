"""Tables of cost and error: no computation is lost, and one table says what a level costs."""

import pytest

from hess_explorer.__main__ import main
from hess_explorer.scenes import scenes
from hess_mechanics.numerics.accuracy import Kind, levels_table
from manual.benchmark_trade import APP, draft_computes, example, trials
from support.measured import line


@pytest.mark.parametrize("name", dict.fromkeys(scene.name for scene, _ in trials()))
def test_every_computation_of_every_scene_is_shown_by_some_state(name):
    """No preset of the Suslov problem showed the indicator, and the table lost all rows."""
    for trial in scenes()[name].trials:
        assert trial.condition(example(scenes()[name], trial)), trial.kind


def test_the_table_of_kinds_has_them_all_with_what_a_draft_computes():
    text = (APP / "hess_explorer/scenes/shared/levels.md").read_text(encoding="utf-8")
    table = text.partition("<!-- measured")[2].partition("<!-- end")[0]
    kinds = {trial.kind for _, trial in trials()}
    assert all(f"\n| {kind} | {draft_computes(kind)} | " in table for kind in kinds)
    assert sum(f"\n| {kind} | " in table for kind in Kind) == len(kinds)


def test_the_page_and_the_command_print_the_table_of_the_levels(capsys):
    head, *rows = levels_table()
    printed = scenes()["suslov-accuracy"].words.replace("\\|", "|")
    assert all(line(row) in printed for row in (head, *rows))
    assert main(["levels"]) == 0
    said = capsys.readouterr().out
    assert all(cell in said for row in rows for cell in row[:-1])
