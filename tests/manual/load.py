"""A class at once: `python tests/manual/load.py 10 50 200` prints the cost of so many sessions.

Each session opens a scene, the scenes in turn, and changes one of its sliders every 2 s; then the same beside one that
asks for the dearest scene at `reference` without a pause.  `--drag 20`: all pages show the first scene, so many drag a
slider without a pause, and the others change one every 20 s.  `--leave 2000`: what is left of closed sessions.
`--followers 300`: a lecturer drags a slider for 20 s, in an empty room and in one of so many followers.
"""

import argparse
import asyncio
import itertools
import os
import random
import statistics
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from contextlib import asynccontextmanager, nullcontext
from multiprocessing import get_context
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from tornado.httpclient import AsyncHTTPClient

from hess_explorer.headless.screenshot import server_process
from hess_explorer.protocol.specs import NumberSpec
from hess_explorer.scenes import scenes
from manual.timing import conditions
from support.measured import line, table
from support.processes import memory, worked
from support.room import Follower, Lecturer
from support.visitor import Closed, Visitor

EVERY, RARELY, FRAME, PIECES = 2.0, 20.0, 0.016, 0.08
DEAREST = "scene=euler-poisson&accuracy=reference"
MB = 2**20


async def sixteen_at_a_time(count, make):
    """Await make(i) for each i, sixteen at a time, as browsers do that come within a few seconds."""
    door = asyncio.Semaphore(16)

    async def one(i):
        async with door:
            return await make(i)

    return await asyncio.gather(*map(one, range(count)))


class Crowd:
    """A number of visitors that open the scenes in turn."""

    def __init__(self, base, names=()):
        self.base, self.visitors, self.errors = base, [], 0
        self.names = names or [name for name, scene in scenes().items() if scene.origin is None]

    def failed(self, error):
        """Count an error, whatever it is."""
        self.errors += 1
        print(f"{error!r}", file=sys.stderr)

    async def open(self, count):
        """Open the pages; return the seconds until all are there."""

        async def one(i):
            name = self.names[i % len(self.names)]
            try:
                self.visitors.append((name, await Visitor.open(self.base, f"scene={name}", timeout=120.0)))
            except Exception as error:
                self.failed(error)

        begun = time.monotonic()
        await sixteen_at_a_time(count, one)
        return time.monotonic() - begun

    async def use(self, seconds, pause=EVERY, drag=0):
        """Change a value once in a pause, in the first `drag` pages every 16 ms; return the times to the answers."""
        answered, dragged, ends = [], [], time.monotonic() + seconds

        async def one(i, name, visitor):
            held = i < drag
            every, times = (FRAME, dragged) if held else (pause, answered)
            specs = {spec.name: spec for spec in scenes()[name].specs}
            spec = next(specs[one] for one in scenes()[name].essential if isinstance(specs[one], NumberSpec))
            low, high = spec.softbounds
            await asyncio.sleep(every * random.random())
            while time.monotonic() < ends:
                begun = time.monotonic()
                value = spec.default + 0.05 * (high - low) * (random.random() - 0.5)
                try:
                    values = {spec.name: round(min(max(value, low), high), 6)}
                    await visitor.ask(timeout=60.0, values=values, held=held)
                    times.append(time.monotonic() - begun)
                    if not held:
                        await rest(visitor, lambda: time.monotonic() > ends)
                except Exception as error:
                    self.failed(error)
                    return
                await asyncio.sleep(max(0.0, min(begun + every, ends) - time.monotonic()))

        await asyncio.gather(*(one(i, *pair) for i, pair in enumerate(self.visitors)))
        return answered, dragged

    async def leave(self):
        """Close all pages."""
        await asyncio.gather(*(visitor.leave() for _, visitor in self.visitors), return_exceptions=True)
        self.visitors.clear()


async def rest(visitor, over):
    """Ask again as a page does at rest (`static/page/client.js`), until all is known or it is over."""
    progress, news, took = visitor.state["progress"], time.monotonic(), 0.0
    while progress is not None and not over():
        await asyncio.sleep(max(PIECES, took, 0.25 * (time.monotonic() - news)))
        begun = time.monotonic()
        state = await visitor.ask(timeout=300.0)
        took = time.monotonic() - begun
        if state["progress"] != progress:
            progress, news = state["progress"], time.monotonic()


@asynccontextmanager
async def beside_dearest(base):
    """While another session requests the most expensive scene without a pause."""
    over = asyncio.Event()

    async def ask():
        visitor = await Visitor.open(base, DEAREST, timeout=120.0)
        while not over.is_set():
            await visitor.ask(timeout=300.0, values={"h": round(random.uniform(40.0, 60.0), 6)})
            await rest(visitor, over.is_set)
        await visitor.leave()

    asking = asyncio.create_task(ask())
    try:
        yield
    finally:
        over.set()
        await asyncio.wait({asking}, timeout=1.0)
        asking.cancel()


def _ms(times):
    """Return median and 95th percentile in milliseconds, as a text."""
    if not times:
        return "–"
    late = sorted(times)[int(0.95 * (len(times) - 1))]
    return f"{1e3 * statistics.median(times):.0f}, {1e3 * late:.0f} ms"


async def _quiet(pid):
    """Wait until the server has prepared its scenes and rests."""
    share = 1.0
    while share > 0.02:
        before = worked(pid)
        await asyncio.sleep(5.0)
        share = (worked(pid) - before) / 5.0


async def _expired(base):
    """Return the counters of `/metrics` once closed sessions have expired."""
    ends = time.monotonic() + 240.0
    while True:
        answer = await AsyncHTTPClient().fetch(f"{base}/metrics")
        pairs = (one.split() for one in answer.body.decode().splitlines())
        found = {name.partition("{")[0].removeprefix("hess_explorer_"): int(value) for name, value in pairs}
        if found["sessions"] == 0 or time.monotonic() > ends:
            return found
        await asyncio.sleep(2.0)


async def crowds(base, pid, counts, drag, seconds):
    """Yield the lines of the table of classes, alone and beside the most expensive scene."""
    # Every process loads each scene once, not for a session.
    warm = Crowd(base)
    await warm.open(5 * len(warm.names))
    await warm.use(4.0 * EVERY)
    await warm.leave()
    await _quiet(pid)
    head = ["sessions", "dragging", "opened in", "median, p95", "of those who drag", "states a second", "cores"]
    yield "\n" + table([*head, "memory each", "errors"], [])
    for count in counts:
        await _expired(base)
        before, crowd = memory(pid), Crowd(base, [next(iter(scenes()))] if drag else ())
        opened = await crowd.open(count)
        for beside in ("", ", beside one at reference"):
            async with beside_dearest(base) if beside else nullcontext():
                cpu = worked(pid)
                answered, dragged = await crowd.use(seconds, RARELY if drag else EVERY, drag)
                cores, each = (worked(pid) - cpu) / seconds, (memory(pid) - before) / count / MB
            cells = [f"{count}{beside}", str(drag), f"{opened:.1f} s", _ms(answered), _ms(dragged)]
            rate = f"{len(dragged) / seconds:.0f}" if drag else "–"
            yield line([*cells, rate, f"{cores:.2f}", f"{each:.2f} MB", str(crowd.errors)])
        await crowd.leave()


async def leave(base, pid, count):
    """Open and close this many sessions; yield a table of the resources that remain after they expire."""
    yield "\n" + table(["opened and left", "memory", "sessions", "websockets", "threads", "errors"], [])
    crowd, done = Crowd(base), 0
    for part in (len(crowd.names), *[count // 4] * 4):
        for first in range(0, part, 50):
            # No more at a time than find room, and each as short as it can be.
            await crowd.open(min(50, part - first))
            await crowd.leave()
        done += part
        found = await _expired(base)
        left = [str(found[name]) for name in ("sessions", "websockets", "threads")]
        yield line([str(done), f"{memory(pid) / MB:.0f} MB", *left, str(crowd.errors)])


def audience(base, code, count):
    """Follow a room until it ends, in a process of its own; return each follower's last query and when it came."""
    os.nice(19)

    async def one(_):
        await AsyncHTTPClient().fetch(f"{base}/r/{code}")
        return await Follower.follow(base, code)

    async def last(follower):
        found = None, 0.0
        try:
            while True:
                told = await follower.hear(timeout=600.0)
                if "state" in told:
                    found = told["state"]["query"], time.monotonic()
        except Closed:
            return found

    async def follow():
        return await asyncio.gather(*map(last, await sixteen_at_a_time(count, one)))

    return asyncio.run(follow())


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
    """Yield a table: a lecturer who drags a slider in an empty room and before an audience, in turn."""
    visitor = await Visitor.open(base, "scene=suslov-hess", timeout=120.0)
    empty, full = await Lecturer.open(base), await Lecturer.open(base)
    await drag_to(visitor, empty, 5.0)
    await _quiet(pid)
    yield "\n" + table(["followers", "alone: median, p95", "with them", "last state: median, p95", "memory each"], [])
    before = memory(pid)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        followers = asyncio.get_running_loop().run_in_executor(pool, audience, base, full.code, count)
        await full.until(lambda one: one.followers == count, timeout=120.0)
        # As a browser does; otherwise pings have no answer.
        heard = [asyncio.create_task(lecturer.end(3600.0)) for lecturer in (empty, full)]
        answered = {empty: [], full: []}
        for lecturer in [empty, full] * 4:
            times, query = await drag_to(visitor, lecturer, seconds / 4)
            answered[lecturer] += times
        since = time.monotonic()
        await asyncio.sleep(30.0)
        each = (memory(pid) - before) / count / MB
        await full.say({"end": True})
        late = [when - since for shown, when in await followers if shown == query]
    cells = [f"{len(late)} of {count}", _ms(answered[empty]), _ms(answered[full]), _ms(late), f"{each:.2f} MB"]
    yield line(cells)
    await visitor.leave()
    for one in heard:
        one.cancel()


def main():
    """Serve and measure."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("counts", type=int, nargs="*")
    parser.add_argument("--seconds", type=float, default=20.0, help="of each of the two parts")
    parser.add_argument("--drag", type=int, default=0, metavar="N", help="so many pages of one scene drag its slider")
    parser.add_argument("--leave", type=int, default=0, metavar="N", help="also open and leave so many sessions")
    parser.add_argument("--followers", type=int, default=0, metavar="N", help="also hold a lecture before so many")
    parser.add_argument("--workers", type=int, default=1, help="processes that serve")
    options = parser.parse_args()

    async def show(rows):
        async for row in rows:
            print(row, flush=True)

    print(f"{conditions()}, load {os.getloadavg()[0]:.1f}; {options.workers} serving.\n")
    with server_process(Path(os.devnull), options=["--workers", str(options.workers)]) as (process, base):
        there = base, process.pid
        if options.counts:
            asyncio.run(show(crowds(*there, options.counts, options.drag, options.seconds)))
        if options.followers:
            asyncio.run(show(lecture(*there, options.followers, options.seconds)))
        if options.leave:
            asyncio.run(show(leave(*there, options.leave)))


if __name__ == "__main__":
    main()
