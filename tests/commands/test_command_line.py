"""The commands of the page: `serve`, `shot`, `export`, and a one-sentence message for every error."""

import gc
import os
import signal
import socket
import subprocess
import sys
import time
import types
import webbrowser
from contextlib import nullcontext
from io import BytesIO
from urllib.request import urlopen

import pytest
from PIL import Image

from hess_explorer.__main__ import main
from hess_explorer.commands import output
from hess_explorer.export.picture_data import picture_data
from hess_explorer.export.table import as_csv
from hess_explorer.headless import screenshot
from support.command_line import strict_json, table, typed
from support.mechanics import ROOT
from support.processes import UNWARMED, interruptible

# Errors


@pytest.mark.parametrize(
    "words, part",
    [
        (["serve", "--allow-origin", "*"], "not a host"),
        (["serve", "--embed-in", "example.org; script-src *"], "not a host"),
        (["serve", "--address", "203.0.113.7", "--no-browser"], "--address 127.0.0.1"),
        (["shot", "--size", "9000", "300", "out.png"], "9000 is not a whole number from 200 to 8000"),
    ],
)
def test_refusals(refusal, words, part):
    assert part in refusal(*words)


def test_version_and_patience(monkeypatch, capsys):
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert (end.value.code, capsys.readouterr().out.split()[0]) == (0, "hess-explorer")
    monkeypatch.setattr(output, "LONG", 0.01)
    with output.long_computation():
        time.sleep(0.2)
    assert capsys.readouterr().err == f"{output.PATIENCE}\n"


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
    return screenshot.free_port()


def test_serve(served, free_port, capsys, tmp_path):
    (tmp_path / "folder").mkdir()
    for name in ("b.md", "a.md", "folder/c.md"):
        lesson = "---\ntitle: One\nminutes: 1\n---\n## One\n```step\nstate: '?scene=suslov-hess'\n```\n"
        (tmp_path / name).write_text(lesson)
    lessons = " ".join(f"--lesson {tmp_path / name}" for name in ("b.md", "folder", "a.md"))
    words = "--allow-origin a.org:80 b.org --workers 2 --sessions 300 --embed-in none *.example.com"
    assert main(typed(f"serve --port {free_port} --no-browser {words} {lessons}")) == 0
    assert f"http://localhost:{free_port}" in capsys.readouterr().out
    assert main(typed(f"serve --port {free_port} --no-browser")) == 0
    assert [lesson.name for lesson in served[0].pop("lessons")] == ["b", "c", "a"]
    assert served[1].pop("lessons") == ()
    usual = {"port": free_port, "show": False, "address": "127.0.0.1"}
    given = {"origins": ["a.org:80", "b.org"], "workers": 2, "sessions": 300, "embedders": ["*.example.com"]}
    assert served == [usual | given, usual | {"origins": [], "workers": 1, "sessions": 1000, "embedders": ["*"]}]


def test_without_a_browser_the_server_goes_on(served, free_port, monkeypatch, capsys):
    monkeypatch.setattr(webbrowser, "get", lambda: webbrowser.GenericBrowser("lynx"))
    monkeypatch.delenv("BROWSER", raising=False)
    # Options alone mean `serve`.
    assert main(["--port", str(free_port)]) == 0
    assert not served[0]["show"]
    assert f"http://localhost:{free_port}" in capsys.readouterr().out


def test_taken_port(refusal, served, monkeypatch, tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        words = ("serve", "--port", str(port), "--no-browser")
        assert f"already in use (while attempting to bind on address ('127.0.0.1', {port}))" in refusal(*words)
        # A server in a process of its own says so too.
        monkeypatch.setattr(screenshot, "free_port", lambda: port)
        monkeypatch.setattr(screenshot, "is_alive", lambda host, port: False)
        with (
            pytest.raises(screenshot.ServerError, match=r"did not start .*in use"),
            screenshot.server_process(tmp_path / "log"),
        ):
            pass
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
    monkeypatch.setattr(screenshot, "server_process", lambda log: nullcontext((None, server)))
    monkeypatch.setattr(screenshot, "headless_browser", lambda: nullcontext(browser))
    before, file = set(browser.contexts), tmp_path / "page.png"
    assert main(["shot", "--state", "h=1.2&f=0.3&theme=dark", "--size", "900", "700", str(file)]) == 0
    for context in set(browser.contexts) - before:
        context.close()
    assert capsys.readouterr() == ("", "")
    with Image.open(BytesIO(file.read_bytes())) as picture:
        assert picture.size == (900, 700)
        # Dark: most of the page is.
        assert sum(picture.convert("L").histogram()[:100]) > 900 * 700 / 2


def test_export(capsys, refusal, tmp_path):
    words, file = typed("export --state h=1.2&f=0.3&accuracy=draft --picture circle"), tmp_path / "circle.svg"
    main(words)
    out = capsys.readouterr().out
    assert out == as_csv(picture_data(words[2], "circle"))
    main([*words, "--format", "json"])
    assert strict_json(capsys.readouterr().out)["caption"] == table(out)[0]["caption"]
    main([*words, "--format", "svg", "--width", "40", "--black", "--out", str(file)])
    assert file.read_bytes().startswith(b"<?xml")
    assert "20 to 400 mm wide" in refusal(*words, "--format", "svg", "--width", "nan")
    assert "choose one of body, omega" in refusal("export", "--picture", "../../etc")
    assert "invalid state value: 'h'" in refusal("export", "--state", "h")
