"""Sharing: the page's link, its QR code, and parts of the page embedded in another one."""

from urllib.parse import parse_qsl, quote, urlsplit

import pytest

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from hess_explorer.server.qr_code import MOST
from support.accessible import assert_accessible
from support.barcode import read
from support.modules import look_inside
from support.page import ALL, HESS, Explorer, own_tab, wait_frames
from support.thorough import sample

# Names of the pictures and of the controls that are to be seen, and their notes.
SHOWN = """() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap(
    (item) => [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])
  const seen = all(document).filter((item) => item.checkVisibility({ visibilityProperty: true }))
  const named = (selector) => seen.filter((item) => item.matches(selector))
  return {
    pictures: named(".picture").map((item) => item.dataset.name).sort(),
    controls: named(".number, .menu").flatMap(({ classList }) => [...classList])
      .filter((name) => name.startsWith("param-")).map((name) => name.slice(6)).sort(),
    others: named(".tools, .words, .legend, .tabs, .derived, .status").length,
    player: named(".player[role=group]").length,
    notes: named(".text.notes").map((item) => item.textContent).join(),
  }
}"""

# Boxes of the squares of the pictures and of the controls that are to be seen.
BOXES = f"""() => {{
  {ALL}
  return all(document).filter((item) => item.matches(".picture > .host, .number, .menu") && item.checkVisibility())
    .map((item) => item.getBoundingClientRect()).map(({{ x, y, width, height }}) => [x, y, width, height])
}}"""


def test_the_dialog_gives_link_and_code_and_what_embeds_opens_the_same_state(explorer, browser, server):
    tab, page = explorer, explorer.page
    tab.change(lambda: tab.slide(h=1.2, f=0.3))
    page.get_by_role("button", name="Share").click()
    dialog = page.get_by_role("dialog", name="Share")
    link = page.get_by_role("textbox", name="Link").input_value()
    assert link == page.url
    assert dict(parse_qsl(urlsplit(link).query))["f"] == "0.3"
    page.locator(".share .code svg").wait_for()
    assert read(page.locator(".share .code").screenshot()) == [link]
    assert_accessible(page, dialog)
    # One of them is folded at first.
    chosen = ("omega", "circle", "torus")
    for box in page.locator(".embed-pictures input").all():
        box.set_checked(box.input_value() in chosen)
    for name in scenes()[HESS].essential:
        page.locator(f".embed-controls input[value={name}]").set_checked(name in ("h", "f"))
    snippet = page.get_by_role("textbox", name="HTML to embed").input_value()
    page.keyboard.press("Escape")
    assert not dialog.is_visible()

    context = browser.new_context(viewport={"width": 1100, "height": 700})
    outer = context.new_page()
    look_inside(outer)
    problems = []
    outer.on("console", lambda message: problems.append(message.text) if message.type == "error" else None)
    outer.set_content(f"<title>Another page</title>{snippet}")
    inner = outer.frames[1]
    wait_ready(inner)
    assert inner.evaluate(SHOWN) == {
        "pictures": ["circle", "omega", "torus"],
        "controls": ["f", "h"],
        "others": 0,
        "player": 1,
        "notes": "",
    }
    framed, there = Explorer(outer, server), "document.documentElement.dataset.state"
    framed.page = inner
    assert framed.data("data-orbit") == tab.data("data-orbit")
    # All that was chosen is in its frame.
    wide, high = inner.evaluate("[innerWidth, innerHeight]")
    boxes = inner.evaluate(BOXES)
    assert len(boxes) == 5 and all(x >= 0 and x + w <= wide and y >= 0 and y + h <= high for x, y, w, h in boxes)
    assert min(w for _, _, w, h in boxes if w == h) >= 250
    before = int(inner.evaluate(there))
    framed.slide(h=0.7)
    wait_ready(inner, after=before)
    tab.change(lambda: tab.slide(h=0.7))
    assert framed.data("data-orbit") == tab.data("data-orbit")
    assert framed.caption("circle") == tab.caption("circle")
    opener = inner.get_by_role("link", name="Open in Hess Explorer")
    opener.focus()
    whole = dict(parse_qsl(urlsplit(opener.get_attribute("href")).query))
    assert (whole["h"], whole["f"]) == ("0.7", "0.3")
    assert not {"embed", "pictures", "controls"} & set(whole)
    assert problems == []
    context.close()


@pytest.mark.parametrize(
    "keys, pictures, controls, is_noted",
    sample(
        [
            ("pictures=bifurcation,<b>,omega&controls=none,h,h", ["bifurcation", "omega"], ["h"], True),
            ("pictures=omega,torus&controls=h,accuracy", ["omega", "torus"], ["accuracy", "h"], False),
            ("pictures=%00&controls=nobody", None, None, True),
            ("pictures=&controls=none", None, [], False),
        ],
        1,
    ),
)
def test_an_embedded_page_has_what_its_address_names_and_nonsense_is_harmless(
    browser, server, keys, pictures, controls, is_noted
):
    scene = scenes()[HESS]
    with own_tab(browser, server, (960, 480)) as tab:
        tab.open(f"embed=1&{keys}")
        wait_frames(tab, 4)
        found = tab.page.evaluate(SHOWN)
        assert found.pop("pictures") == sorted(scene.open_pictures if pictures is None else pictures)
        assert found.pop("controls") == sorted(scene.essential if controls is None else controls)
        notes = found.pop("notes")
        assert bool(notes) == is_noted
        assert "<b>" not in notes
        assert found == {"others": 0, "player": 1}
        assert_accessible(tab.page)


def test_a_code_holds_the_longest_link_that_it_may_and_says_so_of_a_longer_one(browser, server):
    text = f"{server}/?" + "a" * (MOST - len(server) - 2)
    # Five pixels for each of its 145 modules and the margin.
    page = browser.new_page(viewport={"width": 765, "height": 765})
    page.goto(f"{server}/qr.svg?text={quote(text)}")
    assert read(page.screenshot()) == [text]
    for wrong in (text + "a", ""):
        refused = page.request.get(f"{server}/qr.svg?text={quote(wrong)}")
        assert refused.status == 400
        assert f"at most {MOST}" in refused.text()
        assert f"{len(wrong)} characters" in refused.text()
    page.close()
