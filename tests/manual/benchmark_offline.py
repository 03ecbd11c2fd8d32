"""Bytes, opening and dragging of pages without a server: `python tests/manual/benchmark_offline.py`.

It rewrites the table of tests/manual/offline.md.
"""

import statistics
import sys
import tempfile
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.headless.browser import headless_browser
from hess_explorer.lessons import package_lessons
from hess_explorer.offline.pages import lesson_page, state_page
from manual.timing import report

README = Path(__file__).with_name("offline.md")
COUNT, ROUNDS = 40, 5
# In the page's own time, which begins with its address.
READY = """new MutationObserver(() => {
    if (document.documentElement?.dataset.ready === "true") window.painted ??= performance.now()
}).observe(document, { subtree: true, attributeFilter: ["data-ready"] })"""
# Moves the slider of h there and back as fast as states are painted.
DRAG = """async ([low, high, count]) => {
    const { body } = await fetch(`data:;base64,${document.getElementById("code").textContent}`)
    const { page } = await new Response(body.pipeThrough(new DecompressionStream("deflate"))).json()
    const { "base/bus.js": { tell } } = await import(page)
    let painted = null
    new MutationObserver(() => painted?.()).observe(document.documentElement, { attributeFilter: ["data-state"] })
    const times = []
    tell("animated", true)
    for (let i = 0; i < count; i++) {
        const begun = performance.now()
        const next = new Promise((resolve) => { painted = resolve })
        tell("change", { h: low + (high - low) * (i + 1) / count })
        await next
        await new Promise(requestAnimationFrame)
        times.push(performance.now() - begun)
    }
    tell("animated", false)
    return times
}"""


def opened(browser, path):
    """Seconds until the first picture and until all, and those of each state of a drag; None without a slider of h."""
    context = browser.new_context(viewport={"width": 1600, "height": 950}, offline=True, reduced_motion="reduce")
    page = context.new_page()
    page.add_init_script(READY)
    page.goto(path.as_uri())
    page.wait_for_selector("html[data-ready=true]", state="attached")
    first, whole = page.evaluate("[performance.getEntriesByName('first picture')[0].startTime, window.painted]")
    slider = page.locator(".controls .param-h .hand")
    drag = None
    if slider.count():
        page.wait_for_timeout(500)
        ends = slider.evaluate("({ min, max }) => [Number(min), Number(max)]")
        drag = [one / 1000 for one in page.evaluate(DRAG, [*ends, COUNT])]
    context.close()
    return first / 1000, whole / 1000, drag


def pages():
    """Yield name and contents of the measured pages."""
    count = 2 * COUNT
    yield f"*Suslov–Hess*, h with {count} values", state_page("h=1.2&f=0.3", sliders=[f"h=0.2:3.5:{count}"])[1]
    lesson = package_lessons()["limit-cycles-and-locking"]
    yield f"lesson *{lesson.title}*, {COUNT} values", lesson_page(lesson, COUNT)


def main():
    """Measure for some minutes."""
    rows = []
    with headless_browser() as browser, tempfile.TemporaryDirectory() as folder:
        for i, (name, content) in enumerate(pages()):
            path = Path(folder) / f"{i}.html"
            path.write_bytes(content)
            firsts, wholes, dragged = zip(*(opened(browser, path) for _ in range(ROUNDS)), strict=True)
            drags = [time for drag in dragged for time in drag or ()]
            rate = f"{1 / statistics.median(drags):.0f}" if drags else "–"
            seconds = [f"{statistics.median(times):.1f}" for times in (firsts, wholes)]
            rows.append([name, f"{len(content) / 1e6:.1f}", *seconds, rate])
    head = ["page", "MB", "s to the first picture", "s to all", "states a second in a drag"]
    report(head, rows, README)


if __name__ == "__main__":
    main()
