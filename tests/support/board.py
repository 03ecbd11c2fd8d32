"""A scene without a browser: the messages of its stage, as the browser receives them."""

import dataclasses
import json
from functools import cache
from urllib.parse import parse_qs

import numpy as np

from hess_explorer.lessons import package_lessons
from hess_explorer.page.description import describe
from hess_explorer.page.session import Session
from hess_explorer.protocol.messages import Request, parse
from hess_explorer.protocol.specs import Formula, NumberSpec, Points, decode
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.stage import Stage
from support.captions import texts_in
from support.wire import read, read_frame

SCENES = scenes()
HESS = SCENES["suslov-hess"]
ACCURACY = SCENES["suslov-hess-accuracy"]


@cache
def description(name):
    """Return the description of a scene that the browser receives once."""
    return json.loads(describe(name))


class Figure:
    """A plot of a description, as its JSON has it: Bokeh itself takes a hundred times as long to read it.

    `ranges` x0, x1, y0, y1; `logarithmic` (x, y); `glyphs` [(kind, column of x, of y, name of the source)]; `sources`
    by name, empty; what else is asked of it in `attributes`, where Bokeh leaves out what is as always.
    """

    def __init__(self, item):
        (root,) = item["doc"]["roots"]
        self.attributes = root["attributes"]
        self.name = self.attributes["name"]
        objects = {one["id"]: one for one in objects_in(root)}

        def named(kind):
            return [one for one in objects.values() if one["name"] == kind]

        def attributes(part):
            return objects[part["id"]].get("attributes", {})

        axes = [attributes(self.attributes[f"{side}_range"]) for side in "xy"]
        # A range is from 0 to 1 unless it is said.
        self.ranges = [axis.get(end, first) for axis in axes for end, first in (("start", 0.0), ("end", 1.0))]
        self.logarithmic = tuple(objects[self.attributes[f"{side}_scale"]["id"]]["name"] == "LogScale" for side in "xy")
        self.sources = {
            own["name"]: dict(own.get("data", {"entries": []})["entries"])
            for own in map(attributes, named("ColumnDataSource"))
            if own.get("name") is not None
        }
        self.glyphs = []
        for renderer in map(attributes, self.attributes["renderers"]):
            glyph, source = renderer["glyph"], attributes(renderer["data_source"])
            columns = [attributes(glyph).get(side, {}) for side in "xy"]
            self.glyphs.append(
                (
                    objects[glyph["id"]]["name"],
                    *(column.get("field") if isinstance(column, dict) else None for column in columns),
                    source.get("name"),
                )
            )


def objects_in(part):
    """The objects of a document that stand in this part of it."""
    if isinstance(part, dict):
        if part.get("type") == "object":
            yield part
        part = list(part.values())
    if isinstance(part, list):
        for one in part:
            yield from objects_in(one)


@cache
def plots_of(name):
    """The empty pictures of a scene that Bokeh draws, by name."""
    found = [Figure(one["item"]) for one in description(name)["pictures"] if one["kind"] == "plot"]
    return {one.name: one for one in found}


@cache
def empty_sources(name):
    """The sources of a scene's pictures before there are data: those of its plots, and one for each other picture."""
    pictures = description(name)["pictures"]

    def parts(kind):
        return [one for picture in pictures for one in picture.get(kind, ())]

    plotted = [pair for plot in plots_of(name).values() for pair in plot.sources.items()]
    own = [source for source, _ in plotted if source not in tracks_of(name)]
    assert len(set(own)) == len(own)
    assert not any(column for _, columns in plotted for column in columns.values())
    canvases = {picture["name"]: {} for picture in pictures if picture["kind"] != "plot"}
    assert not {source for source, _ in plotted} & set(canvases)
    return {
        **{source: {} for source in (*tracks_of(name), *parts("curves"), *(one["source"] for one in parts("cells")))},
        **{f"{picture['name']}-axes": {"text": []} for picture in pictures if picture.get("renamed")},
        **{one["source"]: {one["x"]: [], one["y"]: []} for one in parts("dots")},
        **{one["source"]: {"x": [], "y": []} for one in parts("points")},
        **dict(plotted),
        **canvases,
    }


def tracks_of(name):
    """The sources that several pictures of a scene share."""
    return set(description(name)["tracks"])


class Screen:
    """The browser's data of a scene: the newest data, axes and texts received from the server."""

    def __init__(self, name):
        self.sources = dict(empty_sources(name))
        self.ranges = {plot: list(figure.ranges) for plot, figure in plots_of(name).items()}
        self.texts, self.controls = {}, {}
        self.fresh = {}

    def take(self, tree, block):
        """Apply an update; `fresh` names its new sources. Names unknown to the browser raise errors."""
        assert set(tree) == {"sources", "ranges", "texts", "captions", "controls"}
        self.fresh = {
            name: {key: read(column, block) for key, column in columns.items()}
            for name, columns in tree["sources"].items()
        }
        # Only cells may be left out; whole numbers always are some.
        cells = [one for columns in self.fresh.values() for one in columns.get("image", ())]
        numbers = np.frombuffer(block, "<f4").copy()
        for columns in tree["sources"].values():
            for item in columns.values():
                if isinstance(item, dict) and "shorts" in item:
                    numbers[item["at"] : item["at"] + item["n"]] = 0.0
        assert np.sum(~np.isfinite(numbers)) == sum(np.sum(np.isnan(one)) for one in cells)
        assert set(self.fresh) <= set(self.sources)
        assert set(tree["ranges"]) <= set(self.ranges)
        self.sources.update(self.fresh)
        self.ranges.update(tree["ranges"])
        self.texts.update(texts_in(tree))
        self.controls.update(tree["controls"])


class Board(Screen):
    """A stage and its visible state in the browser."""

    def __init__(self, scene):
        super().__init__(scene.name)
        self.scene, self.wire = scene, Wire()
        self.stage = Stage(scene, self.wire)

    def receive(self):
        tree, block = self.wire.pack()
        # JSON in a browser refuses NaN and Infinity.
        self.take(json.loads(json.dumps(tree, allow_nan=False)), block)

    def show(self, result, hold_axes=False):
        report = self.stage.show(result, hold_axes)
        self.receive()
        return report

    def fail(self, sentence):
        self.stage.fail(sentence)
        self.receive()

    @property
    def captions(self):
        return {name: self.texts.get(name) for name in self.scene.pictures}


def flat(item):
    """The numbers and texts in a column, however deeply nested, in order."""
    if isinstance(item, (list, tuple)) or (isinstance(item, np.ndarray) and item.dtype == object):
        return [value for part in item for value in flat(part)]
    return np.asarray(item).ravel().tolist()


def contents(sources):
    """Return the drawn data; an empty column equals a missing one."""
    flattened = {name: {key: flat(column) for key, column in columns.items()} for name, columns in sources.items()}
    return {name: {key: column for key, column in columns.items() if column} for name, columns in flattened.items()}


def variant(scene, **changed):
    """The scene with other attributes or methods; a function in the place of a method takes no `self`."""
    fields = {one.name: changed.pop(one.name, getattr(scene, one.name)) for one in dataclasses.fields(scene)}
    members = {name: staticmethod(value) if callable(value) else value for name, value in changed.items()}
    return type("Variant", (type(scene),), members)(**fields)


def shown(scene, values, board=None, hold_axes=False):
    """The board, with all pictures of these values drawn on it, and the report."""
    board = board or Board(scene)
    return board, board.show(scene.compute(scene.admit(values)[0], scene.pictures, False), hold_axes)


def other_sheets(scene):
    """Another state than the default one, that of the example which differs in most numbers."""
    return {**scene.defaults(), **max(scene.presets, key=lambda preset: len(preset.values)).values}


class Browser:
    """Client side of a session: sends arbitrary messages and decodes the responses, as a browser does."""

    def __init__(self, scene, values=None, notes=()):
        self.state = None
        self.entered, self.described, self.screens = [], [], {}
        self.scene = scene
        self.session = Session(scene, values or scene.defaults(), list(notes), package_lessons(), scene.open_pictures)
        self._hear(self.session.answer(Request(requested=0)))

    def send(self, message):
        request = parse(message)
        if request is not None:
            self._hear(self.session.answer(request))

    def _hear(self, answer):
        told, block = read_frame(answer.encode())
        if "scene" in told:
            self.described.append(told["scene"]["name"])
        if "state" in told:
            self._take(told["state"], block)
        self.session.start_tasks()

    def _take(self, state, block):
        self.state = state
        name = state["scene"]
        # It was described before.
        assert name in self.described
        if self.entered[-1:] != [name]:
            self.entered.append(name)
            if name != self.scene.name:
                self.scene = scenes()[name]
        self.screen = self.screens.setdefault(name, Screen(name))
        self.screen.take(state["tree"], block)

    @property
    def data(self):
        """The columns of the scene on show."""
        return self.screen.sources

    @property
    def texts(self):
        return self.screen.texts

    @property
    def controls(self):
        """[value, low, high, step] of the numbers, and True where they are disabled; the options of the menus."""
        return self.screen.controls

    def ask(self, requested=1, **message):
        self.send({"requested": requested, "held": False, "values": {}, "picked": None, **message})
        return self.state

    def assert_admissible(self):
        values = self.session.values
        assert set(values) == {spec.name for spec in self.scene.specs}
        for spec in self.scene.specs:
            value = values[spec.name]
            if isinstance(spec, NumberSpec):
                assert isinstance(value, float)
                assert spec.bounds[0] <= value <= spec.bounds[1]
            elif isinstance(spec, Points | Formula):
                assert spec.read(value) == (value, None)
            else:
                assert value in spec.options
        # The link says the same.
        assert decode(self.state["query"], self.scene.specs) == (values, [])
        assert parse_qs(self.state["query"])["scene"] == [self.scene.name] == [self.state["scene"]]
