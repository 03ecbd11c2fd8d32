"""The cost of all that a scene computes, in "Speed and accuracy"; the accuracy "auto"."""

import pytest
from playwright.sync_api import expect

from hess_explorer.scenes import scenes
from support.page import brought


@pytest.mark.thorough
def test_the_cost_of_all_is_measured_when_its_button_is_pressed(tab):
    explorer = brought(tab, scenes()["scattering-accuracy"])
    assert not explorer.data("trade-map").get("x")
    explorer.unfold("trade")
    caption = "Cheapest levels without a visible error: orbit draft, map standard."
    expect(explorer.picture("trade")).to_contain_text(caption)
    assert len(explorer.data("trade-map")["x"]) == 4
    assert len(explorer.data("trade-enough")["x"]) == 2
    explorer.assert_quiet()


def test_a_link_with_the_accuracy_auto_says_what_it_stands_for(tab):
    explorer = tab.fresh("kharlamova")
    explorer.change(lambda: explorer.page.evaluate("hess.tell('restore', 'scene=kharlamova&accuracy=auto')"))
    expect(explorer.page.locator(".text.details")).to_contain_text("auto: draft · ")
    assert explorer.text("status").startswith("draft: orbit")
    assert explorer.chosen("accuracy") == "auto"
    explorer.assert_quiet()
