"""*Your own body*: a potential is typed and goes into the link; what is none is refused."""

import pytest


@pytest.mark.parametrize("scene", ["own-body"])
def test_a_typed_potential_is_shown_and_goes_into_the_link(explorer):
    explorer.picture("omega").get_by_text("From t = 0").wait_for(state="attached")
    assert explorer.box("frequency").is_disabled()
    explorer.change(explorer.type, "U", "g3 +")
    assert "This is not a polynomial: use numbers, g1, g2, g3" in explorer.text("notes")
    # It stays to be corrected.
    box = explorer.box("U")
    assert box.input_value() == "g3 +"
    assert box.get_attribute("aria-invalid") == "true"
    assert explorer.page.locator(".why:visible").inner_text() == explorer.text("notes")
    # Other numbers need no compilation.
    explorer.change(explorer.type, "U", "g3 - 2*g1")
    assert explorer.text("notes") == ""
    assert box.get_attribute("aria-invalid") == "false"
    explorer.wait_url(U="g3 - 2*g1", scene="own-body")
