"""Measure the speed of the page and write the results to its README: `python tests/benchmarks/benchmark_page.py`.

Slider to four painted pictures: from the key's event to `data-ready`, in the page's own time, for moves
one after the other.  Drag: the mouse moves every 16 ms whether or not the page follows.
"""

from __future__ import annotations

import asyncio
import math
import os
import platform
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import date
from importlib.metadata import version
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

import numpy as np
from playwright.async_api import Browser, Page, async_playwright

from hess_explorer.headless.browser import find_browser
from hess_explorer.headless.screenshot import free_port
from hess_explorer.protocol.parameters import Number
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_mechanics import level, rotation_number_grid
from hess_mechanics.euler_poisson.andoyer import AndoyerSection
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.measured import write_measured
from support.processes import worked

ROOT = Path(__file__).resolve().parents[2]
MOVES = 45
PLAY_SECONDS = 5.0
SCENE = "suslov-hess"
READY = "document.documentElement.dataset.ready === 'true'"
STATE = "Number(document.documentElement.dataset.state)"

RECORD = """() => {
    let start = null
    let first = null
    document.addEventListener("keydown", () => { [start, first] = [performance.now(), null] }, true)
    new MutationObserver((changes) => {
        if (start === null) return
        const now = performance.now() - start
        if (changes.some(({ attributeName }) => attributeName === "data-state")) first ??= now
        if (document.documentElement.dataset.ready === "true") {
            window.times.push([first, now])
            start = null
        }
    }).observe(document.documentElement, { attributes: true, attributeFilter: ["data-ready", "data-state"] })
}"""


@contextmanager
def server(environment: dict[str, str]) -> Iterator[tuple[str, int]]:
    """The command of the README in a process of its own: its URL and number."""
    port = free_port()
    command = [sys.executable, "-m", "hess_explorer", "serve", "--port", str(port), "--no-browser"]
    with subprocess.Popen(
        command, cwd=ROOT, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        try:
            yield f"http://127.0.0.1:{port}", process.pid
        finally:
            process.terminate()


async def idle(pid: int) -> None:
    """Wait until the server has loaded all scenes and is idle."""
    before = -1.0
    while (now := worked(pid)) > before + 0.05:
        before = now
        await asyncio.sleep(2.0)


async def body_frame(browser: Browser, url: str) -> tuple[float, float]:
    """Milliseconds of the page's thread for a frame of the body alone that plays; the pace in frames a second."""
    page = await browser.new_page(viewport={"width": 1600, "height": 950}, reduced_motion="reduce")
    await page.goto(f"{url}/?scene={SCENE}&embed=1&pictures=body")
    await page.wait_for_function(READY, timeout=60_000)
    await page.locator(".param-play").click()
    session = await page.context.new_cdp_session(page)
    # CPU time of the thread, not wall time.
    await session.send("Performance.enable", {"timeDomain": "threadTicks"})

    async def busy() -> float:
        found = (await session.send("Performance.getMetrics"))["metrics"]
        return float(next(one["value"] for one in found if one["name"] == "TaskDuration"))

    await asyncio.sleep(1.0)
    before = await busy()
    frames = await page.evaluate(
        """async (ms) => {
        const end = performance.now() + ms
        let count = 0
        while (await new Promise(requestAnimationFrame) < end) count++
        return count
    }""",
        1e3 * PLAY_SECONDS,
    )
    spent = await busy() - before
    await page.close()
    return 1e3 * spent / frames, frames / PLAY_SECONDS


async def open_page(page: Page, url: str) -> None:
    """Open the page as soon as the server listens, and wait until its pictures are painted."""
    port = int(url.rsplit(":", 1)[1])
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), 0.2).close()
            break
        except OSError:
            await asyncio.sleep(0.02)
    await page.goto(f"{url}/?scene={SCENE}")
    await page.wait_for_function(READY, timeout=60_000)
    await page.locator("details.group").evaluate_all("groups => groups.forEach((group) => { group.open = true })")


async def slider_latencies(page: Page, name: str) -> tuple[list[float], list[float]]:
    """Milliseconds from each of `MOVES` key presses on a slider to the first painted pictures, and to all there is."""
    await page.evaluate("window.times = []")
    await page.locator(f".param-{name} input[type=range]").focus()
    for i in range(MOVES):
        await page.keyboard.press("ArrowRight")
        await page.wait_for_function(f"window.times.length === {i + 1}", timeout=10_000)
        await asyncio.sleep(0.03)
    firsts, times = zip(*(await page.evaluate("window.times")), strict=True)
    return sorted(firsts), sorted(times)


def spread(latencies: tuple[list[float], list[float]]) -> str:
    """Median and 95th percentile of sorted milliseconds; where more arrives later, also the median of that."""
    firsts, times = latencies
    high = firsts[math.ceil(0.95 * len(firsts)) - 1]
    whole = statistics.median(times)
    return f"median {statistics.median(firsts):.1f} ms, 95th percentile {high:.1f} ms" + (
        f"; complete after {whole:.0f} ms" if whole > 1.2 * statistics.median(firsts) else ""
    )


async def drag(page: Page, name: str) -> tuple[float, float, int]:
    """States painted per second in a drag of 3 s, ms from its end to rest, states painted after its end."""
    box = await page.locator(f".param-{name} input[type=range]").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    await page.mouse.move(x, y)
    await page.mouse.down()
    before, start = await page.evaluate(STATE), time.perf_counter()
    moves = []
    for n in range(int(3 / 0.016)):
        moves.append(asyncio.create_task(page.mouse.move(x + 40 * math.sin(n / 12), y)))
        await asyncio.sleep(0.016)
    await asyncio.gather(*moves)
    during, end = await page.evaluate(STATE), time.perf_counter()
    await page.mouse.up()
    await page.wait_for_function(READY)
    after = await page.evaluate(STATE)
    return (during - before) / (end - start), (time.perf_counter() - end) * 1e3, after - during


def grid_milliseconds() -> float:
    """Median of 20: the rotation number on 100 × 75 points of (h, f)."""
    h, f = np.linspace(-0.99, 4.0, 100), np.linspace(-3.0, 3.0, 75)
    rotation_number_grid(0.75, h, f, level("draft"))
    times = []
    for _ in range(20):
        start = time.perf_counter()
        rotation_number_grid(0.75, h, f, level("draft"))
        times.append((time.perf_counter() - start) * 1e3)
    return statistics.median(times)


def section_milliseconds() -> float:
    """Median of 5: 117 orbits × 400 crossings of the Andoyer–Deprit section of figure 11, at `standard`."""
    body = HeavyBody.hess((1.0, 0.625, 0.375), 9.975)
    starts = AndoyerSection(body, 50.0, 5.0).spread(((-math.pi, -1.0), (math.pi, 1.0)), 117)
    times = []
    for _ in range(6):
        start = time.perf_counter()
        AndoyerSection(body, 50.0, 5.0).points(starts, 400, level("standard"))
        times.append((time.perf_counter() - start) * 1e3)
    # The first one loads the kernel.
    return statistics.median(times[1:])


def map_milliseconds() -> float:
    """Median of 5: the rotation number on 300 × 200 tori of one plane, at `standard`, as in its scene."""
    h, f = (axis.ravel() for axis in np.meshgrid(np.linspace(-0.99, 4.0, 300), np.linspace(-3.0, 3.0, 200)))
    times = []
    for _ in range(6):
        start = time.perf_counter()
        values_at(0.5, h, f, level("standard"))
        times.append((time.perf_counter() - start) * 1e3)
    # The first one loads the kernel.
    return statistics.median(times[1:])


def state_milliseconds() -> tuple[float, float, float]:
    """Medians of 20: a new state with all pictures; a new φ0 only; a cached state."""
    scene = scenes()[SCENE]
    values = scene.defaults()
    medians = []
    for key in ("I23", "phi0", None):
        times = []
        for i in range(20):
            now = values if key is None else {**values, key: 0.1 + 0.01 * i}
            start = time.perf_counter()
            scene.compute(now, scene.pictures, False)
            times.append((time.perf_counter() - start) * 1e3)
        medians.append(statistics.median(times))
    return medians[0], medians[1], medians[2]


COMPILE = """
import sys, time
import numpy as np
import hess_mechanics
from hess_mechanics import circle_map
from hess_mechanics.suslov_hess import equations as hess
start = time.perf_counter()
which, level = sys.argv[1], hess_mechanics.level("draft")
body, state = hess_mechanics.systems()["hess"].example_motion
if which == "orbit": hess_mechanics.solve(body, state, [1.0], level)
if which == "ensemble": hess_mechanics.ensemble(body, [state], [1.0], level)
if which == "section": hess_mechanics.section(
    body, state, hess_mechanics.Plane((1.0, 0, 0, 0, 0)), 1.0, level)
if which == "circle map": hess_mechanics.circle_map(0.5, 1.5, 0.6, level).theta([0.0])
print(time.perf_counter() - start)
"""


def compile_seconds(script: str, what: str) -> tuple[float, float]:
    """Seconds until a script has its first result: compiled from nothing, and loaded from the cache."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "NUMBA_CACHE_DIR": folder, "PYTHONPATH": str(ROOT)}
        seconds = [
            float(
                subprocess.run(
                    [sys.executable, "-c", script, what], env=environment, capture_output=True, text=True, check=True
                ).stdout
            )
            for _ in range(2)
        ]
    return seconds[0], seconds[1]


# The first scene is compiled before any other, whatever page is opened.
COMPILE_SCENE = """
import gc, sys, time
gc.disable()
from hess_explorer.scenes import scenes
from hess_explorer.server.warm import compute
first, scene = next(iter(scenes().values())), scenes()[sys.argv[1]]
compute(first, folded=False)
start = time.perf_counter()
compute(scene, folded=False)
print(time.perf_counter() - start)
"""


def others() -> list[Scene]:
    """Return the scenes other than the first that do not study another scene."""
    return [scene for scene in scenes().values() if scene.origin is None and scene.name != SCENE]


async def enter(page: Page, name: str) -> float:
    """Milliseconds from the click in the menu of scenes to the first painted pictures; waits for all there is."""
    before = await page.evaluate(STATE)
    start = time.perf_counter()
    # The menu is open for a mouse; how long that takes is no matter here.
    await page.locator(f".param-scene-{name}").dispatch_event("click")
    await page.wait_for_function(f"document.documentElement.dataset.scene === '{name}' && {STATE} > {before}")
    painted = (time.perf_counter() - start) * 1e3
    await page.wait_for_function(READY)
    return painted


async def entries(page: Page, rested: Page, name: str) -> tuple[float, float, float]:
    """Milliseconds to enter a scene for the first time in a page: at once, after the mouse has rested on its picture
    for 0.4 s (in the second page), and the median of three more times."""
    first = await enter(page, name)
    await rested.locator(".param-scenes").click()
    await rested.locator(f".param-scene-{name}").hover()
    await asyncio.sleep(0.4)
    prepared = await enter(rested, name)
    again = []
    for _ in range(3):
        for one, times in ((SCENE, []), (name, again)):
            await asyncio.sleep(0.3)
            times.append(await enter(page, one))
    return first, prepared, statistics.median(again)


def processor() -> str:
    """Return the model name of the processor, if the system reports it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown")


async def measure() -> None:
    """Print the table."""
    rows: list[tuple[str, str, str]] = []
    async with async_playwright() as playwright:
        arguments = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        browser = await playwright.chromium.launch(
            executable_path=find_browser(playwright.chromium.executable_path), args=arguments
        )
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "NUMBA_CACHE_DIR": folder}
            for label, bar in (("first start, nothing compiled", "≤ 10 s"), ("start afterwards", "≤ 4 s")):
                seconds = []
                for _ in range(1 if "first" in label else 3):
                    start = time.perf_counter()
                    with server(environment) as (url, _):
                        page = await browser.new_page(viewport={"width": 1600, "height": 950}, reduced_motion="reduce")
                        await open_page(page, url)
                        seconds.append(time.perf_counter() - start)
                        await page.close()
                compile_everything = "from hess_explorer.server.warm import compile_all; compile_all()"
                subprocess.run([sys.executable, "-c", compile_everything], env=environment, check=True)
                rows.append((f"command to painted pictures, {label}", f"{statistics.median(seconds):.2f} s", bar))
            with server(environment) as (url, pid):
                page = await browser.new_page(viewport={"width": 1600, "height": 950}, reduced_motion="reduce")
                await open_page(page, url)
                await asyncio.sleep(1.5)
                await page.evaluate(RECORD)
                times = await slider_latencies(page, "h")
                rows.append(("slider h in the first seconds, other scenes not loaded yet", spread(times), ""))
                await idle(pid)
                frame, pace = await body_frame(browser, url)
                rows.append(
                    (
                        "the body alone, 1600×950, while it plays",
                        f"{frame:.1f} ms a frame, {pace:.0f} frames a second",
                        "≤ 4 ms",
                    )
                )
                for name in ("h", "I23"):
                    rows.append(
                        (
                            f"slider {name} to four painted pictures, {MOVES} moves",
                            spread(await slider_latencies(page, name)),
                            "≤ 33 ms, ≤ 66 ms",
                        )
                    )
                for name in ("h", "I23"):
                    rate, rest, queued = await drag(page, name)
                    rows.append(
                        (
                            f"drag of {name}, 3 s",
                            f"{rate:.1f} states a second, at rest {rest:.0f} ms after it ({queued} more states)",
                            "≥ 25 a second",
                        )
                    )
                await page.locator(".param-reset").click()
                await page.wait_for_function(READY)
                rested = await browser.new_page(viewport={"width": 1600, "height": 950}, reduced_motion="reduce")
                await open_page(rested, url)
                for scene in others():
                    first, prepared, again = await entries(page, rested, scene.name)
                    number = next(spec for spec in scene.specs if isinstance(spec, Number))
                    times = await slider_latencies(page, number.name)
                    await page.locator(".param-reset").click()
                    await page.wait_for_function(READY)
                    rows.append(
                        (
                            f"{scene.title}: entered at once, after a rest on its picture, once more",
                            f"{first:.0f} ms, {prepared:.0f} ms, {again:.0f} ms",
                            "≤ 300 ms",
                        )
                    )
                    rows.append((f"{scene.title}: slider {number.symbol}, {MOVES} moves", spread(times), "≤ 33 ms"))
        await browser.close()
    for kernel in ("orbit", "circle map", "ensemble", "section"):
        compiled, loaded = compile_seconds(COMPILE, kernel)
        rows.append((f"kernel of the {kernel}: compiled, loaded", f"{compiled:.1f} s, {loaded:.2f} s", ""))
    for scene in others():
        compiled, loaded = compile_seconds(COMPILE_SCENE, scene.name)
        rows.append(
            (
                f"{scene.title}: first state compiled after that of the first scene, loaded",
                f"{compiled:.1f} s, {loaded:.2f} s",
                "≤ 6 s",
            )
        )
    new, moved, cached = state_milliseconds()
    rows.append(
        ("computing a state: new body, new phase, from the cache", f"{new:.2f} ms, {moved:.2f} ms, {cached:.2f} ms", "")
    )
    rows.append(("rotation number on 100 × 75 (h, f)", f"{grid_milliseconds():.1f} ms", "≤ 100 ms"))
    rows.append(("rotation number on 300 × 200 (h, f), one core", f"{map_milliseconds():.0f} ms", "≤ 1 s"))
    rows.append(("section of figure 11, 117 orbits × 400 crossings", f"{section_milliseconds():.0f} ms", ""))
    versions = ", ".join(f"{name} {version(name)}" for name in ("panel", "bokeh", "holoviews", "numba", "numpy"))
    heading = f"{date.today()}, {processor()}, {os.cpu_count()} cores, Python {platform.python_version()}, {versions}."
    table = "\n".join("| " + " | ".join(row) + " |" for row in rows)
    write_measured(
        Path(__file__).with_name("README.md"), f"{heading}\n\n| what | measured | asked |\n|---|---|---|\n{table}"
    )


if __name__ == "__main__":
    asyncio.run(measure())
