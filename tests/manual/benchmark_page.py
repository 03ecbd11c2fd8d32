"""Measure the speed of the page and write the results to its README: `python tests/manual/benchmark_page.py`.

Drag: the mouse moves every 16 ms whether or not the page follows.
"""

import asyncio
import os
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from importlib.metadata import version
from math import ceil, sin
from pathlib import Path
from statistics import median
from urllib.parse import urlsplit

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from playwright.async_api import async_playwright

from hess_explorer.headless.browser import find_browser
from hess_explorer.headless.screenshot import free_port
from hess_explorer.scenes import scenes
from manual.integrators.machine import conditions
from support.measured import table, write_measured
from support.processes import worked

ROOT = Path(__file__).resolve().parents[2]
PLAIN = Path(__file__).with_name("plain_page.py")
SERVE = ("-m", "hess_explorer", "serve", "--no-browser", "--port")
MOVES = 45
SCENE = "suslov-hess"
PLAIN_READY = "window.Bokeh?.documents[0]?.is_idle"
READY = "document.documentElement.dataset.ready === 'true'"
STATE = "Number(document.documentElement.dataset.state)"

# Milliseconds from a key to the first painted pictures.
RECORD = """() => {
    let start = null
    document.addEventListener("keydown", () => { start = performance.now() }, true)
    new MutationObserver(() => {
        if (start === null) return
        window.times.push(performance.now() - start)
        start = null
    }).observe(document.documentElement, { attributeFilter: ["data-state"] })
}"""


@contextmanager
def server(environment, command=SERVE):
    """The command of the README in a process of its own, or another one: its URL and number."""
    port = free_port()
    command = [sys.executable, *command, str(port)]
    nowhere = subprocess.DEVNULL
    with subprocess.Popen(command, cwd=ROOT, env=environment, stdout=nowhere, stderr=nowhere) as process:
        try:
            yield f"http://127.0.0.1:{port}", process.pid
        finally:
            process.terminate()


async def idle(pid):
    """Wait until the server has loaded all scenes and is idle."""
    before = -1.0
    while (now := worked(pid)) > before + 0.05:
        before = now
        await asyncio.sleep(2.0)


async def launched(playwright):
    """The browser of all measurements."""
    return await playwright.chromium.launch(
        executable_path=find_browser(playwright.chromium.executable_path),
        args=["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else [],
    )


async def tab(browser):
    """An empty page of the size of all measurements."""
    return await browser.new_page(viewport={"width": 1600, "height": 950}, reduced_motion="reduce")


async def painted(browser, url, ready=READY):
    """The page, as soon as the server listens and its pictures are painted."""
    page, port = await tab(browser), urlsplit(url).port
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), 0.2).close()
            break
        except OSError:
            await asyncio.sleep(0.02)
    await page.goto(url)
    await page.wait_for_function(ready, timeout=60_000)
    return page


async def opened(browser, url):
    """The page of the first scene, painted and with all its controls."""
    page = await painted(browser, f"{url}/?scene={SCENE}")
    await unfold(page)
    return page


async def unfold(page):
    """Open all groups of controls of the scene on show."""
    await page.locator("details.group").evaluate_all("groups => groups.forEach((group) => { group.open = true })")


def hand(page, name):
    """The slider of a parameter."""
    return page.locator(f".param-{name} input[type=range]")


async def pressed(page, slider):
    """Median and 95th percentile of the milliseconds from a key on a slider to painted pictures, for `MOVES` keys."""
    await page.evaluate("window.times = []")
    await slider.focus()
    for i in range(MOVES):
        await page.keyboard.press("ArrowRight")
        await page.wait_for_function(f"window.times.length === {i + 1}", timeout=10_000)
        await asyncio.sleep(0.03)
    times = sorted(await page.evaluate("window.times"))
    return median(times), times[ceil(0.95 * MOVES) - 1]


async def drag(page, name):
    """States painted per second in a drag of 3 s, the time from its end to rest, states painted after its end."""
    box = await hand(page, name).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    await page.mouse.move(x, y)
    await page.mouse.down()
    before, start = await page.evaluate(STATE), time.perf_counter()
    moves = []
    for n in range(int(3 / 0.016)):
        moves.append(asyncio.create_task(page.mouse.move(x + 40 * sin(n / 12), y)))
        await asyncio.sleep(0.016)
    await asyncio.gather(*moves)
    during, end = await page.evaluate(STATE), time.perf_counter()
    await page.mouse.up()
    await page.wait_for_function(READY)
    rest, queued = (time.perf_counter() - end) * 1e3, await page.evaluate(STATE) - during
    rate = (during - before) / (end - start)
    return f"{rate:.1f} states a second, at rest {rest:.0f} ms after it ({queued} more states)"


async def enter(page, name):
    """Milliseconds from the click in the menu of scenes to the first painted pictures; waits for all there is."""
    before, start = await page.evaluate(STATE), time.perf_counter()
    # The menu is open for a mouse; how long that takes is no matter here.
    await page.locator(f".param-scene-{name}").dispatch_event("click")
    await page.wait_for_function(f"document.documentElement.dataset.scene === '{name}' && {STATE} > {before}")
    painted = (time.perf_counter() - start) * 1e3
    await page.wait_for_function(READY, timeout=90_000)
    await unfold(page)
    return painted


async def entries(page, rested, name):
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
    return f"{first:.0f} ms, {prepared:.0f} ms, {median(again):.0f} ms"


def others():
    """Return the scenes other than the first that do not study another scene."""
    return [scene for scene in scenes().values() if scene.origin is None and scene.name != SCENE]


async def starts(browser, environment):
    """Rows of the time from the command to painted pictures, in the end beside a plain page."""

    async def start(command=SERVE, ready=READY):
        begun = time.perf_counter()
        with server(environment, command) as (url, _):
            page = await painted(browser, url, ready)
            seconds = time.perf_counter() - begun
            await page.close()
        return seconds

    yield "command to painted pictures, first start, nothing compiled", f"{await start():.2f} s", "≤ 6 s"
    compile_everything = "from hess_explorer.server.warm import compile_all; compile_all()"
    subprocess.run([sys.executable, "-c", compile_everything], env=environment, check=True)
    await start((PLAIN,), PLAIN_READY)
    # In turns, since the machine's speed varies.
    pairs = [(await start(), await start((PLAIN,), PLAIN_READY)) for _ in range(5)]
    ours, plain = (median(times) for times in zip(*pairs, strict=True))
    yield "start afterwards", f"{ours:.2f} s", "≤ 2.5 s"
    yield "the same, a plain Panel page with four plots", f"{plain:.2f} s; ratio {ours / plain:.2f}", ""


async def in_the_page(browser, url, pid):
    """Rows of what is done in an open page."""
    page = await opened(browser, url)
    await idle(pid)
    for name in ("h", "I23"):
        yield f"drag of {name}, 3 s", await drag(page, name), "≥ 25 a second"
    await page.locator(".param-reset").click()
    await page.wait_for_function(READY)
    rested = await opened(browser, url)
    for scene in others():
        entered = await entries(page, rested, scene.name)
        yield f"{scene.title}: entered at once, after a rest on its picture, once more", entered, "≤ 1.5 s"


async def measure():
    """Measure all, and write the table."""
    async with async_playwright() as playwright:
        browser = await launched(playwright)
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "NUMBA_CACHE_DIR": folder}
            rows = [row async for row in starts(browser, environment)]
            with server(environment) as (url, pid):
                rows += [row async for row in in_the_page(browser, url, pid)]
        await browser.close()
    versions = ", ".join(f"{name} {version(name)}" for name in ("panel", "bokeh", "holoviews", "numba", "numpy"))
    text = f"{conditions()}, {versions}.\n\n{table(['what', 'measured', 'asked'], rows)}"
    write_measured(Path(__file__).with_name("README.md"), text)


if __name__ == "__main__":
    asyncio.run(measure())
