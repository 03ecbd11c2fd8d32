"""Terms of the texts are explained where they stand first; the depth of a text is chosen once."""

import re

from playwright.sync_api import expect

from hess_explorer.page.glossary import explainer, glossary


def test_a_term_is_explained_once_and_nothing_else_is_changed():
    explain = explainer()
    first, second = explain("A limit cycle & its multipliers"), explain("Limit cycles, multiplierless; a < b")
    assert first.count("<button") == 2
    assert glossary()["limit cycle"] in first
    assert second == "Limit cycles, multiplierless; a &lt; b"
    plain = re.sub(r"<span.*?</span>|</?button.*?>", "", first)
    assert plain == "A limit cycle &amp; its multipliers"


def test_a_term_opens_by_keyboard_and_closes_with_escape(explorer):
    explorer.open_text()
    page = explorer.page
    term = page.locator(".words button.term", has_text="gyration ellipsoid")
    meaning = page.locator(".words .meaning", has_text=glossary()["gyration ellipsoid"])
    expect(meaning).to_be_hidden()
    term.focus()
    page.keyboard.press("Enter")
    expect(meaning).to_be_visible()
    page.keyboard.press("Escape")
    expect(meaning).to_be_hidden()
    term.click()
    expect(meaning).to_be_visible()
    term.click()


def test_the_depth_of_the_text_is_chosen_once(explorer):
    explorer.open_text()
    page = explorer.page
    words, depth = page.locator(".words"), page.get_by_label("Depth of the text")
    headings, shown = (words.locator(one).filter(visible=True) for one in ("h3", "> *"))
    assert headings.count() > 1
    try:
        depth.select_option("idea")
        assert [item.evaluate("item => item.tagName") for item in shown.all()] == ["H3", "P"]
        depth.select_option("student")
        assert (shown.count() > 2, headings.count()) == (True, 1)
        # In the next scene, too.
        explorer.fresh("free-suslov")
        explorer.open_text()
        assert headings.count() == 1
    finally:
        depth.select_option("paper")
    assert headings.count() > 1
