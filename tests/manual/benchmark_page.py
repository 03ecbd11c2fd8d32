"""Speed of the page: `python tests/manual/benchmark_page.py` writes the table of tests/manual/README.md."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1])]

from hess_explorer.headless.browser import headless_browser, wait_ready
from hess_explorer.headless.screenshot import server_process
from hess_explorer.scenes import scenes
from manual.timing import report, wait_idle
from support.page import FIND, HESS, own_tab

NOWHERE = Path(os.devnull)
# The slider goes to and fro for 3 s, every 16 ms whether or not the page follows: states a second, and ms to the rest.
DRAG = f"""async name => {{
  const slider = ({FIND})(name, "range"), {{ dataset }} = document.documentElement
  const pause = (ms) => new Promise((done) => setTimeout(done, ms))
  const tell = (kind) => slider.dispatchEvent(new Event(kind, {{ bubbles: true }}))
  const middle = (Number(slider.min) + Number(slider.max)) / 2, wide = 0.1 * (slider.max - slider.min)
  const before = Number(dataset.state), begun = performance.now()
  for (let n = 0; performance.now() < begun + 3000; n++) {{
    slider.value = middle + wide * Math.sin(n / 12)
    tell("input")
    await pause(16)
  }}
  const rate = (Number(dataset.state) - before) / 3, ended = performance.now()
  tell("change")
  while (dataset.ready !== "true") await pause(1)
  return [rate, performance.now() - ended]
}}"""


def start(browser):
    """Return the seconds from the command to painted pictures."""
    begun = time.perf_counter()
    with server_process(NOWHERE) as (_, base), own_tab(browser, base) as tab:
        tab.open()
        return time.perf_counter() - begun


def entered(tab, name):
    """Return the milliseconds from the click in the menu of scenes to the first painted pictures; wait for the rest."""
    before, begun = tab.state, time.perf_counter()
    # The menu is open for a mouse; how long that takes is no matter here.
    tab.page.locator(f".param-scene-{name}").dispatch_event("click")
    root = "document.documentElement.dataset"
    tab.page.wait_for_function(f"{root}.scene === '{name}' && Number({root}.state) > {before}")
    painted = 1e3 * (time.perf_counter() - begun)
    wait_ready(tab.page)
    return painted


def in_the_page(tab):
    """Yield the rows of what is done in an open page."""
    for name in ("h", "I23"):
        rate, rest = tab.page.evaluate(DRAG, name)
        yield f"drag of {name}, 3 s", f"{rate:.1f} states a second, at rest {rest:.0f} ms after it"
    for scene in scenes().values():
        if scene.origin is None and scene.name != HESS:
            first, again = entered(tab, scene.name), []
            for _ in range(3):
                entered(tab, HESS)
                again.append(entered(tab, scene.name))
            yield f"{scene.title}: entered, and once more", f"{first:.0f} ms, {median(again):.0f} ms"


def main():
    """Measure all, and write the table."""
    with headless_browser() as browser, tempfile.TemporaryDirectory() as folder:
        os.environ["NUMBA_CACHE_DIR"] = folder
        rows = [("command to painted pictures, nothing compiled", f"{start(browser):.2f} s")]
        compile_everything = "from hess_explorer.server.warm import compile_all; compile_all()"
        subprocess.run([sys.executable, "-c", compile_everything], check=True)
        rows.append(("start afterwards", f"{median(start(browser) for _ in range(5)):.2f} s"))
        with server_process(NOWHERE) as (process, base), own_tab(browser, base) as tab:
            tab.open()
            wait_idle(process.pid)
            rows += in_the_page(tab)
    report(["what", "measured"], rows, Path(__file__).with_name("README.md"))


if __name__ == "__main__":
    main()
