"""A class at once: `python tests/manual/load.py 10 50 200` prints the cost of so many sessions, one after the other.

Each session opens a scene, the scenes in turn, and changes one of its sliders every 2 s; then the same beside one that
asks for the dearest scene at `reference` without a pause.  `--drag 20`: all pages show the first scene, so many drag a
slider without a pause, and the others change one every 20 s.  `--followers 300`: a lecturer drags a slider for 20 s, in
an empty room and in one of so many followers.  `load.py 500 500 500 500 --seconds 1` shows what closed sessions leave.
"""

import argparse
import asyncio
import itertools
import os
import random
import sys
import time
from contextlib import suppress
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from tornado.httpclient import AsyncHTTPClient

from hess_explorer.headless.screenshot import server_process
from hess_explorer.protocol.specs import NumberSpec
from hess_explorer.scenes import scenes
from manual.timing import conditions, milliseconds, wait_idle
from support.measured import line, table
from support.processes import memory, worked
from support.room import Follower, Lecturer
from support.visitor import Closed, Visitor

EVERY, RARELY, FRAME, PIECES = 2.0, 20.0, 0.016, 0.08
DEAREST = "euler-poisson&accuracy=reference"
MB = 2**20


async def sixteen_at_a_time(count, make):
    """Await make(i) for each i, sixteen at a time, as browsers do that come within a few seconds."""
    door = asyncio.Semaphore(16)

    async def one(i):
        async with door:
            return await make(i)

    return await asyncio.gather(*map(one, range(count)))


async def rest(visitor, ends):
    """Ask again as a page does at rest (`static/page/client.js`), until all is known or the time has come."""
    while visitor.state["progress"] is not None and time.monotonic() < ends:
        await asyncio.sleep(PIECES)
        await visitor.ask(timeout=300.0)


async def change(visitor, scene, every, ends, held=False):
    """Change a number of a scene once in so many seconds; return the times to the answers."""
    specs = {spec.name: spec for spec in scenes()[scene].specs}
    spec = next(specs[one] for one in scenes()[scene].essential if isinstance(specs[one], NumberSpec))
    (low, high), times = spec.softbounds, []
    await asyncio.sleep(every * random.random())
    while time.monotonic() < ends:
        begun = time.monotonic()
        value = spec.default + 0.05 * (high - low) * (random.random() - 0.5)
        await visitor.ask(timeout=300.0, values={spec.name: round(min(max(value, low), high), 6)}, held=held)
        times.append(time.monotonic() - begun)
        if not held:
            await rest(visitor, ends)
        await asyncio.sleep(max(0.0, min(begun + every, ends) - time.monotonic()))
    return times


async def left(base):
    """Wait until closed sessions have expired."""
    ends, found = time.monotonic() + 240.0, None
    while found != 0 and time.monotonic() < ends:
        answer = await AsyncHTTPClient().fetch(f"{base}/metrics")
        lines = answer.body.decode().splitlines()
        found = sum(int(one.split()[1]) for one in lines if one.startswith("hess_explorer_sessions"))
        await asyncio.sleep(2.0)


async def crowds(base, pid, counts, drag, seconds):
    """Print a table of classes, alone and beside the most expensive scene."""
    names = [name for name, scene in scenes().items() if scene.origin is None]
    head = ["sessions", "dragging", "opened in", "median, p95", "of those who drag", "states a second", "cores"]
    print(table([*head, "memory before", "memory each"], []))
    # Every process loads each scene once, not for a session: the first row has that too.
    for count in (5 * len(names), *counts):
        await left(base)
        wait_idle(pid)
        before, begun = memory(pid), time.monotonic()
        shown = names[:1] if drag else names
        own = [shown[i % len(shown)] for i in range(count)]
        visitors = await sixteen_at_a_time(
            count, lambda i, own=own: Visitor.open(base, f"scene={own[i]}", timeout=120.0)
        )
        opened = time.monotonic() - begun
        for beside in ("", ", beside one at reference"):
            cpu, ends = worked(pid), time.monotonic() + seconds
            dear = await Visitor.open(base, f"scene={DEAREST}", timeout=120.0) if beside else None
            asking = asyncio.create_task(change(dear, "euler-poisson", 0.0, ends)) if beside else None
            pauses = [FRAME] * drag + [RARELY if drag else EVERY] * (count - drag)
            found = await asyncio.gather(
                *(
                    change(visitor, scene, pause, ends, pause == FRAME)
                    for visitor, scene, pause in zip(visitors, own, pauses, strict=True)
                )
            )
            dragged, answered = (list(itertools.chain(*part)) for part in (found[:drag], found[drag:]))
            cores, each = (worked(pid) - cpu) / seconds, (memory(pid) - before) / count / MB
            cells = [f"{count}{beside}", str(drag), f"{opened:.1f} s", milliseconds(answered), milliseconds(dragged)]
            last = [f"{len(dragged) / seconds:.0f}", f"{cores:.2f}", f"{before / MB:.0f} MB", f"{each:.2f} MB"]
            print(line([*cells, *last]), flush=True)
            if beside:
                await asking
                await dear.leave()
        await asyncio.gather(*(visitor.leave() for visitor in visitors))


async def audience(base, code, count):
    """Follow a room until it ends; return each follower's last query and when it came."""

    async def follow(_):
        await AsyncHTTPClient().fetch(f"{base}/r/{code}")
        return await Follower.follow(base, code)

    async def last(follower):
        found = None, 0.0
        with suppress(Closed):
            while True:
                told = await follower.hear(timeout=600.0)
                if "state" in told:
                    found = told["state"]["query"], time.monotonic()
        return found

    return await asyncio.gather(*map(last, await sixteen_at_a_time(count, follow)))


async def drag_to(visitor, lecturer, seconds):
    """Drag a slider to and fro, as a browser does; return the times to the answers and the last query."""
    answered, shown, ends = [], 0.0, time.monotonic() + seconds
    values = itertools.cycle([round(1.0 + 0.005 * abs(i), 3) for i in range(-100, 100)])
    while time.monotonic() < ends:
        begun = time.monotonic()
        state = await visitor.ask(values={"h": next(values)}, held=True)
        answered.append(time.monotonic() - begun)
        # Four times a second, as "page/room.js".
        if begun - shown > 0.25:
            shown = begun
            await lecturer.show(state["query"], picture="omega")
        await asyncio.sleep(FRAME)
    await lecturer.show(state["query"], picture="omega")
    return answered, state["query"]


async def lecture(base, pid, count, seconds):
    """Print a table: a lecturer who drags a slider in an empty room and before an audience, in turn."""
    visitor = await Visitor.open(base, "scene=suslov-hess", timeout=120.0)
    empty, full = await Lecturer.open(base), await Lecturer.open(base)
    await drag_to(visitor, empty, 5.0)
    wait_idle(pid)
    before = memory(pid)
    followers = asyncio.create_task(audience(base, full.code, count))
    await full.until(lambda one: one.followers == count, timeout=120.0)
    # As a browser does; otherwise pings have no answer.
    heard = [asyncio.create_task(lecturer.end(3600.0)) for lecturer in (empty, full)]
    answered = {empty: [], full: []}
    for lecturer in [empty, full] * 4:
        times, query = await drag_to(visitor, lecturer, seconds / 4)
        answered[lecturer] += times
    since = time.monotonic()
    await asyncio.sleep(10.0)
    each = (memory(pid) - before) / count / MB
    await full.say({"end": True})
    late = [when - since for shown, when in await followers if shown == query]
    cells = [f"{len(late)} of {count}", *map(milliseconds, (*answered.values(), late)), f"{each:.2f} MB"]
    head = ["followers", "alone: median, p95", "with them", "last state: median, p95", "memory each"]
    print(table(head, [cells]))
    for one in heard:
        one.cancel()
    await visitor.leave()


def main():
    """Serve and measure."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("counts", type=int, nargs="*")
    parser.add_argument("--seconds", type=float, default=20.0, help="of each of the two parts")
    parser.add_argument("--drag", type=int, default=0, metavar="N", help="so many pages of one scene drag its slider")
    parser.add_argument("--followers", type=int, default=0, metavar="N", help="also hold a lecture before so many")
    parser.add_argument("--workers", type=int, default=1, help="processes that serve")
    given = parser.parse_args()
    print(f"{conditions()}, load {os.getloadavg()[0]:.1f}; {given.workers} serving.\n")
    with server_process(Path(os.devnull), options=["--workers", str(given.workers)]) as (process, base):
        if given.counts:
            asyncio.run(crowds(base, process.pid, given.counts, given.drag, given.seconds))
        if given.followers:
            asyncio.run(lecture(base, process.pid, given.followers, given.seconds))


if __name__ == "__main__":
    main()
