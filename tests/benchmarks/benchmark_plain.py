"""Measure each scene beside a plain Panel page: `python tests/benchmarks/benchmark_plain.py`, some seven minutes.

Slider to painted pictures in the pages' own time, in turns; where the time of a state goes; frames while it plays.
"""

import asyncio
import os
import sys
from math import ceil
from pathlib import Path
from statistics import median

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from playwright.async_api import async_playwright

from benchmarks.benchmark_page import (
    MOVES,
    PLAIN,
    PLAIN_READY,
    READY,
    RECORD,
    SCENE,
    enter,
    hand,
    idle,
    launched,
    opened,
    others,
    painted,
    pressed,
    server,
    tab,
)
from benchmarks.integrators.machine import conditions
from hess_explorer.protocol.parameters import Number
from hess_explorer.scenes import scenes
from support.measured import table, write_measured
from support.modules import look_inside

SECONDS = 20

# From a key until all four plots are painted.
RECORD_PLAIN = """() => {
    const plots = []
    const search = (view) => {
        if (view.repainted) plots.push(view)
        for (const one of view.children_views?.() ?? []) search(one)
    }
    for (const root of Bokeh.index.roots) search(root)
    let [start, left] = [null, new Set()]
    document.addEventListener("keydown", () => { [start, left] = [performance.now(), new Set(plots)] }, true)
    for (const plot of plots) plot.repainted.connect(() => {
        left.delete(plot)
        if (start === null || left.size > 0) return
        window.times.push(performance.now() - start)
        start = null
    })
    return plots.length
}"""

# Times at which a state passes the stages of the page.
TRACE = """() => {
    const stages = (window.stages = [])
    let [state, last] = [null, 0]
    const mark = (name) => {
        if (state === null) return
        const now = performance.now()
        state[name] = (state[name] ?? 0) + now - last
        last = now
    }
    document.addEventListener("keydown", () => { [state, last] = [{}, performance.now()] }, true)
    window.marked = mark
    for (const plot of hess.plots) {
        const { pause, unpause, paint } = plot
        plot.pause = () => { if (!plot.is_paused) mark("decode"); pause.call(plot) }
        plot.unpause = (...how) => { mark("unpack, fill, texts"); unpause.apply(plot, how) }
        plot.paint = () => { paint.call(plot); mark(`plot ${plot.model.name}`) }
    }
    hess.listen("paint", () => mark("body, sphere and torus"))
    new MutationObserver(() => {
        if (state === null) return
        mark("rest")
        stages.push(state)
        state = null
    }).observe(document.documentElement, { attributeFilter: ["data-state"] })
}"""
SOCKET = """window.WebSocket = class extends WebSocket {
    constructor(...where) {
        super(...where)
        this.addEventListener("message", () => window.marked?.("server and line"))
    }

    send(...data) {
        window.marked?.("page, until the request")
        super.send(...data)
    }
}"""

PLAY = """async (ms) => {
    const end = performance.now() + ms
    const times = []
    let last = await new Promise(requestAnimationFrame)
    while (last < end) {
        const now = await new Promise(requestAnimationFrame)
        times.push(now - last)
        last = now
    }
    return times
}"""


async def beside(plain, page):
    """Rows of each scene beside the plain page; the first scene is also the last, when its code has been compiled."""
    first, rows = scenes()[SCENE], []
    for scene in [first, *others(), first]:
        name = "h"
        if scene is not first:
            await enter(page, scene.name)
            numbers = [spec.name for spec in scene.specs if isinstance(spec, Number)]
            # One may be without effect.
            name, *_ = [one for one in numbers if await hand(page, one).is_enabled()]
        elif rows:
            await enter(page, SCENE)
        await plain.bring_to_front()
        theirs = await pressed(plain, plain.get_by_role("slider").first)
        await page.bring_to_front()
        ours = await pressed(page, hand(page, name))
        ratios = [f"{one / other:.2f}" for one, other in zip(ours, theirs, strict=True)]
        row = [f"{one:.0f} ms" for one in (*ours, *theirs)]
        print(scene.name, *row, *ratios, flush=True)
        rows.append([f"{scene.title}, once more" if scene is first and rows else scene.title, name, *row, *ratios])
    return rows


async def stages(browser, url):
    """Rows of the stages of a state, in the order of their time."""
    page = await tab(browser)
    await look_inside(page)
    await page.add_init_script(SOCKET)
    await page.goto(f"{url}/?scene={SCENE}")
    await page.wait_for_function(f"{READY} && window.hess !== undefined")
    await page.evaluate(TRACE)
    await hand(page, "h").focus()
    for _ in range(MOVES):
        await page.keyboard.press("ArrowRight")
        await page.wait_for_function(READY)
        await asyncio.sleep(0.03)
    found = await page.evaluate("window.stages")
    await page.close()
    times = {name: median(one.get(name, 0.0) for one in found) for name in set().union(*found)}
    return [[name, f"{time:.1f} ms"] for name, time in sorted(times.items(), key=lambda pair: -pair[1])]


async def played(browser, url):
    """A sentence on the frames while it plays."""
    page = await browser.new_page(viewport={"width": 1600, "height": 950})
    await page.goto(f"{url}/?scene={SCENE}")
    await page.wait_for_function(READY)
    # The opening motion may play already: then the click has ended it.
    await page.locator(".param-play").click()
    if await page.locator(".player[data-playing=true]").count() == 0:
        await page.locator(".param-play").click()
    times = sorted(await page.evaluate(PLAY, 1e3 * SECONDS))
    await page.close()
    late = sum(time > 50 for time in times)
    return (
        f"{len(times) / SECONDS:.0f} frames a second in {SECONDS} s of play; 95 % take at most "
        f"{times[ceil(0.95 * len(times)) - 1]:.0f} ms, {late} more than 50 ms, the longest {times[-1]:.0f} ms."
    )


async def measure():
    """Measure all, and write it."""
    async with async_playwright() as playwright:
        browser = await launched(playwright)
        environment = dict(os.environ)
        with server(environment) as (url, pid), server(environment, (PLAIN,)) as (other, _):
            page = await opened(browser, url)
            await page.evaluate(RECORD)
            await idle(pid)
            plain = await painted(browser, other, PLAIN_READY)
            assert await plain.evaluate(RECORD_PLAIN) == 4
            rows = await beside(plain, page)
            await plain.close()
            await page.close()
            parts = [await stages(browser, url), await played(browser, url)]
        await browser.close()
    head = ["scene", "slider", "median", "95 %", "plain: median", "95 %", "ratio", "of the 95 %"]
    text = [conditions(), table(head, rows), table(["stage of a state of *Suslov–Hess*", "median"], parts[0]), parts[1]]
    print("\n\n".join(text))
    write_measured(Path(__file__).with_name("plain.md"), "\n\n".join(text))


if __name__ == "__main__":
    asyncio.run(measure())
