"""MEGNO under the points of the four sections: its caption, and in what order cells come."""

import numpy as np
import pytest
from pytest import approx

from hess_explorer.compute.cache import CACHE
from hess_explorer.scenes import scenes
from hess_mechanics.dynamics.megno_map import row_of_cells
from support.view import View, values_of

SCENES = scenes()
EXAMPLES = {"suslov": "Strange", "ball-section": "A sea", "quartic": "Mixed: in", "euler-poisson": "The barrier"}
FEW = {"accuracy": "draft", "indicator": "MEGNO"}


def shown(name, **values):
    """The section of a scene alone."""
    more = {"orbits": 2.0, "count": 20.0} if "orbits" in SCENES[name].defaults() else {"count": 30.0}
    return View(SCENES[name], {**values, **FEW, **more}, seen=("section",))


@pytest.mark.chaotic
@pytest.mark.parametrize("name", EXAMPLES)
def test_cells_that_are_called_chaotic_have_a_large_megno_and_are_counted(name):
    view = shown(name, **values_of(SCENES[name], EXAMPLES[name]))
    kinds, values = view.result.megno.kinds, view.result.megno._cells[0][:, 0]
    assert kinds.shape == (12, 18)
    image = np.asarray(view.data["section-megno"]["image"][0]).reshape(12, 18)
    assert image == approx(kinds + 1.5)
    regular, chaotic, t, shrinks = view.numbers(
        "section", "# % of the cells regular, # % chaotic. MEGNO after t = #; volume shrinks in about # %."
    )
    assert t == approx(view.result.megno.time, rel=0.01)
    there = kinds[kinds >= 0.0]
    assert chaotic == approx(100.0 * np.mean(there % 2.0 == 1.0), abs=0.51)
    assert regular + chaotic == approx(100.0, abs=1.1)
    assert shrinks == approx(100.0 * np.mean(there >= 2.0), abs=0.51)
    # Ȳ comes to λt/2 on chaotic motions, to 2 on regular ones.
    assert np.nanmedian(values[kinds % 2.0 == 1.0]) > 5.0
    assert np.nanmedian(values[kinds == 0.0]) < 3.0


def test_coarse_cells_come_first_and_a_slider_that_is_held_has_none():
    # Cells that nobody has asked for before.
    values = {**FEW, "count": 30.0, "h": 0.8123}
    tasks, captions = [], []
    while True:
        view = View(SCENES["quartic"], values, seen=("section",), whole=False)
        captions.append(view.text["section"])
        mine = [task for task in view.report.todo if task.function is row_of_cells]
        if not mine:
            break
        tasks.append(mine[0].arguments[2])
        CACHE.get(mine[0].function, *mine[0].arguments)
    # Four rows of coarse cells, then twelve.
    assert tasks == [(6, 4)] * 4 + [(18, 12)] * 12
    assert ["Some cells are still coarse." in one for one in captions] == [False] * 4 + [True] * 12 + [False]
    assert "of the cells regular" in captions[-1]
    held = View(SCENES["quartic"], values, is_preview=True, seen=("section",))
    assert "section-megno" not in held.data or not len(held.data["section-megno"]["image"])


def test_basins_are_shown_in_place_of_it():
    view = shown("suslov", colours="basins", long=300.0)
    assert view.result.megno.kinds is None
    assert "MEGNO" not in view.text["section"]
    assert view.result.basins.attractors is not None
