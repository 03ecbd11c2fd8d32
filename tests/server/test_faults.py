"""A server in a faulty environment starts and serves, or exits with a one-sentence remedy."""

import os
import shutil
import subprocess
import sys

import pytest

from hess_explorer.headless.screenshot import wait_alive
from support.asynchronous import finished
from support.command_line import run, typed
from support.mechanics import ROOT
from support.processes import UNWARMED
from support.serving import free_port
from support.visitor import Visitor

# No UTF-8, whatever Python would make of such a locale; an action and a category of warnings that Python does not know.
BARE = {
    "LANG": "C",
    "LC_ALL": "C",
    "PYTHONCOERCECLOCALE": "0",
    "PYTHONUTF8": "0",
    "PYTHONWARNINGS": "nonsense,ignore::no.SuchWarning",
    "HOME": "/nonexistent",
}
# Root may write anywhere, whatever the permissions, unless this capability is dropped.
OBEYS_RIGHTS = ("setpriv", "--bounding-set=-dac_override") if os.getuid() == 0 else ()


@pytest.fixture
def read_only(tmp_path):
    """A copy of the packages that nobody can write to."""
    copy = tmp_path / "installed"
    for name in ("app", "models", "static"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
    subprocess.run(["chmod", "-R", "a-w", copy], check=True)
    yield copy
    subprocess.run(["chmod", "-R", "u+w", copy], check=True)


@pytest.mark.thorough
def test_a_bare_machine_serves(tmp_path, read_only):
    """A read-only installation, no home, a full disk, ASCII, unknown warnings."""
    log, port = tmp_path / "log", free_port()

    async def visit(base):
        visitor = await Visitor.open(base, timeout=500.0)
        return await visitor.ask(timeout=500.0, values={"h": 1.25})

    environment = {
        **os.environ,
        **BARE,
        "NUMBA_CACHE_DIR": str(tmp_path),
        "PYTHONPATH": f"{read_only}/app:{read_only}/models",
    }
    limits = ("prlimit", "--fsize=0", *OBEYS_RIGHTS)
    serves = (sys.executable, *UNWARMED, "serve", "--port", str(port), "--no-browser")
    with subprocess.Popen(
        [*limits, *serves], env=environment, cwd="/", stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    ) as process:
        try:
            log.touch()
            wait_alive(process, port, log)
            state = finished(visit(f"http://127.0.0.1:{port}"))
        finally:
            process.terminate()
        said = process.stdout.read().decode()
        assert process.wait(20) == 0
    assert "ρ = " in state["tree"]["captions"]["circle"]["numbers"]
    assert "1.25" in state["query"]
    # Python itself complains of what it does not know.
    lines = [line for line in said.splitlines() if "Invalid -W option" not in line]
    url = f"http://localhost:{port}"
    assert lines == ["Compiling, ready in about 20 s.", f"Hess Explorer is running at {url} (press Ctrl-C to stop)."]
    assert not list(read_only.rglob("__pycache__"))


def test_a_terminal_of_another_encoding_shows_greek_letters_by_their_numbers():
    """And a command that is refused ends with code 2 and one sentence."""
    done = run(*typed("circle-map --h -2 --f 0.6 --a 0.5"), env={**os.environ, **BARE})
    assert (done.returncode, done.stdout) == (2, b"")
    said = [line for line in done.stderr.decode("ascii").splitlines() if "Invalid -W option" not in line]
    assert len(said) == 1
    assert said[0].startswith("hess-explorer: h = -2 ")
    assert r"\u2212" in said[0]
