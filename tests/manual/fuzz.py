"""Random links, messages and command lines: `python tests/manual/fuzz.py links 1000 --seed 1`.

Counted are exceptions, warnings, log messages, responses that take more than 5 s of the processor, NaNs on a picture or
in a sentence, and “could not be computed”.  The same seed sends the same.
"""

import argparse
import io
import json
import logging
import random
import re
import shlex
import sys
import tempfile
import time
import warnings
from collections import Counter
from contextlib import chdir, contextmanager, nullcontext, redirect_stderr, redirect_stdout
from importlib import import_module
from logging.handlers import BufferingHandler
from pathlib import Path
from threading import Event
from urllib.parse import quote, urlencode

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.__main__ import main
from hess_explorer.commands import COMMANDS
from hess_explorer.commands.compute import command_of
from hess_explorer.commands.output import PATIENCE
from hess_explorer.compute.budget import time_budget
from hess_explorer.page.description import describe
from hess_explorer.page.requested import scene_and_values
from hess_explorer.protocol.specs import CLIENT, ChoiceSpec, Formula, Link, NumberSpec, Places, places_text
from hess_explorer.scenes import scenes
from hess_explorer.server.warm import compute
from hess_mechanics.catalogue import catalogue
from hess_mechanics.numerics.jit import seconds_compiling
from support.board import Browser

STALL = 5.0
"""Seconds of the processor after which an answer counts as a stall."""
LONGEST = 60.0
"""The same for a command that has said that it goes on and how it is ended."""

GARBAGE = (
    "",
    "nan",
    "-inf",
    "1e400",
    "1e-320",
    "-0",
    "0x10",
    "1_0",
    "٣",
    "<script>alert(1)</script>",
    "%00",
    "\x00",
    "9" * 400,
    "true",
    "../..",
    "é" * 50,
    "1e5e5",
    ",",
)
_NO_NUMBER = re.compile(r"(?<![\w−-])(?:nan|inf)(?![\w-])", re.IGNORECASE)


class Findings:
    """Failures by kind, with the inputs that cause them; `slow`: the seconds of the slowest."""

    def __init__(self):
        self.count, self.examples, self.done, self.seconds = Counter(), {}, 0, []

    def found(self, kind, given, detail=""):
        self.count[kind] += 1
        kept = self.examples.setdefault(kind, [])
        if len(kept) < 25:
            kept.append((given, detail))

    def timed(self, seconds, given, told=False):
        self.done += 1
        self.seconds.append(seconds)
        if seconds > (LONGEST if told else STALL):
            self.found("stall", given, f"{seconds:.1f} s")

    @property
    def total(self):
        return sum(self.count.values())

    def __str__(self):
        times = sorted(self.seconds) or [0.0]
        lines = [
            f"{self.done} done; seconds: median {times[len(times) // 2]:.3f}, "
            f"99 of 100 {times[int(0.99 * (len(times) - 1))]:.2f}, slowest {times[-1]:.2f}"
        ]
        for kind, count in self.count.most_common():
            lines.append(f"{kind}: {count}")
            lines += [f"    {given}\n        {detail}" for given, detail in self.examples[kind]]
        return "\n".join(lines)


@contextmanager
def _watched(findings, given, budget=True, told=lambda: False):
    """Count exceptions, warnings and log messages, and measure the time; told() : whether a long run was announced."""
    heard, logger = BufferingHandler(1_000_000), logging.getLogger("hess_explorer")
    heard.setLevel(logging.ERROR)
    logger.addHandler(heard)
    propagate, logger.propagate = logger.propagate, False
    # CPU time, as the machine may be busy.  Not counted: compilation, which happens once, and background pieces, which
    # have their own limits.
    start = time.process_time() - seconds_compiling()
    spent = None
    try:
        # A session answers within this budget.
        with warnings.catch_warnings(record=True) as caught, time_budget(Event()) if budget else nullcontext() as spent:
            warnings.simplefilter("always")
            # The garbage collector may find resources of an earlier test at any time.
            warnings.simplefilter("ignore", ResourceWarning)
            yield
        for one in caught:
            findings.found("warning", given, f"{one.filename.rpartition('/')[2]}:{one.lineno} {one.message}")
    # Whatever it is, it is what is looked for.
    except Exception as error:
        at = error.__traceback__
        while at.tb_next is not None:
            at = at.tb_next
        findings.found("raised", given, f"{at.tb_frame.f_code.co_filename}:{at.tb_lineno} {error!r}"[:400])
    finally:
        whole = max(0.0, time.process_time() - seconds_compiling() - start)
        findings.timed(whole if spent is None else spent.spent, given, told())
        logger.removeHandler(heard)
        logger.propagate = propagate
    for record in heard.buffer:
        findings.found("logged", given, " | ".join(heard.format(record).splitlines()[-3:]))


def _checked(browser, findings, given):
    browser.assert_admissible()
    for key, text in browser.texts.items():
        if "could not be computed" in text:
            findings.found("could not be computed", given, f"{key}: {text}")
        elif _NO_NUMBER.search(text):
            findings.found("no number in a sentence", given, f"{key}: {text[:300]}")


def _number(random, spec, wild=False):
    kind = random.uniform(0.45, 0.85) if wild else random.random()
    low, high = spec.bounds
    if kind < 0.45:
        return random.uniform(*spec.softbounds)
    if kind < 0.6:
        return random.uniform(low, high)
    if kind < 0.7:
        return random.choice([low, high, 0.0, spec.default, -spec.default, *spec.softbounds])
    if kind < 0.85:
        return random.choice([-1.0, 1.0]) * 10.0 ** random.uniform(-9.0, 4.0)
    return round(random.uniform(*spec.softbounds), random.randint(0, 2))


def _value(random, spec, wild=False):
    if random.random() < 0.04:
        return random.choice(GARBAGE)
    if isinstance(spec, NumberSpec):
        return repr(_number(random, spec, wild))
    if isinstance(spec, ChoiceSpec):
        return random.choice(spec.options)
    if isinstance(spec, Formula):
        return random.choice(["", "g1", "0.5*g1^2 - g3", "g1^9"])
    assert isinstance(spec, Places)
    return places_text(
        [
            tuple(random.uniform(low, high) for low, high in zip(spec.low, spec.high, strict=True))
            for _ in range(random.randint(0, spec.most + 2))
        ]
    )


def _some(random, specs):
    share, wild = random.choice([0.1, 0.3, 0.6, 1.0]), random.random() < 0.3
    return {spec.name: _value(random, spec, wild) for spec in specs if random.random() < share}


def link(random):
    """Return a query, mostly valid for one scene."""
    if random.random() < 0.02:
        return quote(random.choice(GARBAGE)) * random.randint(1, 9)
    scene = random.choice([*scenes().values()])
    given = {"v": "1", "scene": scene.name}
    if random.random() < 0.3:
        given |= {name: str(value) for name, value in scene.example(random.choice(scene.presets)).items()}
    given |= _some(random, scene.specs)
    if random.random() < 0.1:
        given |= _some(random, CLIENT)
    if random.random() < 0.02:
        given["scene"] = random.choice(GARBAGE)
    return urlencode(given)


def fuzz_links(random, count):
    """Open this many links, each in its own session."""
    findings, first = Findings(), next(iter(scenes()))
    for _ in range(count):
        query = link(random)
        with _watched(findings, query):
            there = Link(query)
            found, values = scene_and_values(there, first)
            browser = Browser(found, values, there.notes)
            browser.session.background.stop()
            _checked(browser, findings, query)
            _left(browser)
    return findings


def message(random, scene):
    """A message for a session that shows this scene."""
    given = {}

    def sometimes(share):
        return random.random() < share

    if sometimes(0.7):
        given["values"] = {
            name: text if sometimes(0.1) or not isinstance(spec, NumberSpec) else _number(random, spec)
            for spec in scene.specs
            for name, text in [(spec.name, _value(random, spec))]
            if sometimes(0.3)
        }
    if sometimes(0.15):
        given["picked"] = [
            random.choice([*scene.pictures, "nobody", 3]),
            *(
                random.choice([random.uniform(-4.0, 4.0), 1e300, None, float("nan")])
                if sometimes(0.1)
                else random.uniform(-3.0, 3.0)
                for _ in range(random.choice([2, 2, 2, 4, 4, 1, 3]))
            ),
        ]
    if sometimes(0.15):
        given["hover"] = [random.choice(scene.pictures), random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)]
    if sometimes(0.1):
        given["scene"] = random.choice([*scenes(), "nobody", 3, None])
    if sometimes(0.05):
        given["near"] = random.choice([*scenes(), "nobody"])
    if sometimes(0.05):
        given["restore"] = link(random)
    if sometimes(0.05):
        given["preset"] = random.choice([preset.name for preset in scene.presets])
    if sometimes(0.05):
        given["expressions"] = {
            random.choice([spec.name for spec in scene.specs]): random.choice(
                ["pi/3", "1/0", "9**9**9", "__import__('os')", "sqrt(-1)", "e", "(" * 60, *GARBAGE]
            )
        }
    if sometimes(0.05):
        given["step"] = [random.choice(["introduction", scene.name, "nobody"]), random.randint(-2, 9), sometimes(0.5)]
    if sometimes(0.3):
        given["held"] = sometimes(0.7)
    if sometimes(0.1):
        given["hidden"] = [name for name in scene.pictures if sometimes(0.5)]
    for name in ("reset", "clear", "stop"):
        if sometimes(0.02):
            given[name] = random.choice([True, False, 1, "x"])
    if sometimes(0.05):
        given[random.choice(["values", "picked", "hover", "hidden", "lesson", "step", "expressions", "restore"])] = (
            random.choice([None, 3, "x", [], {}, [[]], {"a": []}, [None] * 5, 1e400, 10**400])
        )
    return given


def fuzz_messages(random, count, length=25):
    """Send this many messages, to sessions that are closed after `length` of them."""
    findings, browser, story = Findings(), None, []
    for number in range(count):
        if number % length == 0:
            _left(browser)
            scene = random.choice([*scenes().values()])
            browser, story = Browser(scene), [scene.name]
        given = message(random, browser.scene)
        story = [*story, given]
        told = _told(story)
        with _watched(findings, told):
            state = browser.ask(number + 1, **given)
            if state["answers"] != number + 1:
                findings.found("no answer", told)
            _checked(browser, findings, told)
    _left(browser)
    return findings


def _left(browser):
    """Stop pending pieces, and wait for those that have started before the program ends."""
    if browser is not None:
        browser.session.background.stop()
        while browser.session.background.backlog:
            time.sleep(0.005)


def _told(story):
    """The messages that led to a finding: the last one and the scene before it."""
    return f"[{story[0]}, message {len(story) - 1}] {json.dumps(story[-1], default=str)[:600]}"


# ---- command lines ----------------------------------------------------------------------------------------------


def _examples():
    """The command lines in the help of all commands."""
    for name in COMMANDS:
        # Those that take minutes, a browser, a port or files are for other tests.
        if name not in ("docs", "lesson", "serve", "shot", "site"):
            yield [name, *shlex.split(import_module(f"hess_explorer.commands.{name}").COMMAND.example)]
    for one in catalogue().values():
        yield [*one.key.split(), *shlex.split(command_of(one).example)]


def _argument(random, text):
    """Return another value for an argument, mostly of the same form."""
    kind = random.random()
    if kind < 0.1:
        return random.choice(GARBAGE)
    if kind < 0.2:
        return random.choice([f"{text},{text}", text[:-1], f"-{text}", f"{text}:2", "draft", "reference", "0:10:11"])
    return re.sub(
        r"\d+\.?\d*(e-?\d+)?",
        lambda found: (
            found[0]
            if random.random() < 0.5
            else random.choice(["0", "1", f"-{found[0]}", f"{10.0 ** random.uniform(-300.0, 300.0):.3g}"])
        ),
        text,
    )


def command_line(random, examples):
    """Return a command line that computes something and writes no file."""
    words = list(random.choice(examples))
    for i, word in enumerate(words[1:], 1):
        name, sign, value = word.partition("=")
        if word.startswith("--") and sign:
            words[i] = f"{name}={_argument(random, value)}" if random.random() < 0.4 else word
        elif not word.startswith("--") and i > 1 and random.random() < 0.4:
            words[i] = _argument(random, word)
    if random.random() < 0.1:
        del words[random.randrange(1, len(words))]
    if random.random() < 0.1:
        more = ["--help", "--nobody", "--format=csv", "--format=xml", "--accuracy=draft", "--accuracy=nobody", *GARBAGE]
        words.insert(random.randrange(1, len(words) + 1), random.choice(more))
    return words


@contextmanager
def _elsewhere():
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        yield


@_elsewhere()
def fuzz_commands(random, count):
    """Run this many command lines in this process, and discard the files they write."""
    findings, examples = Findings(), list(_examples())
    for _ in range(count):
        words = command_line(random, examples)
        given, out, err = shlex.join(words), io.TextIOWrapper(io.BytesIO(), encoding="utf-8"), io.StringIO()
        code = None
        with (
            _watched(findings, given, False, lambda err=err: PATIENCE in err.getvalue()),
            redirect_stdout(out),
            redirect_stderr(err),
        ):
            try:
                code = main(words)
            except SystemExit as end:
                code = end.code
        said = err.getvalue().replace(f"{PATIENCE}\n", "")
        if code not in (0, 2) or "Traceback" in said or (code == 2) != said.startswith("hess-explorer: "):
            findings.found("exit", given, f"{code} {said[-300:]}")
        out.flush()
        if code == 0 and re.search(rb"\b(NaN|Infinity)\b", out.buffer.getvalue()):
            findings.found("no number in a result", given, out.buffer.getvalue()[:200])
    return findings


WORKS = {"links": fuzz_links, "messages": fuzz_messages, "commands": fuzz_commands}


def run():
    """Send and print; the exit code is 1 where anything was found."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("work", choices=WORKS)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    # As a server does while it is idle.
    for name in scenes():
        compute(name)
        describe(name)
    findings = WORKS[options.work](random.Random(options.seed), options.count)
    print(f"{options.work}, seed {options.seed}: {findings}")
    return int(findings.total > 0)


if __name__ == "__main__":
    sys.exit(run())
