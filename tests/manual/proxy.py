"""The Caddyfile for real: `python tests/manual/proxy.py` ends one of two replicas behind Caddy with TLS.

Needs `caddy` (Debian: apt-get install caddy).  A visitor opens the page by https, is kept with its replica, loses it,
and opens its own link again at the other one.
"""

import asyncio
import json
import os
import re
import shutil
import signal
import ssl
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from tornado.httpclient import AsyncHTTPClient, HTTPRequest

from hess_explorer.headless.screenshot import free_port, server_process
from support.asynchronous import wait_until
from support.processes import UNWARMED, below
from support.room import Follower, Lecturer
from support.visitor import Visitor

ROOT = Path(__file__).resolve().parents[2]


def connections(process):
    """Return the number of open connections of all processes of a replica."""
    return sum(
        str(link.readlink()).startswith("socket:")
        for one in below(process.pid)
        for link in Path(f"/proc/{one}/fd").iterdir()
    )


async def visit(base, trusted, replicas):
    """Run the checks and print each result."""

    async def get(path):
        try:
            return await AsyncHTTPClient().fetch(HTTPRequest(f"{base}/{path}", ssl_options=trusted), raise_error=False)
        except OSError:
            # Caddy has no certificate yet.
            return None

    ends = time.monotonic() + 60.0
    while getattr(await get("liveness"), "code", None) != 200:
        assert time.monotonic() < ends, "the proxy does not answer"
        await asyncio.sleep(0.2)
    first, counters = await get(""), await get("metrics")
    cookie = re.search("explorer=[0-9a-f]+", first.headers["Set-Cookie"])[0]
    print(
        f"TLS; Set-Cookie: {cookie[:16]}…; /metrics: {counters.code}; "
        f"Strict-Transport-Security: {first.headers['Strict-Transport-Security']}"
    )
    visitor = await Visitor.open(base, "scene=kharlamova&accuracy=draft", headers={"Cookie": cookie}, trusted=trusted)
    state = await visitor.ask(values={"b1": 0.7})
    link = state["query"]
    print(f"websocket through the proxy: {json.dumps(link)[:90]}…")
    # Rooms of both replicas; nobody in them has a cookie.
    for _ in range(8):
        lecturer = await Lecturer.open(base, trusted=trusted)
        followers = [await Follower.follow(base, lecturer.code, trusted=trusted) for _ in range(4)]
        await lecturer.show(link)
        for follower in followers:
            await follower.until(lambda one: one.state["query"] == link)
        for member in (*followers, lecturer):
            await member.leave()
    print("eight rooms with four followers each: all at the lecturer's state")
    # The replica that serves this visitor ends; the other one goes on.
    serving, other = sorted(replicas, key=connections, reverse=True)
    begun = time.monotonic()
    serving.send_signal(signal.SIGTERM)
    heard = (await visitor.end(20.0))[0]
    print(f"the replica ends with {serving.wait(20)} after {time.monotonic() - begun:.1f} s; the page hears “{heard}”")
    assert other.poll() is None
    begun = time.monotonic()
    again = await Visitor.open(base, link, headers={"Cookie": cookie}, trusted=trusted)
    print(f"the same state at the other replica after {time.monotonic() - begun:.1f} s: {again.state['query'] == link}")
    await again.leave()
    await visitor.leave()


def main():
    """Start everything, visit, end it."""
    caddy = shutil.which("caddy")
    if caddy is None:
        sys.exit("There is no caddy here: apt-get install caddy.")
    with tempfile.TemporaryDirectory() as place, ExitStack() as stack:
        folder, host = Path(place), f"localhost:{free_port()}"
        options = ["--allow-origin", host]
        started = [stack.enter_context(server_process(folder / f"{n}.log", UNWARMED, options)) for n in range(2)]
        settings = {
            "EXPLORER_HOST": host,
            "EXPLORER_REPLICAS": " ".join(base.removeprefix("http://") for _, base in started),
            **dict.fromkeys(("XDG_DATA_HOME", "XDG_CONFIG_HOME"), str(folder)),
        }
        # Port 80, to which others may listen, is not needed here, and nobody's list of trust is changed.
        changed = "{\n\tauto_https disable_redirects\n\tskip_install_trust\n\tadmin off\n}\n"
        (folder / "Caddyfile").write_text(changed + (ROOT / "app/deployment/Caddyfile").read_text())
        log = stack.enter_context((folder / "caddy.log").open("wb"))
        words = [caddy, "run", "--adapter", "caddyfile", "--config", "Caddyfile"]
        proxy = subprocess.Popen(words, env={**os.environ, **settings}, cwd=folder, stdout=log, stderr=log)
        stack.callback(proxy.terminate)
        root = folder / "caddy/pki/authorities/local/root.crt"
        wait_until(root.exists)
        asyncio.run(visit(f"https://{host}", ssl.create_default_context(cafile=str(root)), [one for one, _ in started]))


if __name__ == "__main__":
    main()
