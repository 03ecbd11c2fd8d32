"""A server in a faulty environment starts and serves, or exits with a one-sentence remedy."""

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import hess_mechanics
from hess_explorer.commands import serve
from hess_explorer.headless.screenshot import wait_alive
from hess_explorer.server import compiled
from hess_mechanics.numerics.jit import CACHE_FOLDER
from support.asynchronous import finished
from support.command_line import run, typed
from support.processes import UNWARMED
from support.serving import free_port
from support.visitor import Visitor


def copy_kernels(base, package=None):
    """Copy the kernels of this copy of `hess_mechanics` for the one at `package` (default: this one) below `base`.

    base : its NUMBA_CACHE_DIR.  Numba files kernels under a hash of the folder of their source, and takes them only
    for the very same source; a layout unknown here costs time and nothing else.
    """
    here = Path(hess_mechanics.__file__).parent
    there = Path(package) if package is not None else here
    cache = Path(base) / CACHE_FOLDER.name
    cache.mkdir(mode=0o700, parents=True)
    pairs = [(here, there)]
    pairs += [(path, there / path.relative_to(here)) for path in here.rglob("*") if path.is_dir()]
    # Derived source stands in the cache itself.
    pairs += [(path, cache / path.name) for path in CACHE_FOLDER.iterdir() if path.is_dir()]
    names = {_filed(old): _filed(new) for old, new in pairs}
    for folder in CACHE_FOLDER.rglob("*"):
        if folder.is_dir() and folder.name in names:
            shutil.copytree(folder, cache / folder.relative_to(CACHE_FOLDER).with_name(names[folder.name]))


def _filed(folder):
    """The name under which Numba files the kernels of a folder."""
    return f"{folder.name}_{hashlib.sha1(str(folder).encode()).hexdigest()}"


ROOT = Path(__file__).resolve().parents[2]

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
    folders = [copy, *(path for path in copy.rglob("*") if path.is_dir())]
    for folder in folders:
        folder.chmod(0o555)
    yield copy
    for folder in folders:
        folder.chmod(0o755)


def kernels(shared, package):
    """Copy the kernels of this package; corrupt two that the first picture needs and that compile quickly."""
    copy_kernels(shared, package)
    # On a full disk derived source cannot be written, and what was compiled of it is not looked for.
    for source in CACHE_FOLDER.glob("*/*.py"):
        if (there := shared / "hess-explorer" / source.parent.name).is_dir():
            shutil.copy2(source, there)
    spoiled = 0
    for file in (
        *shared.rglob("circle_map_kernels.theta_of-*.nbi"),
        *shared.rglob("bifurcation_kernels.f_max_and_roots-*.nbc"),
    ):
        file.write_bytes(file.read_bytes()[:40] if file.suffix == ".nbi" else b"of something else")
        spoiled += 1
    assert spoiled >= 2


@pytest.mark.thorough
def test_a_bare_machine_serves(tmp_path, read_only):
    """A read-only installation, no home, a full disk, files of kernels that are spoiled, ASCII, unknown warnings."""
    shared, log, port = tmp_path / "kernels", tmp_path / "log", free_port()
    shared.mkdir()
    kernels(shared, read_only / "models" / "hess_mechanics")
    environment = {
        **os.environ,
        **BARE,
        "NUMBA_CACHE_DIR": str(shared),
        "PYTHONPATH": f"{read_only}/app:{read_only}/models",
    }
    with subprocess.Popen(
        [
            "prlimit",
            "--fsize=0",
            *OBEYS_RIGHTS,
            sys.executable,
            *UNWARMED,
            "serve",
            "--port",
            str(port),
            "--no-browser",
        ],
        env=environment,
        cwd="/",
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    ) as process:
        try:
            log.touch()
            wait_alive(process, port, log)
            state = finished(asked(f"http://127.0.0.1:{port}"))
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


async def asked(base):
    visitor = await Visitor.open(base, timeout=300.0)
    state = await visitor.ask(timeout=300.0, values={"h": 1.25})
    await visitor.leave()
    return state


def test_without_any_folder_for_kernels_the_first_line_says_what_to_do(monkeypatch):
    monkeypatch.setattr(compiled, "KEEPS_KERNELS", False)
    assert serve._first_words() == (
        "Compiling, ready in about 20 s.  Every start compiles again, because no cache folder is writable: set "
        "NUMBA_CACHE_DIR to one."
    )


def test_a_terminal_of_another_encoding_shows_greek_letters_by_their_numbers():
    """And a command that is refused ends with code 2 and one sentence."""
    done = run(*typed("circle-map --h -2 --f 0.6 --a 0.5"), env={**os.environ, **BARE})
    assert (done.returncode, done.stdout) == (2, b"")
    said = [line for line in done.stderr.decode("ascii").splitlines() if "Invalid -W option" not in line]
    assert len(said) == 1
    assert said[0].startswith("hess-explorer: h = -2 ")
    assert r"\u2212" in said[0]
