"""A class at once: `python tests/manual/load.py 10 50 200` prints the cost of so many sessions.

Each session opens a scene, the scenes in turn, and changes one of its sliders every 2 s.  Then the same with one more
that asks for the dearest scene at `reference` without a pause.  `--drag 20`: all pages show the first scene, so many
drag a slider without a pause, and the others change one every 20 s.  `--leave 2000`: what is left of closed sessions.
`--followers 300`: a lecturer drags a slider for 20 s, in an empty room and in one of so many followers.
On a quiet machine: `python tests/manual/load.py 10 50 200 500 --workers 1 2 --leave 2000 --write`.
"""

import argparse
import asyncio
import gc
import itertools
import multiprocessing
import os
import random
import statistics
import sys
import time
from contextlib import asynccontextmanager, nullcontext
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from tornado.httpclient import AsyncHTTPClient

from hess_explorer.headless.screenshot import server_process
from hess_explorer.protocol.specs import NumberSpec
from hess_explorer.scenes import scenes
from support.measured import write_measured
from support.processes import memory, worked
from support.room import Follower, Lecturer
from support.visitor import Visitor

EVERY, RARELY, FRAME, PIECES = 2.0, 20.0, 0.016, 0.08
LOG = Path(os.devnull)
README = Path(__file__).resolve().parents[2] / "app" / "hess_explorer" / "server" / "README.md"
TURNS = 4
DEAREST = "scene=euler-poisson&accuracy=reference"


class Crowd:
    """A number of visitors that open the scenes in turn."""

    def __init__(self, base, names=()):
        self.base, self.visitors, self.errors = base, [], 0
        self.opened, self.answered, self.dragged = [], [], []
        self.names = names or [name for name, scene in scenes().items() if scene.origin is None]

    async def open(self, count):
        """Sixteen at a time, as browsers do that come within a few seconds."""
        room = asyncio.Semaphore(16)

        async def one(i):
            async with room:
                begun = time.monotonic()
                try:
                    visitor = await Visitor.open(self.base, f"scene={self.names[i % len(self.names)]}", timeout=120.0)
                    self.opened.append(time.monotonic() - begun)
                    self.visitors.append((self.names[i % len(self.names)], visitor))
                # Whatever it is, it counts.
                except Exception as error:
                    self.errors += 1
                    print(f"open: {error!r}", file=sys.stderr)

        begun = time.monotonic()
        await asyncio.gather(*(one(i) for i in range(count)))
        return time.monotonic() - begun

    async def use(self, seconds, seed, pause=EVERY, drag=0):
        """Change a value once in a pause, in the first `drag` pages every 16 ms; keep the times to the answers."""
        self.answered, self.dragged = [], []
        ends = time.monotonic() + seconds

        async def one(i, name, visitor):
            chance = random.Random(1000 * seed + i)
            every, answered = (FRAME, self.dragged) if i < drag else (pause, self.answered)
            specs = {spec.name: spec for spec in scenes()[name].specs}
            spec = next(specs[one] for one in scenes()[name].essential if isinstance(specs[one], NumberSpec))
            await asyncio.sleep(every * chance.random())
            while time.monotonic() < ends:
                begun = time.monotonic()
                try:
                    low, high = spec.softbounds
                    value = spec.default + 0.05 * (high - low) * (chance.random() - 0.5)
                    values = {spec.name: round(min(max(value, low), high), 6)}
                    await visitor.ask(timeout=60.0, values=values, held=i < drag)
                    answered.append(time.monotonic() - begun)
                    if i >= drag:
                        await rest(visitor, lambda: time.monotonic() > ends)
                except Exception as error:
                    self.errors += 1
                    print(f"{name}: {error!r}", file=sys.stderr)
                    return
                now = time.monotonic()
                await asyncio.sleep(max(0.0, min(begun + every, ends) - now))

        await asyncio.gather(*(one(i, *pair) for i, pair in enumerate(self.visitors)))

    async def leave(self):
        """Close all pages."""
        await asyncio.gather(*(visitor.leave() for _, visitor in self.visitors), return_exceptions=True)


async def rest(visitor, over):
    """Ask again as a page does at rest, upon which the server computes further, until all is known or it is over.

    The pauses are those of "page/client.js", but for the first one, which is shorter there.
    """
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
    """While the most expensive scene is in use."""
    until = asyncio.Event()
    other = asyncio.create_task(dear(base, until))
    try:
        yield
    finally:
        until.set()
        # It closes its page unless an answer takes long.
        await asyncio.wait({other}, timeout=1.0)
        other.cancel()


async def dear(base, until):
    """Send the most expensive request without a pause."""
    visitor = await Visitor.open(base, DEAREST, timeout=120.0)
    chance = random.Random(7)
    while not until.is_set():
        try:
            await visitor.ask(timeout=300.0, values={"h": round(chance.uniform(40.0, 60.0), 6)})
            await rest(visitor, until.is_set)
        except TimeoutError:
            continue
    await visitor.leave()


def _row(times):
    times = sorted(times) or [float("nan")]
    return statistics.median(times), times[min(len(times) - 1, int(0.95 * len(times)))]


async def _warm(base):
    """Let every process compute each scene with its background work, which is loaded once, not for a session."""
    warm = Crowd(base)
    await warm.open(5 * len(warm.names))
    await warm.use(4.0 * EVERY, 99)
    await asyncio.sleep(5.0)
    await warm.leave()


async def drags(base, pid, counts, drag, seconds):
    """Yield one line for each count of pages in the first scene, some of which drag its slider."""
    await _warm(base)
    await _prepared(pid)
    yield "| pages | dragging | states a second | p95 of those | p95 of others | worst | cores | memory each | errors |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for count in counts:
        await _expired(base)
        before, crowd = memory(pid), Crowd(base, [next(iter(scenes()))])
        await crowd.open(count)
        for beside in ("", ", beside one at reference"):
            async with beside_dearest(base) if beside else nullcontext():
                cpu, begun = worked(pid), time.monotonic()
                # Other values each time, which no cache holds.
                await crowd.use(seconds, count + bool(beside), RARELY, drag)
                share = (worked(pid) - cpu) / (time.monotonic() - begun)
                held = memory(pid)
            (_, dragged), (_, others) = _row(crowd.dragged), _row(crowd.answered)
            worst = max(crowd.answered + crowd.dragged)
            yield (
                f"| {count}{beside} | {drag} | {len(crowd.dragged) / seconds:.0f} | {1e3 * dragged:.0f} ms | "
                f"{1e3 * others:.0f} ms | {1e3 * worst:.0f} ms | {share:.2f} | "
                f"{(held - before) / count / 2**20:.2f} MB | {crowd.errors} |"
            )
        await crowd.leave()


async def measure(base, pid, counts, seconds):
    """Yield one line of the table for each count."""
    await _warm(base)
    yield "| sessions | opened in | median | p95 | cores | memory each | beside one at reference | errors |"
    yield "|---|---|---|---|---|---|---|---|"
    for count in counts:
        # The end of earlier sessions must not be measured.
        await _expired(base)
        before, crowd = memory(pid), Crowd(base)
        opening = await crowd.open(count)
        held, cpu, begun = memory(pid), worked(pid), time.monotonic()
        await crowd.use(seconds, count)
        share = (worked(pid) - cpu) / (time.monotonic() - begun)
        median, late = _row(crowd.answered)
        async with beside_dearest(base):
            await crowd.use(seconds, count + 1)
        both = _row(crowd.answered)
        await crowd.leave()
        yield (
            f"| {count} | {opening:.1f} s | {1e3 * median:.0f} ms | {1e3 * late:.0f} ms | {share:.2f} | "
            f"{(held - before) / max(1, count) / 2**20:.2f} MB | {1e3 * both[0]:.0f}, {1e3 * both[1]:.0f} ms | "
            f"{crowd.errors} |"
        )


async def counters(base):
    """Return the counters from `/metrics`."""
    answer = await AsyncHTTPClient().fetch(f"{base}/metrics")
    pairs = (line.split() for line in answer.body.decode().splitlines())
    return {name.partition("{")[0].removeprefix("hess_explorer_"): int(value) for name, value in pairs}


async def _expired(base):
    """Return the `counters` after closed sessions have expired."""
    ends = time.monotonic() + 240.0
    while (found := await counters(base))["sessions"] > 0 and time.monotonic() < ends:
        await asyncio.sleep(2.0)
    return found


async def leave(base, pid, count):
    """Open and close this many sessions; yield a table of the resources that remain after they expire."""
    warm = Crowd(base)
    await warm.open(len(warm.names))
    await warm.leave()
    yield "| opened and left | memory | sessions | websockets | threads | errors |"
    yield "|---|---|---|---|---|---|"
    done = errors = 0
    for part in (0, *[count // 4] * 4):
        crowd = Crowd(base)
        while len(crowd.opened) + crowd.errors < part:
            # No more at a time than find room, and each as short as it can be.
            await crowd.open(min(50, part - len(crowd.opened) - crowd.errors))
            await crowd.leave()
            crowd.visitors.clear()
        done, errors = done + len(crowd.opened), errors + crowd.errors
        found = await _expired(base)
        yield (
            f"| {done} | {memory(pid) / 2**20:.0f} MB | {found['sessions']} | {found['websockets']} | "
            f"{found['threads']} | {errors} |"
        )


async def drag(visitor, lecturer, seconds):
    """Drag a slider to and fro, as a browser does; return the times to the answers and the last state."""
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
        await asyncio.sleep(0.016)
    await lecturer.show(state["query"], picture="omega")
    return answered, state["query"]


class Audience:
    """The followers of a room, and when each of them had the state that it shows."""

    def __init__(self):
        self.followers, self.reading, self.errors = [], [], 0
        self.arrived = {}

    async def join(self, base, code, count):
        """Open the page and the websocket, sixteen at a time."""
        door = asyncio.Semaphore(16)

        async def one():
            async with door:
                await AsyncHTTPClient().fetch(f"{base}/r/{code}")
                follower = await Follower.follow(base, code)
                self.followers.append(follower)
                self.reading.append(asyncio.create_task(self._read(follower)))

        begun = time.monotonic()
        await asyncio.gather(*(one() for _ in range(count)))
        return time.monotonic() - begun

    async def _read(self, follower):
        try:
            while True:
                told = await follower.hear(timeout=600.0)
                if "state" in told:
                    self.arrived[follower] = told["state"]["query"], time.monotonic()
        # Whatever it is, it counts.
        except Exception as error:
            self.errors += 1
            print(f"follower: {error!r}", file=sys.stderr)

    async def all_at(self, query, since, timeout=30.0):
        """Return how long after `since` each follower had a state."""
        ends = time.monotonic() + timeout
        while sum(shown == query for shown, _ in self.arrived.values()) < len(self.followers):
            if time.monotonic() > ends:
                break
            await asyncio.sleep(0.05)
        return [when - since for shown, when in self.arrived.values() if shown == query]


async def _follow(pipe, base, code, count):
    audience = Audience()
    pipe.send(await audience.join(base, code, count))
    query, since = await asyncio.get_running_loop().run_in_executor(None, pipe.recv)
    pipe.send((await audience.all_at(query, since), audience.errors))
    await asyncio.get_running_loop().run_in_executor(None, pipe.recv)
    # The connections end with this process, which is no error.
    for reading in audience.reading:
        reading.cancel()


def _audience(pipe, base, code, count):
    """Hold an audience in a process of its own: phones take no time of the lecturer's browser, nor of the server."""
    os.nice(19)
    gc.disable()
    asyncio.run(_follow(pipe, base, code, count))


async def _prepared(pid, timeout=600.0):
    """Wait until the server has prepared its scenes and rests: at first that takes more time than a lecture."""
    ends, share = time.monotonic() + timeout, 1.0
    while share > 0.02 and time.monotonic() < ends:
        before, begun = worked(pid), time.monotonic()
        await asyncio.sleep(5.0)
        share = (worked(pid) - before) / (time.monotonic() - begun)


async def lecture(base, pid, count, seconds):
    """Yield a table: a lecturer who drags a slider in an empty room and before an audience, in turn."""
    visitor = await Visitor.open(base, "scene=suslov-hess", timeout=120.0)
    empty, full = await Lecturer.open(base), await Lecturer.open(base)
    # As a browser does; otherwise pings have no answer.
    heard = [asyncio.create_task(lecturer.end(3600.0)) for lecturer in (empty, full)]
    await drag(visitor, empty, 5.0)
    await _prepared(pid)
    yield "| followers | joined in | alone | with them | p95 ratio | cores | at the last state | memory each | errors |"
    yield "|---|---|---|---|---|---|---|---|---|"
    before = memory(pid)
    pipe, theirs = multiprocessing.Pipe()
    hall = multiprocessing.get_context("spawn").Process(target=_audience, args=(theirs, base, full.code, count))
    hall.start()
    wait = asyncio.get_running_loop().run_in_executor
    joined = await wait(None, pipe.recv)
    # In turn, so that other work on the machine slows down both.
    answered, cores = {empty: [], full: []}, {empty: 0.0, full: 0.0}
    for lecturer in [empty, full] * TURNS:
        cpu = worked(pid)
        times, query = await drag(visitor, lecturer, seconds / TURNS)
        since = time.monotonic()
        answered[lecturer] += times
        cores[lecturer] += (worked(pid) - cpu) / seconds
    pipe.send((query, since))
    times, errors = await wait(None, pipe.recv)
    errors += sum(one.done() for one in heard)
    held, late, alone, together = memory(pid), _row(times), _row(answered[empty]), _row(answered[full])
    pipe.send("end")
    hall.join()
    yield (
        f"| {len(times)} of {count} | {joined:.1f} s | {1e3 * alone[0]:.0f}, {1e3 * alone[1]:.0f} ms | "
        f"{1e3 * together[0]:.0f}, {1e3 * together[1]:.0f} ms | {together[1] / alone[1]:.2f} | "
        f"{cores[empty]:.2f}, {cores[full]:.2f} | "
        f"{late[0]:.2f}, {late[1]:.2f} s | {(held - before) / count / 2**20:.2f} MB | {errors} |"
    )
    await visitor.leave()
    for one in heard:
        one.cancel()


async def _printed(rows, kept):
    async for row in rows:
        print(row, flush=True)
        kept.append(row)


def _processor():
    """Ticks of all cores until now: in all, and those that the host of a virtual machine gave to others."""
    ticks = [*map(int, Path("/proc/stat").read_text().splitlines()[0].split()[1:9])]
    return sum(ticks), ticks[7]


def _machine(before, ticks):
    total, stolen = (now - then for now, then in zip(_processor(), ticks, strict=True))
    return (
        f"{os.cpu_count()} cores, on which the visitors ran too, {100.0 * stolen / total:.0f} % of them taken by "
        f"the host; load of the machine before {before:.1f}, after {os.getloadavg()[0]:.1f}; "
        f"{time.strftime('%Y-%m-%d')}."
    )


def main():
    """Serve and measure."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("counts", type=int, nargs="*")
    parser.add_argument("--seconds", type=float, default=20.0, help="of each of the two parts")
    parser.add_argument("--drag", type=int, default=0, metavar="N", help="so many pages of one scene drag its slider")
    parser.add_argument("--leave", type=int, default=0, metavar="N", help="also open and leave so many sessions")
    parser.add_argument("--followers", type=int, default=0, metavar="N", help="also hold a lecture before so many")
    parser.add_argument("--workers", type=int, nargs="+", default=[1], help="processes that serve, one table for each")
    parser.add_argument("--write", action="store_true", help="keep what is printed in the README of the server")
    options = parser.parse_args()
    # The visitors stand for two hundred browsers, which do not stop all at once to look for garbage.
    gc.disable()
    kept, before, ticks = [], os.getloadavg()[0], _processor()

    def serve(title, rows, workers=1):
        """Start a server, and print and keep the rows of a table; rows(base, pid) yields them."""
        kept.extend([title, ""])
        with server_process(LOG, options=["--workers", str(workers)]) as (process, base):
            time.sleep(2.0)
            asyncio.run(_ready(base))
            asyncio.run(_printed(rows(base, process.pid), kept))
        kept.append("")

    for workers in options.workers:
        served = f"served by {workers} process{'es' * (workers > 1)}"
        if options.drag:
            dragged = f"All pages in one scene, some of them dragging, {served}:"
            serve(dragged, lambda *server: drags(*server, options.counts, options.drag, options.seconds), workers)
        elif options.counts:
            serve(f"A class, {served}:", lambda *server: measure(*server, options.counts, options.seconds), workers)
    if options.followers:
        lectured = "A lecture, served by 1 process (median, p95; cores of the server):"
        serve(lectured, lambda *server: lecture(*server, options.followers, options.seconds))
    if options.leave:
        left = f"{options.leave} sessions opened and left, after each quarter has expired:"
        serve(left, lambda *server: leave(*server, options.leave))
    kept.append(_machine(before, ticks))
    print(kept[-1])
    if options.write:
        write_measured(README, "\n".join(kept))


async def _ready(base):
    """Wait until the server answers."""
    ends = time.monotonic() + 120.0
    while True:
        try:
            return await (await Visitor.open(base)).leave()
        except OSError:
            if time.monotonic() > ends:
                raise
            await asyncio.sleep(0.2)


if __name__ == "__main__":
    main()
