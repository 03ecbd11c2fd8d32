"""Random links, messages and command lines are answered without an exception, a warning, a log entry or NaN.

A run has the same few examples each time.  Others, a hundred times as many:
`python -m pytest -n0 tests/server/test_fuzz.py --examples 100 --hypothesis-seed 1`.
"""

import logging
import re
import shlex
from importlib import import_module
from threading import Event
from urllib.parse import urlencode

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from hess_explorer.__main__ import main
from hess_explorer.commands import COMMANDS
from hess_explorer.commands.compute import command_of
from hess_explorer.commands.output import PATIENCE
from hess_explorer.compute.budget import time_budget
from hess_explorer.page.requested import scene_and_values
from hess_explorer.protocol.specs import CLIENT, ChoiceSpec, Formula, Link, NumberSpec, points_text
from hess_explorer.scenes import scenes
from hess_mechanics.catalogue import catalogue
from support.asynchronous import wait_until
from support.board import Browser
from support.thorough import examples

SCENES = st.sampled_from([*scenes().values()])
GARBAGE = st.text(max_size=9) | st.sampled_from(
    ["nan", "1e400", "1e-320", "0x10", "٣", "9" * 400, "<script>alert(1)</script>", "%00", "../..", "1/0", "9**9**9"]
)
ODD = st.sampled_from([None, True, 3, -1e300, float("nan"), "x", [], {}, [[]], [None] * 5, {"a": []}])
SLOW = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow, HealthCheck.data_too_large]


def mostly(usual, seldom=GARBAGE):
    return st.integers(0, 19).flatmap(lambda n: seldom if n == 19 else usual)


def value(spec):
    """Return a strategy for a value of a parameter as a link has it."""
    if isinstance(spec, NumberSpec):
        return mostly((st.floats(*spec.softbounds) | st.floats(*spec.bounds)).map(repr))
    if isinstance(spec, ChoiceSpec):
        return mostly(st.sampled_from(spec.options))
    if isinstance(spec, Formula):
        return mostly(st.sampled_from(["", "g1", "0.5*g1^2 - g3", "g1^9"]))
    return mostly(st.lists(st.tuples(*map(st.floats, spec.low, spec.high)), max_size=spec.most + 2).map(points_text))


def values(specs):
    return st.fixed_dictionaries({}, optional={spec.name: value(spec) for spec in specs})


@st.composite
def links(draw):
    scene = draw(SCENES)
    example = draw(st.sampled_from([{}, *map(scene.example, scene.presets)]))
    given = {**example, **draw(values(scene.specs)), **draw(mostly(st.just({}), values(CLIENT)))}
    return draw(mostly(st.just(urlencode({"v": "1", "scene": scene.name, **given}))))


def message(scene):
    """Return a strategy for a message to a session that shows this scene."""
    number, truth = mostly(st.floats(-4.0, 4.0), ODD), st.booleans()
    picture, name = (st.sampled_from([*some, "nobody", 3]) for some in (scene.pictures, scenes()))
    parts = {
        "values": values(scene.specs),
        "picked": st.builds(lambda one, places: [one, *places], picture, st.lists(number, min_size=1, max_size=4)),
        "hover": st.tuples(picture, number, number),
        "scene": name,
        "near": name,
        "restore": links(),
        "preset": st.sampled_from([preset.name for preset in scene.presets]),
        "expressions": st.dictionaries(st.sampled_from([spec.name for spec in scene.specs]), GARBAGE, max_size=2),
        "step": st.tuples(name, st.integers(-2, 9), truth),
        "hidden": st.lists(st.sampled_from(scene.pictures), unique=True),
        **dict.fromkeys(("held", "reset", "clear", "stop"), truth),
    }
    several = st.lists(st.sampled_from([*parts]), unique=True, min_size=1, max_size=3)
    return several.flatmap(lambda names: st.fixed_dictionaries({one: mostly(parts[one], ODD) for one in names}))


def assert_answered(browser):
    browser.assert_admissible()
    for key, text in browser.texts.items():
        assert "could not be computed" not in text, key
        assert not re.search(r"(?<![\w−-])(?:nan|inf)(?![\w-])", text, re.IGNORECASE), (key, text)


def end(browser):
    """Stop the pieces in the background, and wait for those that have begun."""
    browser.session.background.stop()
    wait_until(lambda: browser.session.background.backlog == 0)


@pytest.fixture(autouse=True)
def quiet(caplog):
    """Assert at the end that no error was logged."""
    yield
    assert [record.getMessage() for record in caplog.get_records("call") if record.levelno >= logging.ERROR] == []


@settings(max_examples=examples(4), suppress_health_check=SLOW)
@given(query=links())
def test_links(query):
    there = Link(query)
    scene, found = scene_and_values(there, next(iter(scenes())))
    # As the server limits an answer.
    with time_budget(Event()):
        browser = Browser(scene, found, there.notes)
    end(browser)
    assert_answered(browser)


@settings(max_examples=examples(4), suppress_health_check=SLOW)
@given(data=st.data(), scene=SCENES)
def test_messages(data, scene):
    with time_budget(Event()):
        browser = Browser(scene)
    for number in range(1, data.draw(st.integers(1, 6)) + 1):
        with time_budget(Event()):
            state = browser.ask(number, **data.draw(message(browser.scene)))
        assert state["answers"] == number
        assert_answered(browser)
    end(browser)


def commands():
    """Yield the command lines in the help of all commands but those that take minutes, a browser, a port or files."""
    for name in COMMANDS:
        if name not in ("docs", "lesson", "serve", "shot", "site"):
            yield [name, *shlex.split(import_module(f"hess_explorer.commands.{name}").COMMAND.example)]
    for one in catalogue().values():
        yield [*one.key.split(), *shlex.split(command_of(one).example)]


@st.composite
def command_lines(draw):
    """Draw an example of the help with other arguments."""
    other = st.floats(-10.0, 10.0).map(repr) | st.sampled_from(["0", "-1", "draft", "0:10:11", "--help"]) | GARBAGE
    words = draw(st.sampled_from([*commands()]))
    return [draw(other) if word[0].isdigit() and draw(st.integers(0, 3)) == 3 else word for word in words]


@settings(max_examples=examples(6), suppress_health_check=SLOW)
@given(words=command_lines())
def test_commands(capsys, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    try:
        code = main(words)
    except SystemExit as end:
        code = end.code
    out, err = capsys.readouterr()
    err = err.replace(f"{PATIENCE}\n", "")
    assert code in (0, 2)
    assert (code == 2) == err.startswith("hess-explorer: ")
    assert "Traceback" not in err
    assert code == 2 or not re.search(r"\b(NaN|Infinity)\b", out)
