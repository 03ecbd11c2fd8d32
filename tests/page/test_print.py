"""The browser's print shows the title, the pictures in sight and the text, on white, and no controls."""

import io

import pytest
from PIL import Image, ImageChops

from hess_explorer.scenes import scenes
from support.page import HESS, wait_frames

# Everything visible, in all shadow roots: the tags of controls, and how far the rest reaches to the right.
SEEN = """() => {
  const within = (root) => [...root.querySelectorAll("*")].flatMap((item) => (
    [item, ...(item.shadowRoot ? within(item.shadowRoot) : [])]))
  const seen = within(document).filter((item) => item.checkVisibility({ visibilityProperty: true }))
  return {
    controls: seen.filter((item) => item.matches("button:not(.term), input, select, iframe, dialog, .tool")).length,
    right: Math.max(...seen.map((item) => item.getBoundingClientRect().right)) / innerWidth,
    clipped: seen.filter((item) => item.matches("section, div:not(.gallery, .host)")
      && getComputedStyle(item).overflowY !== "visible" && item.scrollHeight > item.clientHeight + 1).length,
    pictures: seen.filter((item) => item.matches(".printed")).map((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height)
      let [light, blue] = [0, 0]
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 10 || Math.min(data[i], data[i + 1], data[i + 2]) > 225) light += 1
        if (data[i + 3] > 200 && data[i] + Math.abs(data[i + 1] - 0x72) + Math.abs(data[i + 2] - 0xB2) < 12) blue += 1
      }
      return { width: canvas.width, light: 4 * light / data.length, blue }
    }),
  }
}"""
# Width of A4 without margins of 1 cm, and its height, in CSS pixels.
PAPER = {"width": 718, "height": 1047}


def shot(page):
    return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


@pytest.fixture
def on_screen(explorer):
    """The page, on the screen again whatever happens."""
    yield explorer
    explorer.page.emulate_media(media="screen")
    explorer.page.evaluate("dispatchEvent(new Event('afterprint'))")


def test_print_has_the_pictures_and_the_text_on_white_and_no_controls(on_screen):
    explorer, page, names = on_screen, on_screen.page, scenes()[HESS].open_pictures
    # With all groups unfolded the controls can be scrolled, which printing forgets.
    explorer.fold_controls()
    explorer.turn_theme(is_dark=True)
    # Painted once more, as it is after a print: lines over lines differ by a shade.
    explorer.tell("turn", ["body", 0.6, 0.35])
    wait_frames(explorer, 4)
    # The sentence above the pictures may still tell what the changes before did.
    page.locator(".moves").evaluate("sentence => sentence.replaceChildren()")
    before = shot(page)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    found = page.evaluate(SEEN)
    assert (found["controls"], found["clipped"]) == (0, 0)
    assert page.locator("h1:visible").all_inner_texts() == ["The Suslov–Hess case"]
    assert page.locator(".words").is_visible()
    # Pictures of other scenes may be there, hidden.
    assert [page.locator(f".picture-{name} .title:visible").count() for name in names] == [1] * len(names)
    # The body is shaded, a diagram is coloured; around them it is white, the orbit has the colour of a light page.
    pictures = dict(zip(names, found["pictures"], strict=True))
    least = {"body": 0.5, "omega": 0.9, "circle": 0.9, "bifurcation": 0.3}
    assert all(pictures[name]["light"] > share for name, share in least.items()), pictures
    assert pictures["omega"]["blue"] > 500
    assert min(picture["width"] for picture in pictures.values()) >= 1180
    # The paper itself is white.
    assert shot(page).getpixel((1590, 5)) == (255, 255, 255)
    page.set_viewport_size(PAPER)
    assert page.evaluate(SEEN)["right"] <= 1
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    page.emulate_media(media="screen")
    explorer.resize(before.width, before.height)
    # A real print ends, and the page is restored completely.
    assert len(page.pdf(format="A4")) > 100_000
    page.wait_for_function("document.documentElement.style.colorScheme === 'dark'")
    assert page.locator(".printed").count() == 0
    wait_frames(explorer, 4)
    page.locator(".moves").evaluate("sentence => sentence.replaceChildren()")
    # The browser paints everything again: rounded corners and dotted lines may differ by some levels of grey, of 255.
    assert all(most <= 16 for _, most in ImageChops.difference(before, shot(page)).getextrema())
