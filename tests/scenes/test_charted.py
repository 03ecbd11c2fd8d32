"""The chart of a scene: its cells, its window, its parameters and its words."""

import json

import numpy as np
import pytest
from pytest import approx

from hess_explorer.commands.serve import _chart_link
from hess_explorer.compute.cells import Outcome
from hess_explorer.export.picture_data import complete, picture_data
from hess_explorer.page.requested import RequestedState
from hess_explorer.protocol.specs import decode, encode
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.cells import COARSE
from hess_explorer.scenes.framework.chart_cells import STORED
from hess_mechanics.catalogue import find
from hess_mechanics.dynamics.cells import centres
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import STANDARD
from support.board import SCENES

TORI = SCENES["rotation-number"]
SUSLOV = SCENES["suslov"]
OWN = {"chart": "trace", "chart_x": "h", "chart_y": "f", "a": 0.3}


def state_of(scene=TORI, *, known=True, **values):
    """Return the state with the chart in sight, complete if `known`."""
    admitted, _ = scene.admit({**scene.defaults(), **(OWN if scene is TORI else {}), **values})
    if known:
        return complete(scene, admitted, ["chart"], lambda state: state.chart_part.caption)[0]
    return scene.compute(admitted, ["chart"], False)


def trace(**torus):
    """Return |t| of a torus, as the catalogue computes it alone."""
    of = find("circle-map")
    return of.number("trace").read(of.compute(torus, STANDARD))


def cells_of(state):
    """Return the centres (m,) and (n,) of the cells, and their values (n, m)."""
    (x0, y0), (x1, y1) = state.chart_part.window
    values = state.chart_part.cells.cells
    n, m = values.shape
    return centres(x0, x1, m), centres(y0, y1, n), values


@pytest.mark.parametrize("window", ["", "0.5,-0.5;1.5,0.25"])
def test_each_cell_is_the_number_at_its_centre(window):
    state = state_of(chart_window=window)
    x, y, values = cells_of(state)
    if window:
        assert state.chart_part.window == ((0.5, -0.5), (1.5, 0.25))
    for i, j in [(0, 0), (40, 150), (108, 108), (107, 10), (215, 215)]:
        try:
            expected = trace(a=0.3, h=x[j], f=y[i])
        except ModelError:
            expected = np.nan
        assert values[i, j] == approx(expected, rel=1e-9, nan_ok=True)


def test_the_own_number_and_coarse_cells_come_first_and_are_the_middle_ones_of_the_finer():
    state = state_of(known=False, a=0.35)
    assert state.chart_part.cells is None
    for task in state.work.todo[:9]:
        state.work.need(task)
    coarse = state_of(known=False, a=0.35).chart_part.cells.cells
    assert ", 0 rows known" in state_of(known=False, a=0.35).chart_part.caption.numbers
    assert state_of(known=False, a=0.35).chart_part.own is not None
    fine = state_of(a=0.35).chart_part.cells.cells
    step = COARSE**3
    middle = step // 2
    assert len(fine) == 8 * step
    assert coarse[middle::step, middle::step] == approx(fine[middle::step, middle::step], rel=1e-9, nan_ok=True)
    assert np.array_equal(coarse[:step, :step], np.full((step, step), coarse[0, 0]), equal_nan=True)


def test_a_click_or_drag_sets_both_parameters_and_computes_no_cell_again():
    state = state_of()
    moved = TORI.admit({**TORI.defaults(), **OWN, **state.chart_part.choose(1.25, 0.5)})[0]
    assert (moved["h"], moved["f"]) == (1.25, 0.5)
    other = TORI.compute(moved, ["chart"], True)
    assert "rows known" not in other.chart_part.caption.numbers
    assert other.chart_part.here() == [(1.25, 0.5)]
    # Another slider shows what is known, and plans nothing while it is held.
    held = TORI.compute({**moved, "a": 0.77}, ["chart"], True)
    assert (held.chart_part.cells, held.work.todo) == (None, [])


@pytest.mark.parametrize("scene", [one for one in SCENES.values() if one.chart_set], ids=lambda one: one.name)
def test_the_menu_offers_every_number_of_the_computations_and_each_exists(scene):
    charts = scene.chart_set
    offered = {name for one in charts.sources for name in find(one.key).numbers}
    assert {*charts.numbers} == offered
    assert {*next(spec for spec in scene.specs if spec.name == "chart").options} == offered
    for option, (charted, number) in charts.numbers.items():
        find(charted.key).number(number)
        assert charted.values(scene.of({**scene.defaults(), "chart": option}))


def test_the_start_of_a_motion_in_a_section_is_a_place_of_the_chart():
    state = state_of(SUSLOV, known=False)
    assert [side.symbol for side in state.chart_part.axes] == ["ψ", "δ"]
    assert state.chart_part.here() == [(1.0, 1.0)]
    assert state.chart_part.choose(0.5, 1.5) == {"starts": "0.5,1.5"}
    with pytest.raises(ModelError, match="No motion crosses the section"):
        state.chart_part.choose(-2.5, 1.0)


def test_a_box_zooms_in_and_other_sides_show_the_whole_range_again():
    state = state_of(known=False)
    assert state.chart_part.box_window((1.0, 0.5, 0.0, -0.5)) == {"chart_window": "0,-0.5;1,0.5"}
    requested = RequestedState(TORI, {**TORI.defaults(), "chart_window": "0,-0.5;1,0.5"}, [])
    requested.change({"chart_x": "a"})
    assert requested.values["chart_window"] == ""


def test_the_caption_says_the_own_number_and_why_cells_have_none():
    state = state_of(h=1.5, f=0.6)
    own = trace(a=0.3, h=1.5, f=0.6)
    caption = state.chart_part.caption
    assert caption.verdict == f"|t| = {own:.4g}."
    assert "216 × 216 cells; colours from" in caption.numbers
    assert state.chart_part.about(-0.9, 2.9) == "h = −0.9, f = 2.9: No number: no such motion."
    assert state.chart_part.about(1.5, 0.6).startswith("h = 1.5, f = 0.6: |t| = 2.")


def test_an_error_belongs_to_its_number():
    values = {"chart": "lyapunov", "long": 20.0, "chart_window": "1,1;1.1,1.1"}
    state = state_of(SUSLOV, known=False, **values)
    own = next(task for task in state.work.todo if task.arguments[2] == 1)
    state.work.need(own)
    state = state_of(SUSLOV, known=False, **values)
    found = find("lyapunov suslov").compute(SUSLOV.chart_set.numbers["lyapunov"][0].arguments(state), STANDARD)
    assert state.chart_part.own[:2, 0] == approx([found.value, found.spread], rel=1e-9)
    assert " ± " in state.chart_part.caption.verdict


def test_a_periodic_number_and_categories_have_their_own_colours():
    turns = state_of(chart="rotation-number")
    assert turns.chart_part.cells.ends == (-0.5, 0.5)
    assert np.nanmax(np.abs(turns.sources["chart-turns"]["image"][0])) <= 0.5
    assert not turns.sources["chart-numbers"]
    kinds = state_of(chart="locked", h=1.5, f=0.6)
    (name,) = (name for name, columns in kinds.sources.items() if "image" in columns)
    assert name.startswith("chart-kinds")
    values = kinds.sources[name]["image"][0]
    assert {*values[np.isfinite(values)]} == {0.0, 1.0}
    assert kinds.chart_part.caption.verdict == "locked = two limit cycles."


def test_a_folded_chart_computes_nothing():
    state = TORI.compute(TORI.defaults(), TORI.open_pictures, False)
    assert "chart_part" not in vars(state)


def test_the_file_of_a_chart_holds_its_numbers():
    data = picture_data(encode(TORI.name, {**TORI.defaults(), **OWN}), "chart")
    _, _, values = cells_of(state_of())
    columns = data.columns["chart-numbers"]
    assert np.array_equal(columns["image"][0], values, equal_nan=True)
    assert (columns["low"][0], columns["high"][0]) == approx(np.nanquantile(values, (0.01, 0.99)))


def stored(**changed):
    """Return a Dataset like that of a stored sweep of |t| over (h, f)."""
    xarray = pytest.importorskip("xarray")
    h, f = np.linspace(0.0, 2.0, 5), np.linspace(-0.5, 0.5, 3)
    values = np.add.outer(h, 10.0 * f)
    fixed = {one.name: one.default for one in find("circle-map").parameters if one.name not in "hf"} | {"a": 0.3}
    facts = {"computation": "circle-map", "accuracy": "precise", "parameters": json.dumps({**fixed, **changed})}
    status = np.full(values.shape, Outcome.OK, np.uint8)
    return xarray.Dataset({"trace": (("h", "f"), values), "status": (("h", "f"), status)}, {"h": h, "f": f}, facts)


def test_a_stored_sweep_is_shown_in_the_chart_of_a_scene():
    try:
        values, _ = decode(_chart_link(stored()), TORI.specs)
        state = TORI.compute(values, ["chart"], False)
        assert (values["accuracy"], values["a"]) == ("precise", 0.3)
        assert state.chart_part.window == ((-0.25, -0.75), (2.25, 0.75))
        assert np.array_equal(state.sources["chart-numbers"]["image"][0], stored().trace.values.T)
        assert state.chart_part.about(2.0, 0.5).endswith("|t| = 7.")
        # Another state has no such sweep.
        assert TORI.of({**values, "a": 0.31}).chart_part.key not in STORED
    finally:
        STORED.clear()
    for found, said in (
        (stored().isel(f=0), "this sweep over h: open it in Python"),
        (stored().isel(h=[0, 1, 3]), "over two parameters LOW:HIGH:COUNT"),
        (stored(phi=0.3), "No scene shows circle-map"),
    ):
        with pytest.raises(ModelError, match=said):
            _chart_link(found)


def test_derived_scenes_share_the_choices_of_the_chart_but_not_its_picture():
    scene = scenes()["rotation-number-accuracy"]
    assert "chart" not in scene.pictures
    assert {"chart", "chart_x", "chart_window"} <= {spec.name for spec in scene.specs}
