"""Measure the time to paint bodies and tori: `python tests/benchmarks/benchmark_body.py`; it asserts nothing.

Each frame turns the picture by a key and reads a pixel back, so that all that was drawn is painted by then: in headless
Chromium without a graphics card, at the size that the picture has on the page of 1600×950.
"""

import statistics
from pathlib import Path

from playwright.sync_api import sync_playwright

from hess_explorer.headless.browser import find_browser, wait_ready
from hess_explorer.headless.screenshot import server_process

FRAMES = """async ([kind, keys, count]) => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap((item) =>
    [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
  const canvas = all(document).find((item) => item.matches(`.gallery:not(.away) canvas.${kind}`))
  const ctx = canvas.getContext("2d")
  const reset = ctx.reset.bind(ctx)
  let begun = null
  ctx.reset = () => {
    begun = performance.now()
    reset()
  }
  const times = []
  for (let i = 0; i < count; i++) {
    const key = `Arrow${keys[i % 2]}`
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, composed: true }))
    await new Promise(requestAnimationFrame)
    ctx.getImageData(0, 0, 1, 1)
    if (begun !== null) times.push(performance.now() - begun)
    begun = null
  }
  return [canvas.width, times]
}"""


ACROSS, UP = ("Left", "Right"), ("Up", "Down")
PICTURES = (
    *(("solid", ACROSS, f"scene={scene}") for scene in ("suslov-hess", "quartic", "ball-section", "loxodrome")),
    # 600 pixels.  Without a density, turning across shades nothing anew.
    ("torus", UP, "scene=suslov-hess&large=surface"),
    ("torus", ACROSS, "scene=suslov-hess&large=surface"),
    ("torus", ACROSS, "scene=suslov-hess&large=surface&h=0.2&f=0.5&span=200&shade=invariant+density"),
)


def main():
    """Print the median and the minimum frame time of some pictures."""
    with sync_playwright() as playwright, server_process(Path("/dev/null")) as (_, base):
        browser = playwright.chromium.launch(
            executable_path=find_browser(playwright.chromium.executable_path), args=["--no-sandbox"]
        )
        page = browser.new_page(viewport={"width": 1600, "height": 950}, reduced_motion="reduce")
        for kind, keys, query in PICTURES:
            page.goto(f"{base}/?{query}&t=10")
            wait_ready(page)
            width, times = page.evaluate(FRAMES, [kind, keys, 200])
            median, least = statistics.median(times), min(times)
            print(f"{query}, {keys[0]}: {width} px, median {median:.1f} ms, least {least:.1f} ms")
        browser.close()


if __name__ == "__main__":
    main()
