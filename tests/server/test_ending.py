"""Shutdown of a server: it notifies its pages, and its processes exit."""

import os
import re
import signal
import subprocess
import sys
import time

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPClientError, HTTPRequest
from tornado.websocket import websocket_connect

from hess_explorer.headless.screenshot import server_process
from hess_explorer.server.room_socket import SEVERAL
from support.asynchronous import finished, wait_until
from support.processes import UNWARMED, assert_gone, below
from support.room import Follower, Lecturer, new_code
from support.visitor import Visitor

WORKERS = ("--workers", "2")


async def refused(base):
    """The reasons for which a server of several processes has no rooms, for a lecturer and a follower."""
    return [
        await (await kind.connect(base, new_code(), first)).end()
        for kind, first in ((Lecturer, {"open": True}), (Follower, {"follow": "somebody"}))
    ]


async def told(base, end, count):
    """Return the last messages of `count` pages on both of their websockets when the server ends."""
    visitors = [await Visitor.open(base, "scene=kharlamova&accuracy=draft") for _ in range(count)]
    end()
    heard = []
    for visitor in visitors:
        heard += await visitor.end()
        await visitor.leave()
    return heard


async def answering(base):
    """The workers that respond to a request for counters, of which each names itself."""
    found = set()
    for _ in range(40):
        answer = await AsyncHTTPClient().fetch(f"{base}/metrics")
        found |= set(re.findall(r'^hess_explorer_sessions\{worker="(\d)"\} \d+$', answer.body.decode(), re.MULTILINE))
    # For the log.
    foreign = HTTPRequest(f"ws{base.removeprefix('http')}/states", headers={"Origin": "http://example.org"})
    with pytest.raises(HTTPClientError, match="403"):
        await websocket_connect(foreign)
    return found


def test_of_several_workers_all_tell_their_pages_and_end_with_the_process_that_began(tmp_path):
    log = tmp_path / "log"
    with server_process(log, UNWARMED, WORKERS) as (process, base):
        workers = below(process.pid)[1:]
        assert len(workers) == 2
        assert finished(answering(base)) == {"0", "1"}
        assert finished(refused(base)) == [f"{SEVERAL[0]}: {SEVERAL[1]}"] * 2
        # One that was killed is replaced.
        os.kill(workers[0], signal.SIGKILL)
        heard = finished(told(base, process.terminate, 4))
        assert process.wait(20) == 0
        assert_gone(workers)
    assert heard == ["1001: The server is shutting down or restarting: open the page again in a moment."] * 8
    said = log.read_text()
    assert "Traceback" not in said
    assert "ERROR" not in said
    logged = [line for line in said.splitlines() if not re.match("Starting|Compiling|Hess Explorer is running", line)]
    assert any("example.org" in line for line in logged)
    assert all(re.match(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d[+-]\d{4} ", line) for line in logged), said


@pytest.mark.thorough
def test_no_worker_outlives_a_server_that_is_killed(tmp_path):
    with server_process(tmp_path / "log", UNWARMED, WORKERS) as (process, _):
        workers = below(process.pid)[1:]
        process.kill()
        process.wait()
        assert_gone(workers)


COMPILES = """
from hess_explorer.server.compiled import compiler

print("begun", flush=True)
with compiler("from hess_explorer.server.warm import compile_all; compile_all()") as process:
    process.wait()
"""


@pytest.mark.thorough
def test_the_compiler_beside_a_server_holds_none_of_its_pipes_and_ends_with_it(tmp_path):
    """Otherwise a reader of the server's output waited for minutes while kernels were compiled."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    with subprocess.Popen([sys.executable, "-c", COMPILES], env=environment, stdout=subprocess.PIPE) as server:
        assert server.stdout.readline() == b"begun\n"
        wait_until(lambda: below(server.pid)[1:] and list(tmp_path.rglob("*.nbi")))
        compilers = below(server.pid)[1:]
        server.kill()
        killed = time.monotonic()
        assert server.stdout.read() == b""
        assert time.monotonic() - killed < 2.0
        assert_gone(compilers)
