"""Background computation: order, cancellation, stored places, and the session's part."""

import threading
import time
from collections import Counter
from dataclasses import replace

import pytest

from hess_explorer.compute import background
from hess_explorer.compute.background import Background
from hess_explorer.compute.cache import ResultCache, Task
from hess_explorer.page.connection import Connection
from hess_explorer.page.session import Session
from hess_explorer.protocol.specs import points_of, points_text
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.framework.work import Work
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.parallel import THREADS
from hess_mechanics.numerics.patience import check_limit
from support.asynchronous import wait_until
from support.board import SCENES, Browser, contents
from support.wire import read_frame

# With the exponent in sight, which is folded at first.
EP = SCENES["euler-poisson"]
EP = replace(EP, views=tuple(replace(view, button="") if view.name == "exponent" else view for view in EP.views))
STARTS = next(spec for spec in EP.specs if spec.name == "starts")
SMALL = {**EP.defaults(), "orbits": 12.0, "count": 20.0, "long": 5.0, "span": 1.0, "indicator": "nothing"}
"""1 piece for the start, 3 for the orbits, 12 for the line, 1 for the exponent; 4 that are computed twice."""
PIECES = 21


class Gate(ResultCache):
    """Cache whose background computations wait until they are released."""

    def __init__(self):
        super().__init__(2**26)
        self.calls = Counter()
        self.open = threading.Semaphore(0)
        self.begun = threading.Semaphore(0)

    def get(self, function, *arguments):
        if threading.current_thread().name.startswith("background"):
            self.calls[function, arguments] += 1
            self.begun.release()
            assert self.open.acquire(timeout=60.0)
        return super().get(function, *arguments)

    def let(self, count=1):
        self.open.release(count)


@pytest.fixture
def gate(monkeypatch):
    """Return a closed gate in place of the process's cache."""
    closed, begun = Gate(), []
    for module in ("compute.background", "scenes.framework.work"):
        monkeypatch.setattr(f"hess_explorer.{module}.CACHE", closed)
    init = Background.__init__

    def recorded(work):
        begun.append(work)
        init(work)

    monkeypatch.setattr(Background, "__init__", recorded)
    yield closed
    # Whatever still waits must not hold up the pool.
    for work in begun:
        work.stop()
    closed.let(10_000)
    wait_until(lambda: all(work.backlog == 0 for work in begun))


@pytest.fixture
def free_gate(gate):
    """Return an open gate in place of the process's cache."""
    gate.let(10_000)
    return gate


def square(n):
    return n * n


def refuse(n):
    raise InvalidParameter(f"{n} is refused: choose another.")


def fail(n):
    raise ZeroDivisionError(n)


def tasks(count, first=0):
    return [Task(square, first + n) for n in range(count)]


# ---- The background ---------------------------------------------------------------------------------------------


def run_out(work):
    wait_until(lambda: work.backlog == 0)


def numbers(gate):
    """The arguments of all pieces that have begun."""
    return sorted(arguments[0] for _, arguments in gate.calls)


def test_pieces_are_begun_in_their_order_on_all_threads_and_added_ones_follow(gate):
    work = Background()
    work.follow(tasks(5))
    for _ in range(THREADS):
        assert gate.begun.acquire(timeout=60.0)
    time.sleep(0.02)
    assert numbers(gate) == [*range(THREADS)]
    work.add(tasks(1, first=5))
    assert work.backlog == 6
    gate.let()
    wait_until(lambda: len(gate.calls) == THREADS + 1)
    assert numbers(gate) == [*range(THREADS + 1)]
    gate.let(5)
    run_out(work)
    # Also when nothing is under way any more.
    work.add(tasks(1, first=9))
    gate.let()
    wait_until(lambda: gate.peek(square, 9) == 81)


def test_refinements_are_begun_when_nothing_else_is_missing(free_gate):
    work = Work()
    work.newest_results([tasks(2, first=7)], last=True)
    work.need(Task(square, 3), preview=None)
    assert work.todo == tasks(1, first=3)
    free_gate.get(square, 3)
    again = Work()
    again.newest_results([tasks(2, first=7)], last=True)
    again.need(Task(square, 3), preview=None)
    assert again.todo == tasks(2, first=7)


def test_a_newer_choice_ends_the_older_work(gate):
    work = Background()
    work.follow(tasks(20))
    wait_until(lambda: len(gate.calls) == THREADS)
    work.follow(tasks(3, first=100))
    # No other old work is started.
    gate.let(THREADS + 3)
    run_out(work)
    time.sleep(0.02)
    assert numbers(gate) == [*range(THREADS), 100, 101, 102]


@pytest.fixture
def endless():
    """Return an endless piece of work, with events for its start and its end."""
    begun, ended = threading.Event(), threading.Event()

    def goes_on(n):
        begun.set()
        try:
            while n:
                check_limit()
                time.sleep(0.001)
        finally:
            ended.set()

    return Task(goes_on, 1), begun, ended


def test_a_piece_that_has_begun_ends_when_nobody_wants_it_any_more(endless):
    piece, begun, ended = endless
    work = Background()
    work.follow([piece])
    assert begun.wait(60.0)
    # It goes on for a choice that wants it too, and for the next.
    for _ in range(2):
        work.follow([piece])
        time.sleep(0.05)
        assert not ended.is_set()
    work.follow(tasks(1, first=60))
    assert ended.wait(60.0)
    run_out(work)
    assert work.error == ""


def test_a_piece_that_takes_too_long_ends_with_a_sentence(endless, monkeypatch):
    monkeypatch.setattr(background, "SECONDS", 0.02)
    piece, _, ended = endless
    work = Background()
    work.follow([piece])
    assert ended.wait(60.0)
    run_out(work)
    assert work.error.startswith("A part of this state takes more than 0.02 s to compute")
    assert "choose a shorter time span" in work.error


def test_what_is_refused_or_fails_ends_the_work_with_a_sentence(free_gate, caplog):
    work = Background()
    for function, sentence in (
        (refuse, "7 is refused: choose another."),
        (fail, "A part of this state could not be computed. Please report the link."),
    ):
        work.follow([*tasks(2), Task(function, 7), *tasks(20_000, first=10)])
        run_out(work)
        assert work.error == sentence
        # The other thread has not done much meanwhile.
        assert len(free_gate.calls) < 10_000
        # The threads live on.
        work.follow(tasks(4, first=900))
        run_out(work)
        assert work.error == ""
    assert "ZeroDivisionError" in caplog.text


def test_sessions_take_turns(gate):
    long, short = Background(), Background()
    long.follow(tasks(40))
    wait_until(lambda: len(gate.calls) == THREADS)
    short.follow(tasks(2, first=1000))
    gate.let(12)
    run_out(short)
    assert long.backlog > 20


# ---- Points in the link -----------------------------------------------------------------------------------------


def test_of_too_many_places_the_last_ones_are_kept():
    pairs = [(0.01 * n, 0.0) for n in range(20)]
    assert points_of(STARTS.read(points_text(pairs))[0]) == pairs[-12:]


def test_a_window_is_two_corners_in_their_order():
    for window, admitted in (("1,0;0,0.5", "0,0;1,0.5"), ("0,0", ""), ("0,0;0,0.5", ""), ("0,0.5;1,0.5", "")):
        values, _ = EP.admit({**EP.defaults(), "window": window})
        assert values["window"] == admitted
        assert EP.admit(values) == (values, [])


# ---- A session --------------------------------------------------------------------------------------------------


def drawn_points(browser):
    return sum(len(browser.data[f"section-{layer}"].get("x", ())) for layer in ("first", "second", "own"))


def completed(browser, requested=1):
    """Return the state after all missing results have been computed."""
    run_out(browser.session.background)
    browser.ask(requested)
    return browser.ask(requested)


def test_what_is_found_may_ask_for_more(free_gate):
    """The set of volume-contracting motions is computed only after the ends of the orbits are known."""
    scene = SCENES["suslov"]
    browser = Browser(scene, {**scene.defaults(), "colours": "basins", "orbits": 2.0, "count": 20.0, "long": 50.0})
    browser.ask(1)
    wait_until(lambda: completed(browser, 2)["progress"] is None)
    assert "being computed" not in browser.texts["section"]
    assert "mean div = " in browser.texts["section"]
    assert browser.session.background.backlog == 0


def test_a_section_fills_while_one_asks_for_more(gate):
    browser = Browser(EP, SMALL)
    assert browser.state["progress"] == [0, PIECES]
    # Where no piece has come nothing is drawn again.
    assert not any(browser.ask(1)["tree"].values())
    seen = []
    for done in range(1, 6):
        gate.let()
        wait_until(lambda done=done: browser.session.background.backlog == PIECES - done)
        state = browser.ask(1)
        assert state["progress"] == [done, PIECES]
        assert state["answers"] == 1
        seen.append(drawn_points(browser))
    assert seen == sorted(seen)
    assert seen[-1] > seen[0]
    gate.let(1000)
    state = completed(browser)
    assert state["progress"] is None
    assert browser.texts["notes"] == ""
    assert set(gate.calls.values()) == {1}
    # The same at once, where all is known already.
    other = Browser(EP, SMALL)
    assert other.state["progress"] is None
    sections = [{name: one.data[name] for name in one.data if name.startswith("section")} for one in (other, browser)]
    assert contents(sections[0]) == contents(sections[1])
    assert other.texts["section"] == browser.texts["section"]


def test_stop_leaves_what_is_drawn_says_how_much_and_begins_nothing_again(gate):
    browser = Browser(EP, SMALL)
    wait_until(lambda: len(gate.calls) == THREADS)
    gate.let(3)
    wait_until(lambda: browser.session.background.backlog == PIECES - 3)
    browser.ask(1, hidden=["sphere", "split", "chart"])
    browser.ask(1, stop=True)
    gate.let(1000)
    assert completed(browser)["progress"] is None
    assert browser.texts["notes"] == f"Stopped: 3 of {PIECES} parts are drawn. Change a value to compute again."
    begun = len(gate.calls)
    # Nor does a picture that comes into sight.
    assert browser.ask(2, hidden=["split", "chart"])["progress"] is None
    assert browser.session.background.backlog == 0
    assert len(gate.calls) == begun
    # Stop cancels the work of the new value, which is on its way.
    browser.ask(3, values={"h": 45.0})
    browser.ask(4, values={"h": 46.0}, stop=True)
    run_out(browser.session.background)
    assert 46.0 not in {arguments[1] for _, arguments in gate.calls if len(arguments) > 3}
    assert browser.texts["notes"].startswith("Stopped: ")
    # Another state is computed as ever, and the note goes.
    browser.ask(5, values={"orbits": 8.0})
    completed(browser, 5)
    assert browser.texts["notes"] == ""


def test_a_new_state_is_computed_further_only_when_its_page_asks_again(monkeypatch):
    states, started = [], []
    start = Session.start_tasks
    monkeypatch.setattr(Session, "start_tasks", lambda session: (started.append(len(states)), start(session)))

    def tell(frame):
        states.append(read_frame(frame)[0]["state"])

    connection = Connection("scene=rotation-number&v=1", (), tell, None)
    for asked, a in enumerate((0.7, 0.8), start=1):
        connection.receive({"requested": asked, "values": {"a": a}})
        wait_until(lambda count=asked + 1: len(states) == count)
    assert states[-1]["progress"] is not None
    # A page at rest asks for the same state once more.
    while states[-1]["progress"] is not None:
        count = len(states)
        connection.receive({"requested": 2, "values": {}})
        wait_until(lambda count=count: len(states) > count)
    wait_until(lambda: len(started) == len(states) - 3)
    assert started[0] == 4
    connection.end()


def test_the_last_piece_may_come_while_its_picture_is_drawn(gate):
    """A piece that arrives between the computation and the check for pending work is neither lost nor "stopped"."""
    browser = Browser(EP, {**SMALL, "orbits": 0.0})
    total = browser.state["progress"][1]
    gate.let(total - 1)
    wait_until(lambda: browser.session.background.backlog == 1)
    show, drawn = browser.session.stage.show, []

    def slowly(result, hold_axes):
        drawn.append(result)
        gate.let(1000)
        run_out(browser.session.background)
        return show(result, hold_axes)

    browser.session.stage.show = slowly
    browser.ask(1)
    browser.session.stage.show = show
    assert len(drawn) == 1
    assert browser.texts["notes"] == ""
    completed(browser)
    assert browser.texts["notes"] == ""
    assert "λ = " in browser.texts["exponent"]


def test_a_box_beyond_the_section_is_cut_and_one_that_is_none_is_not_taken(free_gate):
    browser = Browser(EP, SMALL)
    browser.ask(1, picked=["section", 0.0, 0.5, 1.0, 7.0])
    assert points_of(browser.session.values["window"]) == [(0.0, 0.5), (1.0, 1.0)]
    before = dict(browser.session.values)
    for corners in ([0.0, 0.5, 0.0, 0.7], [0.0, 2.0, 1.0, 3.0], ["0", 0, 1, 1]):
        browser.ask(2, picked=["section", *corners])
        assert browser.session.values == before
    for picture in ("sphere", "nobody"):
        browser.ask(3, picked=[picture, 0.0, 0.1, 1.0, 0.9])
        browser.ask(3, picked=[picture, 0.0, 0.1])
        assert browser.session.values == before


def test_tasks_of_a_state_end_before_another_one_is_computed(free_gate, monkeypatch):
    browser, order = Browser(EP, SMALL), []
    stop, compute = browser.session.background.stop, Scene.compute
    monkeypatch.setattr(browser.session.background, "stop", lambda: (order.append("stop"), stop()))
    monkeypatch.setattr(Scene, "compute", lambda *state: (order.append("compute"), compute(*state))[1])
    browser.ask(1, values={"h": 2.25})
    assert order == ["stop", "compute"]
    # A request for what has been found meanwhile ends nothing.
    browser.ask(2, values={})
    assert order.count("stop") == 1
