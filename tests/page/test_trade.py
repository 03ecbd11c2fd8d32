"""The cost of all that a scene computes, in "Speed and accuracy"; the accuracy "auto"."""

import pytest
from playwright.sync_api import expect


@pytest.mark.thorough
@pytest.mark.parametrize("scene", ["scattering-accuracy"])
def test_the_cost_of_all_is_measured_when_its_button_is_pressed(explorer):
    assert not explorer.data("trade-map").get("x")
    explorer.unfold("trade")
    caption = "Cheapest levels without a visible error: orbit draft, map standard."
    expect(explorer.picture("trade")).to_contain_text(caption)
    assert len(explorer.data("trade-map")["x"]) == 4
    assert len(explorer.data("trade-enough")["x"]) == 2


@pytest.mark.parametrize("scene", ["kharlamova"])
def test_a_link_with_the_accuracy_auto_says_what_it_stands_for(explorer):
    explorer.change(explorer.tell, "restore", "scene=kharlamova&accuracy=auto")
    expect(explorer.page.locator(".text.details")).to_contain_text("auto: draft · ")
    assert explorer.text("status").startswith("draft: orbit")
    assert explorer.chosen("accuracy") == "auto"
