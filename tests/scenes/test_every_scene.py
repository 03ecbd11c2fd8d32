"""Conformance of every registered scene, the words of the Suslov–Hess scene, and sessions without a browser."""

import json
import re
import time
from itertools import permutations
from math import inf, log10, nan, pi
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

from hess_explorer.assets import STATIC
from hess_explorer.compute.background import Background
from hess_explorer.compute.cache import CACHE
from hess_explorer.page import session
from hess_explorer.protocol.specs import ChoiceSpec, Formula, NumberSpec, Points, points_text
from hess_explorer.scenes.parts.orbits import precision
from hess_explorer.views import theme
from hess_explorer.views.layers import Axes
from hess_explorer.views.text import with_formulas
from hess_mechanics import f_max
from hess_mechanics.errors import ModelError
from support.board import (
    ACCURACY,
    HESS,
    SCENES,
    Board,
    Browser,
    contents,
    description,
    flat,
    other_sheets,
    plots_of,
    shown,
    variant,
)
from support.captions import texts_in
from support.thorough import examples, sample
from support.view import FEW, View

# A state with other axes than the default one.
OTHERS = {
    HESS.name: {"b3": -2.9, "h": 100.0, "f": -5.0, "phi0": -1.0, "I22": 1.3, "I23": -0.4},
    "free-suslov": {"w1": 6.0},
}
BALL = SCENES["chaplygin-ball"]
BESIDE = ("answer", "status", "summary", "notes", "derived", "signs", "windowed")
"""The texts beside the captions."""
OWN = [scene for scene in SCENES.values() if scene.origin is None]
"""The scenes that look into no other one."""
every_scene = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
own_scenes = pytest.mark.parametrize("scene", [*OWN, ACCURACY], ids=lambda scene: scene.name)
some_scenes = pytest.mark.parametrize(
    "scene",
    [*sample(OWN, 9), *sample((scene for scene in SCENES.values() if scene.origin), 3)],
    ids=lambda one: one.name,
)
# The scenes that look into another one are of one class: of each the first example and the last.
EXAMPLES = [
    (scene, preset)
    for scene in SCENES.values()
    for preset in (scene.presets if scene.origin is None else scene.presets[:: len(scene.presets) - 1])
]
SHOWN = sample(EXAMPLES, 20)
every_preset = pytest.mark.parametrize(
    "scene, preset", [pytest.param(*one, id=f"{one[0].name}: {one[1].name}") for one in SHOWN]
)


@pytest.fixture(autouse=True, scope="module")
def equations_are_compiled():
    """Compile the equations of forms of *Your own body*, which the page does in the background."""
    scene = SCENES["own-body"]
    for values in ({}, other_sheets(scene), *(preset.values for one, preset in SHOWN if one is scene)):
        state = scene.of({**scene.defaults(), **values})
        assert not state.is_compiled or not state.work.todo
        for task in state.work.todo:
            CACHE.get(task.function, *task.arguments)


def at_once(scene):
    """Return whether a scene shows something before its slow computations; cost studies without a motion do not."""
    return scene.origin is None or SCENES[scene.origin].has_motion


@every_scene
def test_the_defaults_are_admitted_unchanged(scene):
    assert scene.admit(scene.defaults()) == (scene.defaults(), [])
    for name, (low, high, step) in scene.limits(scene.defaults()).items():
        assert low < scene.defaults()[name] < high
        assert step > 0


@every_scene
def test_a_scene_has_a_legend_thumbnails_and_other_names_for_its_parameters_and_examples(scene):
    assert len({spec.name for spec in scene.specs}) == len(scene.specs)
    assert scene.handle in ("", *scene.essential) or "/" in scene.handle
    assert len({preset.name for preset in scene.presets}) == len(scene.presets) > 2
    legend = ElementTree.fromstring(scene.legend.strip())
    labels = {sign.label for picture in scene.views for sign in picture.legend}
    assert {"".join(item.itertext()) for item in legend} == labels
    picture = Path(scene.module).stem.replace("_", "-")
    assert all((STATIC / f"thumbnails/{picture}-{one}.jpg").exists() for one in ("light", "dark"))


@every_scene
def test_sliders_have_ends_wherever_the_others_are(scene):
    for spec in scene.specs:
        for value in (*spec.bounds, 0.0, 1e-320, -1e-320) if isinstance(spec, NumberSpec) else ():
            try:
                values = scene.admit({**scene.defaults(), spec.name: value})[0]
            except ModelError:
                continue
            for name, (low, high, step) in scene.limits(values).items():
                assert -inf < low < high < inf, (spec.name, value, name)
                assert step > 0


# Parts of the sentence over the pictures: the scene, the control, and the pictures that follow it.
FOLLOWS = [
    ("suslov-hess", "h", "body omega bifurcation circle"),
    ("kharlamova", "alpha", "body domain sphere"),
    ("rotation-number", "a", "line trace circle"),
    ("chaplygin-ball", "phi", "body omega sphere"),
    ("euler-poisson", "away", "section"),
    ("hess-leak", "phi0", "body leak andoyer sphere"),
    ("bridge", "h", "body heavy omega difference"),
    ("loxodrome", "energy", "body space angle height"),
]


@pytest.mark.parametrize("name, parameter, pictures", FOLLOWS)
def test_what_is_said_to_follow_does(name, parameter, pictures):
    scene = SCENES[name]
    values = scene.defaults()
    low, high, step = scene.limits(values).get(
        parameter, (*next((*spec.softbounds, spec.step) for spec in scene.specs if spec.name == parameter),)
    )
    near = values[parameter] + max(step, (high - low) / 20) * (1 if values[parameter] < (low + high) / 2 else -1)

    def columns(changes):
        state = scene.compute({**values, **changes}, pictures.split(), is_preview=True)
        return {
            view.name: {
                source: state.sources[source]
                for source in (*view.data(state), *(f"data-{track}" for track in view.tracks))
            }
            for view in scene.views
            if view.name in pictures.split()
        }

    before, after = columns({}), columns({parameter: near})
    assert set(before) == set(pictures.split()) <= set(scene.open_pictures)
    for picture in before:
        assert repr(before[picture]) != repr(after[picture]), picture


@own_scenes
def test_the_description_of_a_scene_has_all_that_the_browser_needs(scene):
    found = description(scene.name)
    assert (found["name"], found["title"]) == (scene.name, scene.title)
    assert [picture["name"] for picture in found["pictures"]] == list(scene.pictures)
    # A caption is the text of its picture's name: the other texts of the page have others.
    assert not set(scene.pictures) & {"status", "notes", "derived", "busy"}
    assert list(plots_of(scene.name)) == [one["name"] for one in found["pictures"] if one["kind"] == "plot"]
    controlled = [spec for spec in scene.specs if not isinstance(spec, Points)]
    assert found["drawn"] == (len(controlled) < len(scene.specs))
    # "Speed and accuracy" has no beads, and so no controls of a swarm.
    shown_here = [spec.name for spec in controlled if spec.group != "Swarm" or "swarm" in scene.tracks]
    assert [control["name"] for control in found["controls"]] == shown_here
    assert {spec.group for spec in controlled} <= {*found["groups"], "Swarm"}
    # Three or four sliders are open.
    assert 3 <= len(set(scene.essential)) == len(scene.essential) <= 4
    assert set(scene.essential) <= {spec.name for spec in controlled if not isinstance(spec, ChoiceSpec)}
    assert found["essential"] == list(scene.essential)
    assert scene.group
    assert "$" not in found["words"]
    assert not re.search(r"<script|\son\w+=|javascript:|https?://(?!www\.w3\.org)", found["words"] + found["legend"])


@own_scenes
def test_the_player_and_the_sphere_find_their_columns(scene):
    board, _ = shown(scene, scene.defaults())
    dots, angles = scene.dots, scene.angles
    assert description(scene.name)["dots"] == {source: list(columns) for source, columns in dots.items()}
    assert description(scene.name)["angles"] == list(angles)
    assert set(dots) <= set(board.sources)
    if not dots:
        return
    orbit = board.sources["data-orbit"]
    assert {"t", *angles, *(column for columns in dots.values() for column in columns)} <= set(orbit)
    assert len({len(column) for column in orbit.values()}) == 1
    for track in (track for one in description(scene.name)["pictures"] for track in one.get("tracks", ())):
        assert {"g1", "g2", "g3"} <= set(board.sources[track])


@every_scene
def test_every_formula_of_the_words_becomes_mathml(scene):
    formulas = re.findall(r"\$+.+?\$+", scene.words, re.DOTALL)
    html = with_formulas(scene.words)
    assert html.count("<math") == len(formulas) > (5 if scene.origin is None else 0)
    assert "$" not in html
    # The converter passes on unknown names as commands.
    assert not re.search(r"\\[A-Za-z]+", html)
    # Browsers know no other variant: bold and script letters must be letters of their own.
    assert set(re.findall(r'mathvariant="([^"]*)"', html)) <= {"normal"}


def with_known_axes(scene, state):
    """The pictures whose axes a state gives; others belong to what is computed later, and stay until then."""
    held = Axes((0.125, 0.25), (0.125, 0.25))
    axes = {view.name: view.ranges(state, held) for view in scene.views}
    return {name for name, found in axes.items() if held.x not in (found.x, found.y)}


def but(sources, names):
    """The sources with other names."""
    return {name: source for name, source in sources.items() if name not in names}


@every_preset
def test_a_state_looks_the_same_whatever_was_shown_before(scene, preset):
    values = {**scene.defaults(), **preset.values}
    found = scene.compute(values, scene.pictures, False)
    known = with_known_axes(scene, found)
    first, board = Board(scene), Board(scene)
    report = first.show(found)
    shown(scene, {**other_sheets(scene), **OTHERS.get(scene.origin or scene.name, {})}, board)
    before = dict(board.ranges)
    again = board.show(found)
    # Marks across a picture are as long as its axes, and labels find their places within them.
    held = [view for view in scene.views if view.kind == "plot" and view.name not in known]
    later = {source for view in held for source in view.data_in_axes(found, view.first_axes, found.sources)}
    assert contents(but(board.sources, later)) == contents(but(first.sources, later))
    for view in scene.views:
        if view.name in known:
            assert board.ranges.get(view.name) == first.ranges.get(view.name), view.name
        elif view.name in first.ranges:
            # Each axis that is not known stays.
            x0, x1, y0, y1 = before[view.name]
            axes = view.ranges(found, Axes((x0, x1), (y0, y1)))
            assert board.ranges[view.name] == [*axes.x, *axes.y], view.name
    assert len(known) > at_once(scene)
    if scene.origin is None:
        assert board.captions == first.captions
    assert again.quantities == report.quantities
    assert len(first.fresh) > 3 * at_once(scene)


@some_scenes
def test_axes_stay_while_a_slider_is_held_and_fit_when_it_is_let_go(scene):
    state, board, fitted = scene.compute(scene.defaults(), scene.pictures, False), Board(scene), []
    known = sorted(with_known_axes(scene, state))

    def axes():
        return [board.ranges.get(name) for name in known]

    board.show(state)
    first = axes()
    for values in (other_sheets(scene), {**scene.defaults(), **OTHERS.get(scene.origin or scene.name, {})}):
        before = dict(board.ranges)
        shown(scene, values, board, hold_axes=True)
        assert board.ranges == before
        shown(scene, values, board)
        fitted.append(axes())
        shown(scene, scene.defaults(), board)
        assert axes() == first
    # The sections of all examples of Euler–Poisson have the same axes, and its graphs follow what is known later; the
    # errors of some scenes have the same ones too.
    if (scene.origin is None and scene.name != "euler-poisson") or scene.origin == HESS.name:
        assert any(one != first for one in fitted)


@some_scenes
def test_a_stage_that_fails_shows_the_sentence_and_nothing_of_another_state(scene):
    board, _ = shown(scene, scene.defaults())
    before = contents(board.sources)
    shown(scene, other_sheets(scene), board)
    after = contents(board.sources)
    depends = {name for name in before if before[name] != after[name]}
    assert len(depends) > 3 or not at_once(scene)
    board.fail("No motion here.")
    left = contents(board.sources)
    for name in depends:
        # Neither do names of axes stay: a link to nothing shows none.
        assert name.endswith("-message") or not [
            x for values in left[name].values() for x in values if x not in ("", " ")
        ], name
    assert any("No motion here." in values for columns in left.values() for values in columns.values())
    assert set(board.captions.values()) == {"No motion here."}
    # And the next state is drawn whole.
    shown(scene, scene.defaults(), board)
    assert contents(board.sources) == before


def somewhere(spec):
    """Values that may be typed: from the slider, from everywhere, and close to either end, to 0 and to ±1."""
    if isinstance(spec, Points):
        # No windows: of what is computed for one, some lies outside.
        place = st.tuples(*(st.floats(low, high) for low, high in zip(spec.low, spec.high, strict=True)))
        return st.lists(place, max_size=3 if spec.most > 2 else 0).map(points_text)
    if isinstance(spec, Formula):
        return st.sampled_from(["", "g3 - 0.5*g1", "g1^4 + g2^4 - g3^2"])
    if not isinstance(spec, NumberSpec):
        return st.sampled_from(spec.options)
    distance = st.floats(-16.0, log10(spec.bounds[1] - spec.bounds[0])).map(lambda exponent: 10.0**exponent)
    return st.one_of(
        st.floats(*spec.softbounds),
        st.floats(spec.bounds[0], spec.bounds[1]),
        st.sampled_from([0.0, 1.0, spec.default, spec.bounds[0], spec.bounds[1]]),
        st.builds(lambda start, way: start + way, st.sampled_from([spec.bounds[0], -1.0, 0.0, 1.0]), distance),
        st.builds(lambda start, way: start - way, st.sampled_from([spec.bounds[1], 1.0, 0.0, -1.0]), distance),
    ).map(lambda value: min(max(value, spec.bounds[0]), spec.bounds[1]))


def visible_trials(scene):
    """All pictures, as mostly, or some of them."""
    return st.one_of(st.just(set(scene.pictures)), st.sets(st.sampled_from(scene.pictures)))


def assert_within_the_axes(board, visible_trials):
    """Assert that new lines and markers lie inside their picture, and are positive on logarithmic axes."""
    seen = set()
    for plot, figure in plots_of(board.scene.name).items():
        # A hidden plot keeps its axes, though a track that it shares may be sent for another picture.
        if plot not in visible_trials:
            continue
        x0, x1, y0, y1 = board.ranges[plot]
        for kind, x, y, name in figure.glyphs:
            # The line that marks a limit runs out of the picture on purpose.
            if kind not in ("Line", "Scatter") or name not in board.fresh or name.endswith("-limit"):
                continue
            seen.add(name)
            for column, low, high, logarithmic in zip((x, y), (x0, y0), (x1, y1), figure.logarithmic, strict=True):
                values, ends = np.asarray(flat(board.fresh[name][column])), np.array([low, high])
                if logarithmic:
                    assert np.all(values > 0.0), (name, column)
                    values, ends = np.log10(values), np.log10(ends)
                # Data arrive in single precision.
                room = 1e-6 * np.max(np.abs(ends))
                assert np.all((values >= ends[0] - room) & (values <= ends[1] + room)), (name, column)
    return seen


def assert_drawn(scene, values, seen, is_preview):
    """Any values are admitted, computed and drawn: finite numbers, in the pictures' axes, and words beside them."""
    board = Board(scene)
    admitted, _ = scene.admit(values)
    board.texts.clear()
    try:
        state = scene.compute(admitted, seen, is_preview)
        report = board.show(state)
    except ModelError as error:
        # Every state of the Suslov–Hess case can be computed.
        assert (scene.origin or scene.name) != HESS.name
        assert str(error).endswith(".")
        return
    assert_within_the_axes(board, seen)
    assert len(board.fresh) > 3 or set(seen) != set(scene.pictures)
    # While a slider is held an exponent waits, and then until it is computed.
    assert board.fresh or not seen or is_preview or report.todo
    said = dict(board.texts)
    assert re.fullmatch(r"[\d,]*", said.pop("signs", ""))
    # Names of the pictures that show a part.
    assert {*said.pop("windowed", "").split()} <= {*scene.pictures}
    for words in (*said.values(), report.status, report.summary, *report.quantities, *report.notes):
        assert re.search(r"\w", words)
        assert not re.search(r"\bnan\b|\binf\b", words, re.IGNORECASE), words
    assert set(seen) <= set(board.texts) <= {*scene.pictures, "answer", "signs", "windowed"}
    orbit = board.fresh.get("data-orbit")
    if orbit is not None:
        assert orbit["t"][0] == 0.0
        assert np.all(np.diff(orbit["t"]) >= 0.0)
        # A periodic orbit is followed once round, however long that takes.
        shown = state.base if scene.origin else state
        closed = admitted.get("periodic", "none") != "none" and shown.periodic_orbit.closed_orbit
        assert 0.0 < orbit["t"][-1] <= (closed.time if closed else admitted.get("span", inf)) * (1.0 + 1e-6)


def assert_some_drawn(scene, data, is_preview):
    values = {spec.name: data.draw(somewhere(spec), label=spec.name) for spec in scene.specs}
    assert_drawn(scene, values, data.draw(visible_trials(scene), label="in sight"), is_preview)


@given(data=st.data(), is_preview=st.booleans())
def test_every_admissible_state_is_computed_and_drawn_without_a_number_that_is_none(data, is_preview):
    assert_some_drawn(HESS, data, is_preview)


@pytest.mark.parametrize("scene", [scene for scene in OWN if scene is not HESS], ids=lambda scene: scene.name)
@settings(max_examples=examples(1))
@given(data=st.data(), is_preview=st.booleans())
def test_an_admissible_state_of_the_other_scenes_is_drawn_whole_or_refused_with_a_sentence(scene, data, is_preview):
    assert_some_drawn(scene, data, is_preview)


@settings(max_examples=examples(3))
@given(data=st.data())
def test_the_errors_of_every_admissible_state_are_computed_and_drawn_too(data):
    # Under a drag: without SciPy's methods, which take long.
    assert_some_drawn(ACCURACY, data, True)


EXTREME = [
    ("ball-section", {"h": 1e-3, "psi": 3.1}),
    ("ball-section", {"I11": 100.0, "I22": 0.01}),
    ("ball-section", {"count": 1.0, "drop": "the later half"}),
    ("rotation-number", {"h": 1e6, "f": 1.0}),
    ("rotation-number", {"a": 0.0, "f": 0.0}),
    ("suslov", {"b1": 1e3, "b2": 0.0, "b3": 0.0, "h": 1e3}),
    ("suslov", {"I11": 1e-3}),
    ("euler-poisson", {"m": 0.0, "f": 0.0}),
    ("euler-poisson", {"away": pi}),
]


@pytest.mark.parametrize("name, values", EXTREME, ids=str)
def test_extreme_values_are_shown(name, values):
    scene = SCENES[name]
    few = {key: value for key, value in FEW.items() if key in scene.defaults()}
    View(scene, {**few, "span": 5.0, **values}, seen=scene.open_pictures, noted=True).assert_finite()


REFUSED = [
    ("free-suslov", {"I13": 0.0, "I23": 0.0}, "I₁₃ = I₂₃ = 0.*Choose at least one of them nonzero"),
    ("free-suslov", {"w1": 0.0, "w2": 0.0}, "ω = 0: the body is at rest for ever.*Choose a nonzero ω1 or ω2"),
    ("free-suslov", {"I13": 0.25, "I23": 0.5, "w1": 2.0, "w2": -1.0}, "on the line of equilibria.*Move ω off"),
    ("free-suslov", {"k": -3.0}, "k = −3 would make I₁₁ = −1.25; a moment of inertia is positive. Choose a larger k"),
    ("free-suslov", {"I23": 1e-5}, r"γ turns too often.*\(about \d00000 radians.*choose a larger I13 or I23"),
    ("free-suslov", {"I23": 1e-320}, r"γ turns too often.*\(more than 1e308 radians"),
    ("free-suslov", {"w1": 1e-200, "w2": 1e-205}, "so small that the energy is 0.*choose a larger ω"),
    ("scattering", {"digits": 0.5, "k": -1.2, "I22": 0.5, "I23": 0.4}, "distance 0.316.*up to 0.28"),
    (
        "suslov",
        {"h": 0.895, "starts": "-2.356,1", "window": "-2.5,1;-2.2,2"},
        "In this window no motion has this energy: .* More → Remove clicks",
    ),
    ("quartic", {"b3": 0.0}, "Choose a nonzero b3"),
    ("chaplygin-ball", {"I13": 0.0, "I23": 0.0}, "I13 = I23 = 0: there is no line of equilibria"),
    (
        "euler-poisson",
        {"h": -20.0},
        "no motion with this h and f .* choose a larger h, a smaller .f., or More → Remove clicks",
    ),
    ("euler-poisson", {"f": 500.0}, "In this window no motion"),
    ("loxodrome", {"I2": 1.0, "I3": 1.0}, "which must differ"),
    ("loxodrome", {"m": -0.5}, "choose μ > 0"),
    ("hess-leak", {"I2": 2.0}, "I2 = 2 must lie between"),
    ("bridge", {"m": 4e-299}, "Choose μ.r. of at least"),
    ("bridge", {"h": 9.975, "f": 0.0}, "h = .μ..r., f = 0 is the separatrix"),
]


@pytest.mark.parametrize("name, values, words", REFUSED, ids=[f"{name}: {values}" for name, values, _ in REFUSED])
def test_what_cannot_be_is_refused_in_the_words_of_the_controls(name, values, words):
    scene = SCENES[name]
    with pytest.raises(ModelError, match=words) as refused:
        scene.compute({**scene.defaults(), **values}, scene.pictures, False)
    assert str(refused.value).endswith(".")


def test_at_the_separatrix_and_far_from_it_the_slow_methods_run_without_a_warning_too():
    for change in (
        {"h": 1.0, "f": 0.0},
        {"h": 1e6, "span": 0.01},
        {"I22": 0.1, "I23": 10.0, "span": 1.0},
        {"h": -1.0 + 1e-9, "f": 0.0},
        {"f": 1e4},
    ):
        values = {**ACCURACY.defaults(), **change}
        assert_drawn(ACCURACY, values, ACCURACY.pictures, False)


# --- Sessions: what the browser may send -------------------------------------------------------------


@pytest.mark.parametrize(
    "values, expected",
    [
        ({"h": -5.0}, {"h": -1.0 + 1e-9}),
        ({"h": nan}, {"h": 1.5}),
        ({"I22": 0.5, "I23": 900.0}, {"I22": 0.5, "I23": 50.0}),
        ({"h": 0.25, "f": 77.0}, {"h": 0.25, "f": f_max(0.25)}),
    ],
)
def test_a_number_from_the_wire_is_clamped_by_itself_with_a_note(values, expected):
    browser = Browser(HESS)
    browser.ask(values={**values, "phi0": -1.0})
    found = browser.session.values
    assert {name: found[name] for name in expected} == approx(expected, rel=1e-12)
    assert found["phi0"] == -1.0
    assert browser.texts["notes"] != ""
    for name, value in expected.items():
        assert browser.controls[name][0] == approx(value, rel=1e-12)


def test_f_returns_to_what_was_wanted_when_h_allows_it_again():
    browser = Browser(HESS)
    browser.ask(values={"f": 1.2})
    browser.ask(values={"h": -0.5})
    assert browser.session.values["f"] == approx(f_max(-0.5))
    assert "f was set to this limit" in browser.texts["notes"]
    browser.ask(values={"h": 1.5})
    assert browser.session.values["f"] == 1.2
    assert browser.texts["notes"] == ""


def test_a_value_that_is_refused_twice_is_corrected_twice():
    browser = Browser(HESS)
    for _ in range(2):
        browser.controls.clear()
        browser.ask(values={"f": 99.0})
        assert browser.session.values["f"] == approx(f_max(1.5))
        # The box says 99 now: only this message puts it right.
        assert browser.controls["f"][0] == approx(f_max(1.5))


def test_controls_wait_while_a_slider_is_held_and_follow_when_it_is_let_go():
    browser = Browser(HESS)
    browser.controls.clear()
    browser.ask(1, values={"h": 0.5}, held=True)
    assert browser.controls == {}
    browser.ask(2)
    assert browser.controls["h"][0] == 0.5
    assert browser.controls["f"][2] <= f_max(0.5)


def test_two_sessions_share_nothing_but_results():
    one, other = Browser(HESS), Browser(HESS)
    one.ask(values={"h": 0.3})
    other.ask()
    assert other.session.values == HESS.defaults()
    assert other.state["tree"]["sources"] == {}
    assert flat(other.data["bifurcation-here"]["h"]) == [1.5]


# --- Sessions: from one scene to another -------------------------------------------------------------


@pytest.fixture
def quick(monkeypatch):
    """Without the methods of SciPy."""
    monkeypatch.setattr(precision.mechanics, "scipy_takes_long", lambda *_: True)


def unfolded(scene, sources):
    """Return the contents of the sources, except those of pictures that start collapsed."""
    folded = {view.name for view in scene.views if view.button}
    return {name: columns for name, columns in contents(sources).items() if name.split("-")[0] not in folded}


@pytest.mark.usefixtures("quick")
def test_values_that_come_with_a_scene_count_in_it():
    browser = Browser(HESS, notes=["h was not a number and is 1.5 now."])
    browser.ask(1, scene=ACCURACY.name, values={"h": 0.25, "f": 77.0})
    assert browser.session.scene.name == ACCURACY.name
    assert browser.session.values["h"] == 0.25
    assert browser.session.values["f"] == approx(f_max(0.25))
    assert "f was set to this limit" in browser.texts["notes"]
    assert "not a number" not in browser.texts["notes"]


@pytest.mark.usefixtures("quick")
def test_a_scene_that_may_come_next_is_described_once_and_not_entered():
    browser = Browser(HESS)
    for requested in (1, 2):
        assert browser.ask(requested, near=ACCURACY.name)["scene"] == HESS.name
        assert browser.described == [HESS.name, ACCURACY.name]
    for near in ("nowhere", 7, None, [ACCURACY.name], HESS.name):
        browser.ask(3, near=near)
    assert browser.entered == [HESS.name]
    # The browser sees one description with an answer: that of the scene on show.
    other = next(name for name in SCENES if name not in (HESS.name, ACCURACY.name))
    browser.ask(4, scene=ACCURACY.name, near=other)
    assert browser.entered == browser.described == [HESS.name, ACCURACY.name]
    browser.ask(5, near=other)
    assert browser.described[-1] == other


@pytest.mark.usefixtures("quick")
def test_from_any_scene_to_any_other_and_back_everything_is_of_the_state():
    browser = Browser(HESS)
    others = sample((name for name in SCENES if name != HESS.name), 4)
    for requested, name in enumerate([name for other in others for name in (other, HESS.name)], 1):
        state = browser.ask(requested, scene=name)
        browser.assert_admissible()
        assert (state["scene"], state["answers"]) == (name, requested)
        scene = SCENES[name]
        assert {*scene.open_pictures, *BESIDE} == set(texts_in(state["tree"]))
        assert set(state["tree"]["controls"]) == {*(spec.name for spec in scene.specs), "preset"}
        # Wait for later results.
        while browser.state["progress"] is not None:
            time.sleep(0.02)
            browser.ask(requested)
        whole = Board(scene)
        shown(scene, browser.session.values, whole)
        assert unfolded(scene, browser.data) == unfolded(scene, whole.sources), name
        visible_trials = scene.open_pictures
        assert {picture: browser.screen.ranges.get(picture) for picture in visible_trials} == {
            picture: whole.ranges.get(picture) for picture in visible_trials
        }, name


# Scenes in which a number of the same name is the same number, read off the equations in their words.
SAME = {
    "h": [
        {"suslov-hess", "rotation-number"},
        {"euler-poisson", "hess-leak", "bridge"},
        {"chaplygin-ball", "singular-measures"},
        {"suslov", "orbit-diagram"},
        {"ball-section", "ball-diagram"},
    ],
    "f": [{"suslov-hess", "rotation-number"}, {"euler-poisson", "hess-leak", "bridge"}],
    "b3": [{"suslov-hess", "suslov", "orbit-diagram", "quartic", "ball-section", "ball-diagram"}],
    "theta": [{"scattering", "chaplygin-ball"}],
    "phi": [],
    "a": [],
}


@pytest.mark.parametrize("name", SAME)
def test_a_number_goes_along_to_another_scene_where_it_means_the_same_and_there_alone(name):
    own = [
        scene
        for scene in SCENES.values()
        if scene.origin is None and scene.name != "speed-accuracy" and name in scene.defaults()
    ]
    together = {frozenset(pair) for group in SAME[name] for pair in permutations(group, 2)}
    assert {one for pair in together for one in pair} <= {scene.name for scene in own}
    for before, scene in permutations(own, 2):
        specs = [next(spec for spec in one.specs if spec.name == name) for one in (before, scene)]
        low, high = (max(specs[0].bounds[0], specs[1].bounds[0]), min(specs[0].bounds[1], specs[1].bounds[1]))
        value = next(x for x in (-0.7, 0.7, 1.3) if low <= x <= high and x != specs[0].default)
        taken = scene.transfer(scene.defaults(), before, {**before.defaults(), name: value})
        goes = frozenset((before.name, scene.name)) in together
        assert taken == ({**scene.defaults(), name: value} if goes else scene.defaults()), (before.name, scene.name)


def test_a_number_that_is_not_possible_there_does_not_go_along():
    # b₃ = 0.7 of the general body is none of the Suslov–Hess case, where b₃ < 0.
    taken = HESS.transfer(HESS.defaults(), SCENES["suslov"], {**SCENES["suslov"].defaults(), "b3": 0.5, "I22": 1.0})
    assert taken == {**HESS.defaults(), "I22": 1.0}


LOOKS = {
    name: (theme.SHADES[shade][0] if shade else theme.INK, "[" in rest)
    for name, shade, rest in re.findall(
        r'^  (\w+): (?:look\("(\w+)"|\{)(.*)[)}],$',
        (STATIC / "pictures/looks.js").read_text(encoding="utf-8"),
        re.MULTILINE,
    )
}
"""Colour of a line, and whether it is dashed, by the name of its look on spheres."""


@pytest.mark.parametrize("scene", OWN, ids=lambda scene: scene.name)
def test_the_legend_has_only_what_is_drawn(scene):
    # A diagram is the same with its first orbits and with all, which take long.
    view = View(scene, {}, seen=scene.open_pictures, whole="diagram" not in scene.pictures)
    numbers = {int(one) for one in view.text["signs"].split(",")}
    shown = {(sign.label, sign.kind, sign.style) for i, sign in enumerate(scene.signs) if i in numbers}
    assert shown
    drawn, absent = set(), set()
    for picture in (one for one in scene.views if one.name in scene.open_pictures):
        for layer in getattr(picture, "layers", ()):
            columns = view.data.get(picture.source_of(layer), {})
            signs = {(sign.label, sign.kind, sign.style) for sign in layer.legend if sign.least is None}
            (drawn if len(columns.get(layer.columns[0], ())) else absent).update(signs)
    assert drawn & shown
    assert not (absent - drawn) & shown
    assert len({sign[1:] for sign in shown}) == len(shown), "two things with one sign"
    # Spheres draw by looks, not by layers: each line of their legend has the colour and the dashes of one of them.
    for picture in (one for one in scene.views if one.kind == "sphere" and one.name in scene.open_pictures):
        own = view.data[picture.name]
        words = {*re.findall(r"\w+", repr(own)), *picture.describe()["tracks"].values()}
        strokes = {stroke for name, stroke in LOOKS.items() if name in words}
        strokes |= {(theme.INK, True)} if len(own.get("section", ())) else set()
        for sign in (one for one in picture.legend if one.kind == "line"):
            colour = re.search(r"#\w{6}", sign.style)
            assert colour and (colour[0], "dashed" in sign.style) in strokes, (picture.name, sign)


# --- Sessions: whatever is raised ---------------------------------------------------------------------


@pytest.mark.parametrize(
    "source, given, target",
    [
        ("quartic", {"h": -53.9}, "suslov-hess"),
        ("suslov-hess", {"I22": 0.001}, "kharlamova"),
        ("suslov-hess", {"span": 77552.0}, "suslov"),
    ],
)
def test_values_of_another_scene_are_admitted_by_the_bounds_of_this_one(source, given, target):
    browser = Browser(SCENES[source])
    browser.ask(1, values=given, hidden=list(browser.scene.pictures))
    assert given.items() <= dict(browser.session.values).items()
    assert browser.ask(2, scene=target)["scene"] == target
    browser.assert_admissible()
    assert browser.texts["status"] != session.FAILURE


def test_what_is_computed_behind_an_answer_begins_when_that_is_made(monkeypatch):
    made, real = [], Background.follow

    def follow(background, tasks):
        wanted = list(tasks)
        made.append((browser.state["number"], len(wanted)))
        real(background, wanted)

    scene = SCENES["suslov-hess"]
    browser = Browser(scene)
    monkeypatch.setattr(Background, "follow", follow)
    for asked in range(1, 4):
        state = browser.ask(asked, values={"I22": 0.9 + 0.01 * asked})
        assert state["progress"] is not None
        assert made[-1][0] == state["number"]
        assert made[-1][1] > 0
    assert len(made) == 3
    browser.session.background.stop()


@pytest.mark.parametrize(
    "where, opening",
    [
        *((where, True) for where in ("limits", "compute", "idle_values")),
        *((where, False) for where in ("admit", "adjustments", "limits", "compute")),
    ],
)
def test_whatever_is_raised_the_page_gets_a_state(where, opening, caplog):
    broken = [opening]

    def fail(*arguments):
        if broken[0]:
            raise ZeroDivisionError("secret")
        return getattr(BALL, where)(*arguments)

    browser = Browser(variant(BALL, **{where: fail}))
    if not opening:
        broken[0] = True
        choice = next(spec for spec in BALL.specs if not isinstance(spec, NumberSpec))
        other = next(option for option in choice.options if option != choice.default)
        assert browser.ask(1, values={choice.name: other, "h": 7.0})["answers"] == 1
    assert browser.texts["status"] == session.FAILURE
    # With the state that reproduces it.
    assert "ZeroDivisionError" in caplog.text
    assert opening or "h=7.0" in caplog.text
    assert "secret" not in json.dumps(browser.texts)
    broken[0] = False
    state = browser.ask(2, values={"h": 8.0})
    assert (state["answers"], browser.session.values["h"]) == (2, 8.0)
    assert browser.texts["status"] != session.FAILURE
    # Background pieces would continue while the process ends.
    browser.session.background.stop()
