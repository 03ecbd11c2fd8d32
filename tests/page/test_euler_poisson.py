"""The scene "Euler–Poisson: sections" in a browser: long work, and Stop."""

import re

from playwright.sync_api import expect

from hess_explorer.protocol.specs import encode
from hess_explorer.scenes import scenes

EP = scenes()["euler-poisson"]
# Half a minute of work.
LONG = {"orbits": 400.0, "count": 4000.0, "long": 20.0, "span": 5.0, "h": 20.01, "indicator": "nothing"}


def test_a_long_section_fills_keeps_what_is_typed_in_its_box_and_can_be_stopped(explorer):
    page, typed = explorer.page, explorer.box("h")
    explorer.tell("restore", encode(EP.name, {**EP.defaults(), **LONG}))
    box = page.locator(".computing")
    shown = f"document.documentElement.dataset.scene === '{EP.name}'"
    page.wait_for_function(f"{shown} && hess.source('section-first').data.x?.length > 0", timeout=300_000)
    before = explorer.state
    typed.fill("43")
    # States of the section come between the keys.
    page.wait_for_function("state => Number(document.documentElement.dataset.state) > state + 1", arg=before)
    assert not explorer.ready
    assert typed.input_value() == "43"
    # Escape would stop it.
    typed.fill("20.01")
    bar = box.locator("progress")
    expect(bar).not_to_have_js_property("value", 0)
    assert float(bar.evaluate("bar => bar.value")) < float(bar.evaluate("bar => bar.max"))
    box.get_by_role("button").click()
    # Pieces already started are still drawn.
    page.wait_for_function("document.documentElement.dataset.ready === 'true'")
    found = re.search(r"Stopped: (\d+) of (\d+) parts are drawn\.", explorer.text("notes"))
    assert found
    done, total = map(int, found.groups())
    assert 0 < done < total
    expect(box).to_be_hidden()
