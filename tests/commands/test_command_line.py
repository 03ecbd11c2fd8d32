"""The command line: its numbers, its formats, and a one-sentence message for every error."""

import gc
import math
import os
import signal
import socket
import subprocess
import sys
import time
import types
import webbrowser
from contextlib import nullcontext
from io import BytesIO, StringIO
from urllib.request import urlopen

import numpy as np
import pytest
from PIL import Image
from pytest import approx

import hess_explorer.headless.screenshot
from hess_explorer.__main__ import main
from hess_explorer.commands import CommandError, output
from hess_explorer.headless.screenshot import server_process
from hess_mechanics import SuslovBody, basins
from hess_mechanics.dynamics.orbit import MAX_SAMPLES
from hess_mechanics.errors import InvalidParameter, WorkLimit
from support.andoyer import GESS1, crossings_by_scipy, start_by_hand
from support.ball import rates, upward_crossings
from support.command_line import replaced, strict_json, table, typed, without_patience
from support.mechanics import ROOT
from support.processes import UNWARMED, interruptible

CIRCLE_MAP = typed("circle-map --h 1.5 --f 0.6 --a 0.5 --phi 0,1,2 --accuracy reference")
SUSLOV = typed(
    "orbit suslov --I 2,1,0.3,0.5 --b 0.3,-0.5,1 --omega 0.8,-0.4 --gamma 0.3,0.2,0.93 --t 10,50 --accuracy reference"
)
HESS = typed("orbit hess --a 0.5 --b 1 --omega 0.7,1.1 --gamma 0.2,0.5,0.7 --t 10,50 --accuracy reference")
HEAVY = typed(
    "orbit euler-poisson --A 1,1.6,2.6666666666666667 --r 3,0,4 --mu 1.995 --M 1.3,-2.0,0.7 "
    "--gamma 0.3000066002178079863075,0.40000880029041064841,0.8660190526287390538076 --t 5,20 --accuracy reference"
)

# 40-digit Taylor series, rounded to double.
THETA = [-1.846842405836762766371, -1.713101969292905477533, 2.57889487639795195168]
SUSLOV_STATES = [
    [
        -1.4371975558069667,
        1.0002904454089423,
        -0.2723685171956202,
        -0.19917972328798356,
        -0.9413515967329006,
    ],
    [-1.180814258848206, 0.2923916318266688, 0.5081246282330513, 0.7480548120598404, 0.4268762822377701],
]
HEAVY_STATES = [
    [
        1.3031715764317948,
        1.9392394019302293,
        0.7288273636200425,
        0.2690968985733379,
        -0.40761032993718505,
        0.872605683058911,
    ],
    [
        1.0933691510610686,
        1.3554142173376251,
        1.0140413131012844,
        0.2392882433005333,
        -0.612130925856816,
        0.753682205062467,
    ],
]
TRACE = 4.381325585713531995065
PERIOD = 3.668400280441695618498


# Values


def test_circle_map(answer):
    found = answer(*CIRCLE_MAP)
    assert found["theta"] == approx(THETA, abs=1e-12)
    assert found["trace"] == approx(TRACE, rel=1e-12)
    assert found["period"] == approx(PERIOD, rel=1e-12)
    assert found["kind"] == "hyperbolic"
    assert found["rotation_number"] == 0.0
    assert (found["status"], found["level"], found["notes"]) == ("ok", "reference", [])
    assert 0 < found["error_estimate"] < 1e-12
    stable, unstable = found["multipliers"]
    assert stable < 1 < unstable
    # The multipliers are the squares of the eigenvalues of a matrix with determinant 1.
    assert stable**0.5 + unstable**0.5 == approx(TRACE, rel=1e-12)
    fixed = ",".join(map(repr, found["fixed_points"]))
    assert answer(*replaced(CIRCLE_MAP, "--phi", fixed))["theta"] == approx(found["fixed_points"], abs=1e-12)


def test_circle_map_beyond_double_range(answer):
    found = answer("circle-map", "--h", "1.5", "--f", "0.6", "--a", "500")
    assert found["trace"] is None
    assert found["log_trace"] > 709
    assert found["multipliers"][1] is None
    assert found["log_multipliers"][1] == approx(2 * found["log_trace"], rel=1e-12)
    assert [note.partition(":")[0] for note in found["notes"]] == ["trace", "multipliers"]


def test_range_of_times(answer):
    assert answer(*replaced(HESS, "--t", "0:1:5"))["t"] == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert answer(*replaced(HESS, "--t", "-0.1:-0.3:3"))["t"] == approx([-0.1, -0.2, -0.3], abs=1e-16)


@pytest.mark.parametrize(
    "words, states, variables, integrals, notes",
    [
        (SUSLOV, SUSLOV_STATES, ["ω1", "ω2", "γ1", "γ2", "γ3"], {"E", "F1"}, 1),
        (HEAVY, HEAVY_STATES, ["M1", "M2", "M3", "γ1", "γ2", "γ3"], {"H", "F1", "F2"}, 0),
    ],
)
def test_orbit(answer, words, states, variables, integrals, notes):
    found = answer(*words)
    assert found["t"] == [float(t) for t in words[words.index("--t") + 1].split(",")]
    assert np.array(found["y"]) == approx(np.array(states), abs=1e-11)
    assert (found["variables"], set(found["drift"])) == (variables, integrals)
    assert max(found["drift"].values()) < 1e-12
    assert found["status"] in ("ok", "double-precision floor")
    assert found["level"] == "reference"
    assert 0 < found["error_estimate"] < 1e-10
    assert found["is_body"] is True
    assert ["normalised" in note for note in found["notes"]] == [True] * notes


def test_moments_of_no_body_are_reported_and_computed(answer):
    found = answer(*replaced(HEAVY, "--A", "1,4,4"))
    assert found["is_body"] is False
    assert found["body"].startswith("Not a rigid body")
    assert len(found["y"]) == 2


def test_negative_values_need_no_equals_sign(answer):
    joined = answer(*SUSLOV[:6], "--omega=-0.4,0.2", *SUSLOV[8:])["y"]
    assert answer(*replaced(SUSLOV, "--omega", "-.4,0.2"))["y"] == joined


# Formats


def without_cost(found):
    return {key: value for key, value in found.items() if key != "wall_ms"}


def test_out_writes_a_file_and_prints_nothing(answer, capsys, tmp_path):
    expected = answer(*SUSLOV)
    file = tmp_path / "orbit.json"
    assert main([*SUSLOV, "--out", str(file)]) == 0
    assert capsys.readouterr() == ("", "")
    assert without_cost(strict_json(file.read_text(encoding="utf-8"))) == without_cost(expected)


# What is wrong


@pytest.mark.parametrize(
    "words, part",
    [
        (replaced(CIRCLE_MAP, "--h", "nan"), "--h: 'nan' is not a finite number"),
        (replaced(CIRCLE_MAP, "--f", "9"), "choose |f| ≤ 1.81"),
        (typed("circle-map --h 1 --f 0 --a 0.5"), "separatrix"),
        (replaced(SUSLOV, "--I", "0,1,0,0"), "--I: I11 = 0 is not between 0.001 and 1000"),
        (replaced(SUSLOV, "--I", "2,1,0"), "--I: '2,1,0' has length 3; write 4 numbers I11,I22,I13,I23"),
        (replaced(SUSLOV, "--t", "0," * MAX_SAMPLES + "1"), f"at most {MAX_SAMPLES}"),
        (replaced(SUSLOV, "--t", "1e9"), "shorter"),
        (replaced(SUSLOV, "--omega", "1e200,0"), "--omega: w1 = 1e200 is not between -1000 and 1000"),
        (replaced(SUSLOV, "--omega", "x" * 5000), "x…'"),
        # Abbreviated, this was `--help`.
        ([*HESS, "--h", "1"], "unrecognized arguments: --h 1"),
        (["serve", "--allow-origin", "*"], "not a host"),
        (["serve", "--embed-in", "example.org; script-src *"], "not a host"),
        (["serve", "--address", "203.0.113.7", "--no-browser"], "--address 127.0.0.1"),
        (["shot", "--size", "9000x300", "out.png"], "each side from 200 to 8000"),
        (["shot", "--state", "h=" + "1" * 2000, "out.png"], "at most 2000"),
    ],
)
def test_refusals(refusal, words, part):
    assert part in refusal(*words)


def test_in_a_terminal_it_counts_and_leaves_nothing(monkeypatch):
    class Terminal(StringIO):
        def isatty(self):
            return True

    monkeypatch.setattr(output, "LONG", 0.01)
    monkeypatch.setattr(sys, "stderr", Terminal())
    with pytest.raises(CommandError), output.computing():
        time.sleep(0.2)
        raise InvalidParameter("Too large.")
    said = sys.stderr.getvalue()
    assert said.startswith("\rStill computing; Ctrl-C ends it. 0 s")
    assert said.endswith("\r\x1b[K"), "the line is not cleared"


def test_unwritable_file(refusal, tmp_path):
    assert "choose another file" in refusal(*HESS, "--out", str(tmp_path))


def test_a_reader_that_has_seen_enough_is_no_error():
    words = replaced(HESS, "--t", "0:10:20000")
    with subprocess.Popen(
        [sys.executable, "-m", "hess_explorer", *words, "--format", "csv"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout.readline().startswith(b"# variables")
        process.stdout.close()
        assert without_patience(process.stderr.read()) == b""
    assert process.returncode == 0


def test_commands_do_not_wait_for_what_they_do_not_use():
    script = (
        "import sys; from hess_explorer.__main__ import main; before = set(sys.modules); "
        f"main({CIRCLE_MAP}); "
        "assert 'numba' not in before; "
        "assert not {'panel', 'bokeh', 'holoviews', 'playwright'} & set(sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, timeout=120, check=False)
    assert (done.returncode, without_patience(done.stderr)) == (0, b"")
    assert strict_json(done.stdout)["theta"] == approx(THETA, abs=1e-12)


def test_version_and_help(capsys):
    for words in (["--version"], ["--help"], ["circle-map", "--help"], ["orbit", "suslov", "-h"]):
        with pytest.raises(SystemExit) as end:
            main(words)
        assert end.value.code == 0
        assert "hess-explorer" in capsys.readouterr().out


# serve


@pytest.fixture
def served(monkeypatch):
    """The calls of a server that is ready at once and then returns."""
    calls = []

    def serve(*, ready, **given):
        calls.append(given)
        ready()

    monkeypatch.setitem(sys.modules, "hess_explorer.server.serving", types.SimpleNamespace(serve=serve))
    yield calls
    # The command leaves this to the server.
    gc.enable()


@pytest.fixture
def free_port():
    return hess_explorer.headless.screenshot.free_port()


def test_several_lessons_are_served_in_their_order(served, free_port, tmp_path):
    (tmp_path / "folder").mkdir()
    for name in ("b.md", "a.md", "folder/c.md"):
        lesson = "---\ntitle: One\nminutes: 1\n---\n## One\n```step\nstate: '?scene=suslov-hess'\n```\n"
        (tmp_path / name).write_text(lesson)
    words = [word for name in ("b.md", "folder", "a.md") for word in ("--lesson", str(tmp_path / name))]
    assert main(["serve", "--port", str(free_port), "--no-browser", *words]) == 0
    assert [lesson.name for lesson in served[0]["lessons"]] == ["b", "c", "a"]


@pytest.mark.parametrize(
    "words, changed",
    [
        (
            "--allow-origin a.org:80 b.org --workers 2 --sessions 300 --embed-in example.org *.example.com",
            {
                "origins": ["a.org:80", "b.org"],
                "workers": 2,
                "sessions": 300,
                "embedders": ["example.org", "*.example.com"],
            },
        ),
        ("--embed-in none", {"embedders": []}),
    ],
)
def test_serve(served, free_port, capsys, words, changed):
    assert main(typed(f"serve --port {free_port} --no-browser {words}")) == 0
    assert f"http://localhost:{free_port}" in capsys.readouterr().out
    usual = {"address": "127.0.0.1", "lessons": (), "embedders": ["*"], "workers": 1, "sessions": 1000}
    assert served == [{"port": free_port, "show": False, "origins": [], **usual, **changed}]


def test_without_a_browser_the_server_goes_on(served, free_port, monkeypatch, capsys):
    found = [webbrowser.BackgroundBrowser("browser"), webbrowser.GenericBrowser("lynx")]
    monkeypatch.setattr(webbrowser, "get", lambda: found.pop(0))
    monkeypatch.delenv("BROWSER", raising=False)
    # Options alone mean `serve`.
    for _ in range(2):
        assert main(["--port", str(free_port)]) == 0
    assert [call["show"] for call in served] == [True, False]
    assert (
        f"No browser was found on this machine: open http://localhost:{free_port} yourself" in capsys.readouterr().out
    )


def test_basins_of_a_body_beyond_double_range_end():
    """No subinterval of a step was ever free of roots, so the search did not end; now it names what is too large."""
    body = SuslovBody(1.5, 1.07, 4.4e90, 0.0, 0.3, -0.5, 1.0)
    with pytest.raises(WorkLimit, match=r"the field exceeds the range of double precision in .*I13 \* ω1"):
        basins(body, 0.68, plane=2, cells=(8, 6), accuracy="draft")


def test_taken_port(refusal, served):
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        assert f"Port {port} is in use" in refusal("serve", "--port", str(port), "--no-browser")
    assert not served


def test_a_server_answers_at_the_address_it_prints_and_ends_silently(free_port):
    command = [sys.executable, *UNWARMED, "serve", "--port", str(free_port), "--no-browser"]
    url = f"http://localhost:{free_port}"
    with (
        interruptible(),
        subprocess.Popen(
            command, cwd=ROOT, text=True, start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        ) as process,
    ):
        assert process.stdout.readline().startswith(("Compiling, ready in", "Starting, ready in"))
        assert process.stdout.readline() == f"Hess Explorer is running at {url} (press Ctrl-C to stop).\n"
        with urlopen(url, timeout=60) as answer:
            assert b"<title>Hess Explorer</title>" in answer.read()
        # As a terminal does: to the whole group.
        os.killpg(process.pid, signal.SIGINT)
        assert process.wait(60) == 0
        assert process.stdout.read() == ""


# shot


def test_shot(tmp_path, browser, server, monkeypatch, capsys):
    # A server and a browser are running: starting others is what these two did.
    monkeypatch.setattr(hess_explorer.headless.screenshot, "server_process", lambda log: nullcontext((None, server)))
    monkeypatch.setattr(hess_explorer.headless.screenshot, "launched", lambda: nullcontext(browser))
    before, file = set(browser.contexts), tmp_path / "page.png"
    assert main(["shot", "--state", "h=1.2&f=0.3", "--size", "900x700", "--dark", str(file)]) == 0
    for context in set(browser.contexts) - before:
        context.close()
    assert capsys.readouterr() == ("", "")
    with Image.open(BytesIO(file.read_bytes())) as picture:
        assert picture.size == (900, 700)
        # Dark: most of the page is.
        assert sum(picture.convert("L").histogram()[:100]) > 900 * 700 / 2


def test_export(capsys, refusal, tmp_path):
    state = typed("export --state h=1.2&f=0.3&accuracy=draft --picture circle")
    main(state)
    facts, header, rows = table(capsys.readouterr().out)
    assert (facts["scene"], facts["parameters"]["h"], header[:2]) == ("suslov-hess", 1.2, ["layer", "part"])
    assert len(rows) > 100
    main([*state, "--format", "json"])
    assert strict_json(capsys.readouterr().out)["caption"] == facts["caption"]
    main([*state, "--format", "svg", "--width", "40", "--black", "--out", str(tmp_path / "circle.svg")])
    assert (tmp_path / "circle.svg").read_bytes().startswith(b"<?xml")
    assert "name a file with --out FILE" in refusal(*state, "--format", "png")
    assert "20 to 400 mm wide" in refusal(*state, "--format", "svg", "--width", "nan")
    assert "choose one of body, omega" in refusal("export", "--picture", "../../etc")
    assert "write it like" in refusal("export", "--state", "h")


def test_a_server_that_does_not_start_says_why(monkeypatch, tmp_path):
    # Taken: the port is given away a second time.
    with socket.create_server(("127.0.0.1", 0)) as other:
        monkeypatch.setattr(hess_explorer.headless.screenshot, "free_port", lambda: other.getsockname()[1])
        monkeypatch.setattr(hess_explorer.headless.screenshot, "is_alive", lambda host, port: False)
        with (
            pytest.raises(hess_explorer.headless.screenshot.ServerError, match=r"did not start .*in use"),
            server_process(tmp_path / "log"),
        ):
            pass


# Sections


HEAVY_SECTION = typed(
    "section euler-poisson --A 1,1.6,2.6666666666666665 --r 3,0,4 --mu 1.995 "
    "--h 50 --f 5 --start 0.7,-0.3 --crossings 3"
)
SUSLOV_SECTION = typed(
    "section suslov --I 2,1,0.3,0.5 --b 0.3,-0.5,1 --omega 0.8,-0.4 --gamma 0.6,0,0.8 --plane 0,0,0,1,0 --t 20"
)


def test_section_of_a_heavy_body(answer):
    found = answer(*HEAVY_SECTION)
    start = start_by_hand(GESS1, 50.0, 5.0, 0.7, -0.3)
    assert found["start"] == approx(start.tolist(), abs=1e-11)
    times, states = crossings_by_scipy(GESS1, start, 1.01 * found["t"][-1])
    assert found["t"] == approx(times.tolist(), abs=1e-8)
    for M, gamma, l, x, state in zip(*(found[name] for name in ("M", "gamma", "l", "x")), states, strict=True):
        assert [*M, *gamma] == approx(state.tolist(), abs=1e-6)
        assert x == approx(M[2] / math.hypot(*M), abs=1e-14)
        assert l == approx(math.atan2(M[0], M[1]), abs=1e-14)
    assert set(found["drift"]) == {"H", "F1", "F2"}
    assert max(found["drift"].values()) < 1e-9
    assert (found["status"], found["level"], found["notes"]) == ("ok", "precise", [])
    assert 0.0 < found["error_estimate"] < 1e-8
    assert found["is_body"] is True


def test_section_of_the_suslov_problem(answer):
    found = answer(*SUSLOV_SECTION)
    # The ball without an inner ball.
    body = {"I11": 2.0, "I22": 1.0, "I13": 0.3, "I23": 0.5, "D": 0.0, "b1": 0.3, "b2": -0.5, "b3": 1.0}
    times, states = upward_crossings(rates(body), [0.8, -0.4, 0.6, 0.0, 0.8], 20.0, 3)
    assert found["t"] == approx(times.tolist(), abs=1e-9)
    assert np.array(found["y"]) == approx(states, abs=1e-8)
    assert found["notes"] == [f"There are only {len(found['t'])} of 100 crossings up to t = 20."]
    moved = answer(*SUSLOV_SECTION, "--offset", "0.25")
    assert np.array(moved["y"])[:, 3] == approx(0.25, abs=1e-12)


@pytest.mark.parametrize(
    "words, part",
    [
        (replaced(HEAVY_SECTION, "--h", "-30"), "choose a larger h, or another point"),
        (replaced(HEAVY_SECTION, "--start", "0,1.5"), "--start: x = 1.5 is not between -1 and 1"),
        (replaced(HEAVY_SECTION, "--crossings", "0"), "from 1 to 100000"),
        (replaced(SUSLOV_SECTION, "--plane", "0,0,0,0,0"), "normal other than 0"),
    ],
)
def test_refusals_of_sections(refusal, words, part):
    assert part in refusal(*words)
