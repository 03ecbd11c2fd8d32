"""The explorer as users see it: a served page in a real browser."""

import os
import re
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

import pytest

from hess_explorer.headless.screenshot import server_process

# A density takes seconds for a million crossings; only its own tests need more than these.
os.environ["HESS_EXPLORER_POINTS"] = "2e4"
# Asserts in helpers explain themselves as those of tests do.
pytest.register_assert_rewrite("support", "oracle")


SHARED, SHARED_SERVER = pytest.StashKey(), pytest.StashKey()


def pytest_addoption(parser):
    parser.addoption(
        "--thorough", action="store_true", help="all cases of sampled tests, ten times as many examples of hypothesis"
    )
    parser.addoption("--examples", type=int, metavar="N", default=1, help="N times as many examples of hypothesis")
    parser.addoption(
        "--moved-start",
        type=int,
        metavar="SEED",
        help="move every start by a few units in the last place; tests of chaotic motions must pass with any",
    )


def pytest_configure(config):
    """With several test processes, compile all kernels once before they start; those of the page share one server."""
    from support.processes import UNWARMED
    from support.thorough import load_profile

    load_profile(is_thorough=config.getoption("thorough"), factor=config.getoption("examples"))
    # Films have this low priority; among tests of another they would wait for minutes.
    if hasattr(os, "setpriority"):
        os.setpriority(os.PRIO_PROCESS, 0, 15)
    if config.getoption("numprocesses", None) and not config.option.collectonly:
        # In a process of its own, for this one shall not import what is tested.
        compile_kernels = "from hess_explorer.server.warm import compile_all; compile_all(processes=2)"
        subprocess.run([sys.executable, "-c", compile_kernels], check=True)
        # Only the page needs it.
        if any(Path(one.partition("::")[0]).name in ("tests", "page") for one in config.args):
            shared = config.stash[SHARED] = ExitStack()
            log = Path(shared.enter_context(tempfile.TemporaryDirectory())) / "server.log"
            config.stash[SHARED_SERVER] = (shared.enter_context(server_process(log, UNWARMED))[1], str(log))


def pytest_collection_modifyitems(config, items):
    """Leave out the tests marked `thorough`, unless the option is given."""
    if not config.getoption("thorough"):
        left_out = [item for item in items if item.get_closest_marker("thorough")]
        items[:] = [item for item in items if item not in left_out]
        config.hook.pytest_deselected(items=left_out)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    """Move all starts, of fixtures too, with --moved-start."""
    seed = item.config.getoption("moved_start")
    if seed is None:
        return (yield)
    from support.moved import moved_starts

    with moved_starts(seed):
        return (yield)


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node):
    """Pass the shared server, if there is one, to a test process."""
    node.workerinput["server"] = node.config.stash.get(SHARED_SERVER, None)


def pytest_unconfigure(config):
    if SHARED in config.stash:
        config.stash[SHARED].close()


@pytest.fixture(scope="session")
def browser():
    """Start a headless Chromium, installed if necessary; without one every test that needs it fails."""
    from support.chromium import launched_or_installed

    with launched_or_installed() as running:
        yield running


@pytest.fixture(scope="session")
def server(pytestconfig, tmp_path_factory):
    """Return the base URL of a server for the whole run; its log is checked when a process has ended."""
    from support.processes import UNWARMED

    with ExitStack() as own:
        shared = getattr(pytestconfig, "workerinput", {}).get("server")
        if shared is None:
            log = tmp_path_factory.mktemp("server") / "server.log"
            base = own.enter_context(server_process(log, UNWARMED))[1]
        else:
            base, log = shared[0], Path(shared[1])
        yield base
    said = log.read_text(errors="replace")
    assert not re.search(r"Traceback|\b(ERROR|CRITICAL)\b", said), said


@pytest.fixture(scope="session")
def artefacts():
    """Folder for screenshots: tests/artefacts, which git ignores."""
    folder = Path(__file__).parent / "artefacts"
    folder.mkdir(exist_ok=True)
    return folder
