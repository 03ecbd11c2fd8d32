"""A scene for a system of one's own: Hénon–Heiles, for λ = 0 two oscillators, whose motion is known."""

import re
from dataclasses import replace

import numpy as np
from pytest import approx, mark, raises

import hess_explorer as hess
from hess_explorer.__main__ import main
from hess_explorer.scenes import add
from hess_mechanics import System
from hess_mechanics.errors import InvalidParameter
from support.henon_heiles import SYSTEM
from support.mechanics import scipy_crossings
from support.refusals import refused
from support.view import View

# One system, so that its equations are compiled once.
HENON = replace(SYSTEM, example=(0.0, 0.1, 0.3, 0.2))
SCENE = hess.scene(
    HENON, ["x px", "t x", "x y px", "exponent"], sliders={"lam": (0.0, 2.0)}, presets={"Two oscillators": {"lam": 0}}
)


def test_its_pictures_show_the_motion_with_the_values_of_its_sliders():
    state = hess.state(SCENE, p_lam=0.0, y_x=0.5, y_px=0.0, y_y=0.1, y_py=0.0, span=2.0)
    for picture, name in (("x-px", "orbit"), ("t-x", "orbit")):
        layer = state.data(picture).layer(name)
        t = np.asarray(layer["t"])
        assert t[-1] == 2.0
        assert np.asarray(layer["x"]) == approx(0.5 * np.cos(t), abs=1e-6)
    vector = np.column_stack([0.5 * np.cos(t), 0.1 * np.cos(t), -0.5 * np.sin(t)])
    sphere = state.data("sphere").layer("orbit")
    found = np.column_stack([np.asarray(sphere[name]) for name in ("g1", "g2", "g3")])
    assert found == approx(vector / np.linalg.norm(vector, axis=1, keepdims=True), abs=1e-6)


def test_its_section_has_the_crossings_of_the_motion_and_a_click_chooses_one():
    scene = hess.scene(HENON, ["section px y at x = 0"])
    given = {"p_lam": 0.0, "y_x": 1.0, "y_px": 0.0, "y_y": 0.0, "y_py": 0.7, "count": 20.0}
    crossings = hess.state(scene, **given).data("section").layer("own")
    # Where x = cos t grows through 0 its momentum is 1, and y = 0.7 sin t is lowest.
    assert len(crossings["x"]) > 5
    assert np.asarray(crossings["x"]) == approx(1.0, abs=1e-6)
    assert np.asarray(crossings["y"]) == approx(-0.7, abs=1e-6)
    (view,) = scene.views
    state = scene.of(scene.defaults())
    # py by the energy of the example, 0.14/2 − 0.001/3.
    expected = {"y_x": 0.0, "y_y": 0.1, "y_px": 0.2, "y_py": 0.3}
    assert view.on_click(state, 0.2, 0.1) == approx(expected)
    # There the motion crosses the other way.
    assert view.on_click(state, -0.2, 0.1) == {}


def test_a_section_at_a_level_has_periodic_orbits_and_their_branch():
    """On the straight orbits y = ±x/√3 py² is a quarter of p²: py = √(E/2) at the origin."""
    sliders = {"E": (0.01, 0.16), "y": (-0.5, 0.6)}
    scene = hess.scene(HENON, ["section y py at x = 0 on E", "branch", "x y"], sliders=sliders)
    assert scene.defaults()["place"] == "0.1,0.2"
    # A motion that does not begin on the section has the place of its first crossing, here found by SciPy.
    other = hess.scene(HENON, ["section x px at y = 0 on E"]).defaults()["place"]
    first = scipy_crossings(lambda y: HENON.field(y, [1.0]), HENON.example[0], lambda y: y[1], 20.0, 1)[1][0]
    assert [*map(float, other.split(","))] == approx(first[[0, 2]], abs=1e-6)
    chosen = {"i_E": 0.08, "place": "0,0.21", "over": "E", "upwards": "py"}
    state = hess.state(scene, **chosen, periodic="period 1", low=0.075, high=0.085)
    assert np.asarray(state.data("branch").layer("shown")["y"]) == approx(np.sqrt(0.04), abs=1e-9)
    branch = state.data("branch").layer("branch-neither")
    levels = np.asarray(branch["x"])
    assert (levels.min(), levels.max()) == approx((0.075, 0.085))
    assert np.asarray(branch["y"]) == approx(np.sqrt(levels / 2), abs=1e-8)
    # A click starts the motion at a place of the section, at its level.
    (section, *_) = scene.views
    assert section.x(state_of := scene.of(scene.defaults())) == (-0.5, 0.6)
    assert section.on_click(state_of, 0.1, 0.0) == {"place": "0.1,0"}
    x, y, px, py = scene.of({**scene.defaults(), **chosen}).start
    assert (x, y, py) == (0.0, 0.0, 0.21)
    assert px == approx(np.sqrt(0.16 - py**2))


def test_a_motion_that_escapes_is_drawn_to_its_end_and_other_pictures_stay():
    scene = hess.scene(HENON, ["section y py at x = 0 on E", "x y", "exponent"])
    shown = View(scene, {"i_E": 0.2, "place": "0.5,0.3", "indicator": "MEGNO", "accuracy": "draft", "count": 10.0})
    (reason,) = shown.report.notes
    end = float(re.search(r"at t = ([\d.]+): the motion escapes", reason)[1])
    assert end - 1.5 < shown.data["data-orbit"]["t"][-1] < end
    assert "No exponent" in shown.text["exponent"]
    assert (shown.result.megno.kinds == 4.0).any()
    assert np.isfinite(shown.data["section-ended"]["x"]).all()


def test_it_has_a_slider_for_each_parameter_and_initial_value_and_the_presets_asked_for():
    ranges = {spec.name: (spec.default, spec.softbounds) for spec in SCENE.specs if spec.name[1] == "_"}
    assert ranges == {
        "p_lam": (1.0, (0.0, 2.0)),
        "y_x": (0.0, (-1.0, 1.0)),
        "y_y": (0.1, (-0.9, 1.1)),
        "y_px": (0.3, (-0.7, 1.3)),
        "y_py": (0.2, (-0.8, 1.2)),
    }
    assert [(one.name, one.values) for one in SCENE.presets] == [("Two oscillators", {"p_lam": 0.0})]
    assert hess.scene(HENON, ["x y", "chart"]).pictures == ("x-y", "chart")


@mark.parametrize(
    ("given", "message"),
    [
        ({"pictures": ["x q"]}, "has no 'q'. Names allowed here: x, y, px, py"),
        ({"pictures": ["x"]}, "'x' is not a picture. Write the names of two"),
        ({"pictures": ["x y", "x y"]}, "a picture occurs twice"),
        ({"pictures": ["section at x = a"]}, "not a valid expression"),
        ({"pictures": ["section on F"]}, "has no 'F'. Names allowed here: E"),
        ({"pictures": ["branch"]}, "a branch needs a section"),
        ({"sliders": {"lam": (1, 1)}}, "needs increasing ends"),
        ({"pictures": "x y"}, "pictures = 'x y' is not a sequence"),
        ({"presets": ["A"]}, "is not a mapping"),
    ],
)
def test_what_the_system_does_not_have_is_refused(given, message):
    with raises(InvalidParameter, match=message):
        hess.scene(HENON, **given)


def simple(name, variable):
    return System(name, lambda y, p: (-y[0],), variables=[variable])


test_a_system_of_which_there_is_no_scene_is_refused = refused(
    (lambda: hess.scene(simple("one", "x"), ["section"]), "no section with two coordinates"),
    (lambda: hess.state(HENON), r"There is no scene .*: choose one of suslov-hess"),
    (lambda: hess.scene(simple("s", "x-y")), "'x-y' cannot be used in a link"),
    (lambda: add(hess.scene(simple("suslov", "x")), "mine.py"), "same name"),
)


@mark.parametrize(("text", "message"), [("SCENE = 3", "is 3, not a scene"), ("x =", "invalid syntax")])
def test_a_file_without_a_scene_is_refused(tmp_path, capsys, text, message):
    path = tmp_path / "mine.py"
    path.write_text(text)
    assert main(["serve", "--no-browser", "--scene", str(path)]) == 2
    said = capsys.readouterr().err
    assert "mine.py" in said and message in said
