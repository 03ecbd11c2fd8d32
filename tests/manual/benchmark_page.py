"""Speed of the page: `python tests/manual/benchmark_page.py` writes the table of tests/manual/README.md.

Drag: the mouse moves every 16 ms whether or not the page follows.
"""

import asyncio
import os
import subprocess
import sys
import tempfile
import time
from contextlib import asynccontextmanager
from math import sin
from pathlib import Path
from statistics import median

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from playwright.async_api import async_playwright

from hess_explorer.headless.browser import find_browser, is_root
from hess_explorer.headless.screenshot import server_process
from hess_explorer.scenes import scenes
from manual.timing import conditions
from support.measured import table, write_measured
from support.processes import worked

SCENE = "suslov-hess"
READY = "document.documentElement.dataset.ready === 'true'"
STATE = "Number(document.documentElement.dataset.state)"


@asynccontextmanager
async def opened(browser, base):
    """The page of the first scene, once it is painted."""
    page = await browser.new_page(viewport={"width": 1600, "height": 950}, reduced_motion="reduce")
    await page.goto(f"{base}/?scene={SCENE}")
    await page.wait_for_function(READY, timeout=60_000)
    yield page
    await page.close()


async def start(browser):
    """Return the seconds from the command to painted pictures."""
    begun = time.perf_counter()
    with server_process(Path(os.devnull)) as (_, base):
        async with opened(browser, base):
            return time.perf_counter() - begun


async def idle(pid):
    """Wait until the server has loaded all scenes and is idle."""
    before = -1.0
    while (now := worked(pid)) > before + 0.05:
        before = now
        await asyncio.sleep(2.0)


async def drag(page, name):
    """Return the states painted per second in a drag of 3 s, and the time from its end to rest."""
    box = await page.locator(f".param-{name} input[type=range]").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    await page.mouse.move(x, y)
    await page.mouse.down()
    before, begun = await page.evaluate(STATE), time.perf_counter()
    moves = []
    for n in range(int(3 / 0.016)):
        moves.append(asyncio.create_task(page.mouse.move(x + 40 * sin(n / 12), y)))
        await asyncio.sleep(0.016)
    await asyncio.gather(*moves)
    during, ended = await page.evaluate(STATE), time.perf_counter()
    await page.mouse.up()
    await page.wait_for_function(READY)
    rate, rest = (during - before) / (ended - begun), time.perf_counter() - ended
    return f"{rate:.1f} states a second, at rest {1e3 * rest:.0f} ms after it"


async def enter(page, name):
    """Return the milliseconds from the click in the menu of scenes to the first painted pictures; wait for the rest."""
    before, begun = await page.evaluate(STATE), time.perf_counter()
    # The menu is open for a mouse; how long that takes is no matter here.
    await page.locator(f".param-scene-{name}").dispatch_event("click")
    await page.wait_for_function(f"document.documentElement.dataset.scene === '{name}' && {STATE} > {before}")
    painted = 1e3 * (time.perf_counter() - begun)
    await page.wait_for_function(READY, timeout=90_000)
    return painted


async def in_the_page(browser, base, pid):
    """Yield the rows of what is done in an open page."""
    async with opened(browser, base) as page:
        await idle(pid)
        await page.locator("details.group").evaluate_all("groups => groups.forEach((group) => { group.open = true })")
        for name in ("h", "I23"):
            yield f"drag of {name}, 3 s", await drag(page, name)
        for scene in scenes().values():
            if scene.origin is None and scene.name != SCENE:
                first = await enter(page, scene.name)
                again = []
                for _ in range(3):
                    await enter(page, SCENE)
                    again.append(await enter(page, scene.name))
                yield scene.title, f"{first:.0f} ms, {median(again):.0f} ms"


async def main():
    """Measure all, and write the table."""
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(
            executable_path=find_browser(playwright.chromium.executable_path),
            args=["--no-sandbox"] if is_root() else [],
        )
        with tempfile.TemporaryDirectory() as folder:
            os.environ["NUMBA_CACHE_DIR"] = folder
            rows = [("command to painted pictures, nothing compiled", f"{await start(browser):.2f} s")]
            compile_everything = "from hess_explorer.server.warm import compile_all; compile_all()"
            subprocess.run([sys.executable, "-c", compile_everything], check=True)
            times = [await start(browser) for _ in range(5)]
            rows.append(("start afterwards", f"{median(times):.2f} s"))
            with server_process(Path(os.devnull)) as (process, base):
                rows += [row async for row in in_the_page(browser, base, process.pid)]
    text = f"{conditions()}.\n\n{table(['what', 'measured'], rows)}"
    print(text)
    write_measured(Path(__file__).with_name("README.md"), text)


if __name__ == "__main__":
    asyncio.run(main())
