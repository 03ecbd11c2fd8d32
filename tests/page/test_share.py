"""Sharing: the page's link, its QR code, and parts of the page embedded in another one."""

from urllib.parse import parse_qsl, quote, urlsplit

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from hess_explorer.server.qr_code import MAX_LENGTH
from support.accessible import assert_accessible
from support.barcode import read
from support.page import ALL, HESS, own_tab, wait_frames

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
    tab.move(h=1.2, f=0.3)
    page.get_by_role("button", name="Share").click()
    page.get_by_role("button", name="Link").click()
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

    with own_tab(browser, server, (1100, 700)) as framed:
        framed.page.set_content(f"<title>Another page</title>{snippet}")
        framed.page = inner = framed.page.frames[1]
        wait_ready(inner)
        assert inner.evaluate(SHOWN) == {
            "pictures": ["circle", "omega", "torus"],
            "controls": ["f", "h"],
            "others": 0,
            "player": 1,
            "notes": "",
        }
        assert framed.data("data-orbit") == tab.data("data-orbit")
        # All that was chosen is in its frame.
        wide, high = inner.evaluate("[innerWidth, innerHeight]")
        boxes = inner.evaluate(BOXES)
        assert len(boxes) == 5
        assert all(x >= 0 and x + w <= wide and y >= 0 and y + h <= high for x, y, w, h in boxes)
        assert min(w for _, _, w, h in boxes if w == h) >= 250
        for one in (framed, tab):
            one.move(h=0.7)
        assert framed.data("data-orbit") == tab.data("data-orbit")
        assert framed.caption("circle") == tab.caption("circle")
        opener = inner.get_by_role("link", name="Open in Hess Explorer")
        opener.focus()
        whole = dict(parse_qsl(urlsplit(opener.get_attribute("href")).query))
        assert (whole["h"], whole["f"]) == ("0.7", "0.3")
        assert not {"embed", "pictures", "controls"} & set(whole)


def test_an_embedded_page_has_what_its_address_names_and_nonsense_is_harmless(browser, server):
    with own_tab(browser, server, (960, 480)) as tab:
        tab.open("embed=1&pictures=bifurcation,<b>,omega&controls=none,h,h")
        wait_frames(tab, 4)
        found = tab.page.evaluate(SHOWN)
        notes = found.pop("notes")
        assert found == {"pictures": ["bifurcation", "omega"], "controls": ["h"], "others": 0, "player": 1}
        assert notes
        assert "<b>" not in notes
        assert_accessible(tab.page)


def test_a_code_holds_the_longest_link_that_it_may_and_says_so_of_a_longer_one(tab):
    text, request = f"{tab.base}/?".ljust(MAX_LENGTH, "a"), tab.page.request
    # Five pixels for each of its 145 modules and the margin.
    page = tab.page.context.new_page()
    page.set_viewport_size({"width": 765, "height": 765})
    page.goto(f"{tab.base}/qr.svg?text={quote(text)}")
    assert read(page.screenshot()) == [text]
    page.close()
    for wrong in (text + "a", ""):
        refused = request.get(f"{tab.base}/qr.svg?text={quote(wrong)}")
        assert refused.status == 400
        assert f"at most {MAX_LENGTH}" in refused.text() and f"{len(wrong)} bytes" in refused.text()
