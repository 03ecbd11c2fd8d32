"""A server of one's own: its chart; the page as an installed app, which says what to do when the server has stopped."""

import io
from urllib.request import urlopen

import pytest
from PIL import Image

from hess_explorer.headless.browser import wait_ready
from hess_explorer.headless.screenshot import server_process
from hess_explorer.sweep import sweep
from support.processes import UNWARMED

REGISTERED = "navigator.serviceWorker.getRegistrations().then((found) => found.length)"
KEPT = """
caches.keys().then((names) => Promise.all(names.map((name) => caches.open(name).then((one) => one.keys()))))
  .then((found) => found.flat().map((one) => one.url))
"""


@pytest.mark.thorough
def test_a_page_opens_the_chart_of_its_server_and_an_installed_app_says_what_to_do_when_that_has_stopped(
    browser, tmp_path
):
    sweep("rotation-number", {"h": (-0.5, 2.0, 6), "f": (-1.0, 1.0, 5)}, a=0.25, store=tmp_path / "rho.zarr")
    with server_process(tmp_path / "log", UNWARMED, ["--chart", str(tmp_path / "rho.zarr")]) as (process, url):
        context = browser.new_context()
        page = context.new_page()
        page.goto(f"{url}/?scene=suslov-hess")
        wait_ready(page)
        page.get_by_text("6 × 5, precise accuracy").wait_for(timeout=60_000)
        assert page.get_by_text("Chart: ρ").is_visible()
        assert page.locator("link[rel=manifest]").get_attribute("href") == "app.webmanifest"
        manifest = page.evaluate("fetch('app.webmanifest').then((one) => one.json())")
        assert (manifest["display"], manifest["scope"]) == ("standalone", "./")
        for icon in manifest["icons"]:
            with urlopen(f"{url}/{icon['src']}") as found:
                assert "x".join(map(str, Image.open(io.BytesIO(found.read())).size)) == icon["sizes"]
        # A window of the browser needs no worker; one that is embedded never has one.
        assert page.evaluate(REGISTERED) == 0
        page.evaluate("window.dispatchEvent(new Event('appinstalled'))")
        page.evaluate("navigator.serviceWorker.ready.then(() => null)")
        assert page.evaluate(KEPT) == [f"{url}/offline.html"]
        # With the worker the page is as before, and nothing else is kept.
        page.reload()
        wait_ready(page)
        assert page.evaluate("navigator.serviceWorker.controller !== null")
        assert page.evaluate(KEPT) == [f"{url}/offline.html"]
        process.terminate()
        process.wait(60)
        page.goto(f"{url}/?scene=suslov")
        assert page.locator("h1").inner_text() == "Hess Explorer is not running"
        assert "hess-explorer" in page.locator("code").inner_text()
        context.close()
