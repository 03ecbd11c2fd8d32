"""Computations started by each user action: only those the visible pictures need, and none twice."""

import dataclasses
import functools
import gc
import threading
import types
from collections import Counter
from itertools import combinations

import pytest

from hess_explorer.compute.cache import ResultCache
from hess_explorer.compute.pool import POOL
from hess_explorer.scenes import suslov_hess
from hess_explorer.server import warm
from hess_mechanics.errors import InvalidParameter, WorkLimit
from support.board import ACCURACY, HESS, SCENES, Board, Browser, contents, other_sheets, plots_of, variant
from support.thorough import sample

some_scenes = pytest.mark.parametrize("scene", sample(SCENES.values(), 5), ids=lambda scene: scene.name)

# By the names of the functions.
MAP, CYCLES, TRACK = "circle_map", "cycles", "track"
BOUNDARY, CURVE, GRID = "tongue_boundary", "curve", "rotation_number_window"
LEVELS, OTHERS, GROWTH = "measure_levels", "measure_scipy", "growth"
MOTION = {MAP, CYCLES, TRACK}
ZONES = {BOUNDARY, CURVE, GRID}
STUDY = {LEVELS, OTHERS, GROWTH}
# SciPy's methods take as long as the span is.
SHORT = {**ACCURACY.defaults(), "span": 1.0}


class Recorder(ResultCache):
    """Cache that records the functions its thread calls, and their arguments.

    What an earlier test has left in the background may still ask here: its calls are none of this test's.
    """

    def __init__(self):
        super().__init__(2**28)
        self.calls = []
        self._own = threading.get_ident()

    def get(self, function, *arguments):
        @functools.wraps(function)
        def recorded(*given):
            if threading.get_ident() == self._own:
                self.calls.append((function.__name__, given))
            return function(*given)

        return super().get(recorded, *arguments)

    def take(self):
        """Return the names of the functions called since the last call; assert that none was called twice."""
        names = Counter(name for name, _ in self.calls)
        self.calls.clear()
        assert set(names.values()) <= {1}, names
        return set(names)

    def levels(self):
        """The accuracy of each call since the last time, by function."""
        found = {name: level.name for name, given in self.calls for level in given if hasattr(level, "promise")}
        self.calls.clear()
        return found


@pytest.fixture(autouse=True)
def nothing_later(monkeypatch):
    """Disable background work: the tests count immediate computations, and threads outlive their test.

    Disable proofs as well: a state that waits for its proof looks up all its results in the cache again.
    """
    monkeypatch.setattr(POOL, "add_task", lambda task: None)
    monkeypatch.setattr(suslov_hess, "has_flint", lambda: False)


@pytest.fixture
def cache(monkeypatch):
    """Replace the process's cache by an empty one."""
    recorder = Recorder()
    monkeypatch.setattr("hess_explorer.scenes.framework.work.CACHE", recorder)
    return recorder


def needed(seen):
    """Return the computations that the Hess scene needs at a state with two cycles."""
    return (
        {MAP}
        | ({TRACK} if seen - {"chart", "spread"} else set())
        | ({CYCLES} if seen & {"omega", "sphere", "surface"} else set())
        | (ZONES if "bifurcation" in seen else set())
    )


def compute(scene, values, seen=None, is_preview=False):
    return scene.compute(scene.admit(values)[0], scene.pictures if seen is None else seen, is_preview)


# --- The Suslov–Hess case ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "change, expected",
    [
        ({"h": 1.45}, MOTION),
        ({"phi0": 0.51}, {TRACK}),
        ({"accuracy": "draft"}, MOTION | {BOUNDARY, GRID}),
        # Grid and boundary depend on a alone, and the circle map does not know b.
        ({"b3": -1.01}, {CYCLES, TRACK}),
        ({"I22": 0.97}, MOTION | {BOUNDARY, GRID}),
        # The same a: another body, the same maps.
        ({"I22": 1.92, "I23": 0.56}, {CYCLES, TRACK}),
        # Beyond the slider the diagram shows more.
        ({"h": 5.0}, MOTION | {CURVE, GRID}),
        # No cycles here.
        ({"h": 0.2, "f": 0.5}, {MAP, TRACK}),
        ({"h": 1.0, "f": 0.0}, {TRACK}),
    ],
    ids=lambda part: None if isinstance(part, set) else str(part),
)
def test_a_change_computes_what_depends_on_it_and_going_back_nothing(cache, change, expected):
    browser = Browser(HESS)
    for number, (asked, wanted) in enumerate((({}, None), (change, expected), (change, set())), 1):
        browser.ask(number, values=asked)
        assert cache.take() == wanted or wanted is None
    assert browser.session.values == {**HESS.defaults(), **change}
    browser.ask(4, reset=True)
    assert browser.session.values == HESS.defaults()
    assert cache.take() == set()


def test_a_request_that_changes_nothing_does_not_even_ask_the_cache(cache):
    browser = Browser(HESS)
    browser.ask(1, hidden=[])
    before = cache.hits, cache.misses
    browser.ask(2)
    browser.ask(3, values={"h": 1.5})
    browser.ask(4, picked=["sphere", 0.0, 0.0])
    browser.ask(5, hidden=[])
    assert (cache.hits, cache.misses) == before


@some_scenes
def test_the_mouse_chooses_nothing_in_a_hidden_picture(scene, cache):
    browser = Browser(scene)
    for name in [view.name for view in scene.views if view.on_click or view.on_box or view.on_hover]:
        for preset in scene.presets[:2]:
            browser.ask(1, hidden=[name], preset=preset.name)
        values = dict(browser.session.values)
        for picked in ([name, 0.3, 0.2], [name, 0.3, 0.2, 0.4, 0.5]):
            browser.ask(2, hidden=[name], picked=picked)
            assert browser.session.values == values
        browser.ask(3, hidden=[name], hover=[name, 0.3, 0.2])
        assert not browser.texts.get(f"hover-{name}")
        # Where pieces are still to come each answer asks for them: not so the stage by itself.
        stage, asked = browser.session.stage, (cache.hits, cache.misses)
        assert not any((stage.pick(name, 0.3, 0.2), stage.box(name, (0.3, 0.2, 0.4, 0.5)), stage.hover(name, 0.3, 0.2)))
        assert (cache.hits, cache.misses) == asked


def test_a_click_that_chooses_what_is_impossible_is_answered_by_a_note():
    def impossible(state, x, y):
        raise InvalidParameter("There is no motion through this place. Choose another one.")

    views = [dataclasses.replace(view, on_click=impossible) if view.on_click else view for view in HESS.views]
    browser = Browser(variant(HESS, views=tuple(views)))
    values = dict(browser.session.values)
    name = next(view.name for view in views if view.on_click)
    browser.ask(1, picked=[name, 0.3, 0.2])
    assert browser.texts["notes"] == "There is no motion through this place. Choose another one."
    assert browser.session.values == values
    browser.ask(2, values={"h": 1.25})
    assert browser.texts["notes"] == ""


@pytest.mark.parametrize("chosen", ["draft", "standard", "precise", "reference"])
def test_a_drag_is_computed_as_a_draft_and_again_as_chosen_when_it_ends(cache, chosen):
    browser = Browser(HESS, {**HESS.defaults(), "accuracy": chosen})
    cache.take()
    for requested, h in enumerate((1.4, 1.3, 1.2), 1):
        browser.ask(requested, values={"h": h}, held=True)
        # Results that depend on a alone stay, except for the finest levels, which would slow down a drag of a.
        finest = requested == 1 and chosen in ("precise", "reference")
        zones = dict.fromkeys((BOUNDARY, GRID), "standard") if finest else {}
        assert cache.levels() == {**dict.fromkeys(MOTION, "draft"), **zones}
        assert browser.texts["status"].startswith("draft: orbit")
    # The slider is still held, but does not move.
    browser.ask(4, held=True)
    assert cache.levels() == {}
    browser.ask(5)
    assert cache.levels() == ({} if chosen == "draft" else dict.fromkeys(MOTION, chosen))
    assert browser.texts["status"].startswith(f"{chosen}: orbit")
    assert browser.session.values["accuracy"] == chosen
    assert browser.controls["accuracy"] == chosen


# No request depends on two other pictures: none, each alone, all but one, and all.
SIZES = (0, 1, len(HESS.pictures) - 1, len(HESS.pictures))
SUBSETS = [set(some) for size in SIZES for some in combinations(HESS.pictures, size)]


@pytest.mark.parametrize("seen", SUBSETS, ids=lambda some: "+".join(sorted(some)) or "none")
def test_pictures_that_come_into_sight_compute_just_what_they_need(cache, seen):
    browser = Browser(HESS)
    hidden = [name for name in HESS.pictures if name not in seen]
    browser.ask(1, hidden=hidden)
    cache.take()
    browser.ask(2, hidden=hidden, values={"I23": 0.3})
    # The curve is the same for every body.
    assert cache.take() == needed(seen) - {CURVE}
    browser.ask(3, hidden=[])
    assert cache.take() == needed(set(HESS.pictures)) - needed(seen) - {CURVE}
    browser.ask(4, hidden=hidden)
    browser.ask(5, hidden=[])
    assert cache.take() == set()


def test_what_a_change_leaves_as_it_was_is_not_sent_again(cache):
    browser = Browser(HESS)
    browser.ask(1, values={"span": 41.0})
    for requested, values in enumerate(({"phi0": 0.6}, {"f": 0.61}, {"b3": -1.2}), 2):
        sent = browser.ask(requested, values=values)["tree"]["sources"]
        zones = {f"bifurcation-{layer}" for layer in ("locked", "boundary", "curve", "forbidden")}
        assert not zones & set(sent)
        assert ("data-stable" in sent) == ("phi0" not in values)
        assert ("bifurcation-here" in sent) == ("f" in values)


# --- Pictures in sight look as if all were ---------------------------------------------------------------


# Another state for each scene, and more of those of the scenes whose pictures are computed one by one.
STATES = [(scene, other_sheets(scene)) for scene in SCENES.values()] + [
    (scene, {**scene.defaults(), **change, "span": 9.0})
    for scene in (HESS, ACCURACY)
    for change in ({"h": 1.25, "phi0": -1.0, "I23": 0.35}, {"h": 1.0, "f": 0.0}, {"h": 30.0})
]
every_other = pytest.mark.parametrize("scene, values", sample(STATES, 5), ids=lambda one: getattr(one, "name", ""))


@every_other
def test_what_was_hidden_is_of_the_present_state_when_it_is_seen_again(scene, values):
    whole, board = Board(scene), Board(scene)
    report = whole.show(compute(scene, values))
    expected = contents(whole.sources)
    every = set(scene.pictures)
    for seen in (set(), *({name} for name in every), *(every - {name} for name in every)):
        board.show(compute(scene, scene.defaults()))
        hidden = board.show(compute(scene, values, seen))
        assert hidden.status
        # Results derived from unused results are not computed either.
        assert set(hidden.quantities) <= set(report.quantities)
        # A picture alone in sight is drawn as among the others.
        if len(seen) == 1:
            (name,) = seen
            alone = contents(board.sources)
            own = plots_of(scene.name)[name].sources if name in plots_of(scene.name) else {name}
            assert {one: alone[one] for one in own} == {one: expected[one] for one in own}
            assert board.captions[name] == whole.captions[name]
        board.show(compute(scene, values))
        assert contents(board.sources) == expected, seen
        assert board.captions == whole.captions


# --- Speed and accuracy ------------------------------------------------------------------------------------


def test_while_dragging_scipy_never_runs_and_when_let_go_it_does(cache):
    browser = Browser(ACCURACY, SHORT)
    cache.take()
    for requested, h in enumerate((1.4, 1.3, 1.2), 1):
        browser.ask(requested, values={"h": h}, held=True)
        assert cache.take() == {LEVELS, GROWTH}
        assert len(browser.data["precision-Taylor"]["x"]) == 4
        assert len(browser.data["precision-DOP853"]["x"]) == 0
    browser.ask(4)
    assert cache.take() == {OTHERS}
    assert len(browser.data["precision-DOP853"]["x"]) == len(browser.data["precision-LSODA"]["x"]) == 3


# --- Through a session -------------------------------------------------------------------------------------


def test_from_scene_to_scene_each_computes_its_own_and_the_way_back_is_free(cache):
    browser = Browser(HESS, SHORT)
    assert cache.take() == MOTION | ZONES
    # A new scene is computed whole, whatever was hidden in the old one.
    browser.ask(1, hidden=["omega", "sphere", "circle"], scene=ACCURACY.name)
    assert cache.take() == STUDY
    browser.ask(2, scene=HESS.name)
    browser.ask(3, scene=ACCURACY.name)
    assert cache.take() == set()
    browser.ask(4, hidden=["growth", "drift", "pixels"], values={"f": 0.5})
    assert cache.take() == {LEVELS, OTHERS}
    browser.ask(5, scene=HESS.name)
    assert cache.take() == MOTION


def test_warming_up_computes_the_first_state_of_every_scene_but_one_that_refuses_it(cache, monkeypatch, caplog):
    def refuse(*_):
        raise WorkLimit("Too many steps: choose a shorter time span.")

    tasks, (first, other, last) = [], sample(SCENES.values(), 3)[:3]
    chosen = (first, variant(other, compute=refuse), last)
    monkeypatch.setattr(warm, "scenes", lambda: {scene.name: scene for scene in chosen})
    # One request of each kind that can wait; its duration does not matter here.
    later = types.SimpleNamespace(get=lambda function, *arguments: tasks.append((function, arguments)), lookups=0)
    monkeypatch.setattr(warm, "CACHE", later)
    for name in ("QUIET_SECONDS", "PAGE_SECONDS"):
        monkeypatch.setattr(warm, name, 0.0)
    warm.warm()
    assert gc.isenabled()
    assert caplog.messages == [f"{other.name}: Too many steps: choose a shorter time span."]
    cache.calls.clear()
    for scene in (first, last):
        Browser(scene)
        assert cache.take() == set(), scene.name
        left = {task.function for task in Board(scene).show(compute(scene, scene.defaults())).todo}
        assert left <= {function for function, _ in tasks}, scene.name
    assert tasks


def test_warming_up_stands_back_while_the_page_is_used(cache, monkeypatch):
    pauses = []

    def sleep(seconds):
        pauses.append(seconds)
        if len(pauses) < 5:
            cache.get(int, f"{len(pauses)}")

    monkeypatch.setattr(warm, "CACHE", cache)
    monkeypatch.setattr(warm.time, "sleep", sleep)
    warm._wait_until_quiet()
    assert len(pauses) == 5
