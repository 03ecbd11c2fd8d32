"""Terms of the texts are explained where they stand first; the depth of a text is chosen once."""

import json
import re

import pytest
from playwright.sync_api import expect

from hess_explorer.page.description import describe
from hess_explorer.page.glossary import explainer, glossary
from hess_explorer.scenes import scenes
from support.thorough import sample


def test_a_term_is_explained_once_and_nothing_else_is_changed():
    explain = explainer()
    first, second = explain("A limit cycle & its multipliers"), explain("Limit cycles, multiplierless; a < b")
    assert first.count("<button") == 2
    assert glossary()["limit cycle"] in first
    assert second == "Limit cycles, multiplierless; a &lt; b"
    plain = re.sub(r"<span.*?</span>|</?button.*?>", "", first)
    assert plain == "A limit cycle &amp; its multipliers"


@pytest.mark.parametrize("name", sample(scenes(), 8))
def test_buttons_of_a_scene_have_meanings_of_their_own(name):
    words = json.loads(describe(name))["words"]
    targets = re.findall(r'popovertarget="([^"]+)"', words)
    assert sorted(targets) == sorted(re.findall(r'<span class="meaning" id="([^"]+)"', words))
    assert len(set(targets)) == len(targets)


def test_a_term_opens_by_keyboard_and_closes_with_escape(explorer):
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
    page = explorer.page
    words = page.locator(".words")
    depth = page.get_by_label("Depth of the text")
    try:
        expect(words).to_contain_text("The equations")
        depth.select_option("idea")
        shown = words.locator("> *").filter(visible=True)
        assert [item.evaluate("item => item.tagName") for item in shown.all()] == ["H3", "P"]
        depth.select_option("student")
        assert shown.count() > 2
        assert words.get_by_role("heading").filter(visible=True).count() == 1
        # In the next scene, too.
        explorer.fresh("free-suslov")
        assert words.get_by_role("heading").filter(visible=True).count() == 1
    finally:
        depth.select_option("paper")
    assert words.get_by_role("heading").filter(visible=True).count() > 1
