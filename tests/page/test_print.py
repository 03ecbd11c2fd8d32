"""Printing replaces the page by a handout."""

import io
import re
from urllib.parse import parse_qs, urlsplit

import pytest
from PIL import Image, ImageChops

from hess_explorer.protocol.parameters import Number
from hess_explorer.scenes import scenes
from hess_explorer.server.qr_code import drawing
from support.page import HESS, wait_frames
from support.thorough import sample

# A print dialog cannot be answered by a test.
NO_DIALOG = "() => { window.printed = 0; window.print = () => { window.printed += 1 } }"
# {text of the head of each row: value}; of each picture its width, the share of its pixels that are white or light
# grey, and how many have the blue of an orbit on a light page.
HANDOUT = """() => {
  const sheet = document.querySelector(".handout")
  return {
    rows: Object.fromEntries([...sheet.querySelectorAll(".numbers tr")].map(({ cells: [name, value] }) => (
      [name.textContent, value.textContent]))),
    captions: [...sheet.querySelectorAll("figcaption")].map((item) => item.textContent),
    link: sheet.querySelector("header a").href, text: sheet.querySelector(".words").textContent,
    code: sheet.querySelector(".code").innerHTML,
    pictures: [...sheet.querySelectorAll("canvas")].map((canvas) => {
      const { width, height } = canvas
      const { data } = canvas.getContext("2d").getImageData(0, 0, width, height)
      let [light, blue] = [0, 0]
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 10 || Math.min(data[i], data[i + 1], data[i + 2]) > 225) light += 1
        const off = data[i] + Math.abs(data[i + 1] - 0x72) + Math.abs(data[i + 2] - 0xB2)
        if (data[i + 3] > 200 && off < 12) blue += 1
      }
      return { width, light: light / (width * height), blue }
    }),
  }
}"""


@pytest.mark.parametrize("theme", sample(["light", "dark"], 1))
def test_a_handout_has_the_pictures_the_numbers_the_text_and_the_link_dark_on_white(explorer, theme):
    page = explorer.page
    page.evaluate(NO_DIALOG)
    # With all groups unfolded the controls can be scrolled, which printing forgets.
    explorer.fold_controls()
    explorer.turn_theme(is_dark=theme == "dark")
    explorer.change(lambda: explorer.slide(h=1.25))
    explorer.set_time(2.0)
    explorer.wait_url(h="1.25")
    # Painted once more, as it is after a print: lines over lines differ by a shade.
    page.evaluate("hess.tell('turn', ['body', 0.6, 0.35])")
    wait_frames(explorer, 4)
    before = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    page.keyboard.press("Control+p")
    page.wait_for_function("window.printed === 1")
    found = page.evaluate(HANDOUT)
    values = {name: one for name, [one] in parse_qs(urlsplit(page.url).query).items()}
    for spec in (spec for spec in scenes()[HESS].specs if isinstance(spec, Number)):
        assert float(found["rows"][spec.label].replace("−", "-")) == pytest.approx(float(values[spec.name]), abs=1e-9)
    assert found["rows"]["Time t"] == "2.000"
    assert found["link"] == page.url
    # The very code of that link.
    assert re.findall(r' d="([^"]+)"', found["code"]) == re.findall(r' d="([^"]+)"', drawing(page.url))
    assert "a wheel-like constraint forbids spin about" in found["text"]
    names = scenes()[HESS].open_pictures
    assert found["captions"] == [re.sub(r"\s+", " ", explorer.caption(name)) for name in names]
    # The body is shaded, a diagram is coloured; what is around them is white, the orbit has the colour of a light page.
    assert len(found["pictures"]) == len(names)
    light = dict(zip(names, (picture["light"] for picture in found["pictures"]), strict=True))
    assert light["body"] > 0.5
    assert light["omega"] > 0.9
    assert light["circle"] > 0.9
    assert light["bifurcation"] > 0.3
    assert found["pictures"][names.index("omega")]["blue"] > 500
    # 300 dots to an inch on 88 mm.
    assert min(picture["width"] for picture in found["pictures"]) >= 88 / 25.4 * 300
    # Printing ends, and the page is restored completely.
    printed = page.pdf(format="A4", prefer_css_page_size=True)
    assert len(re.findall(rb"/Width (?:1[01]\d\d|[2-9]\d\d\d)\b", printed)) >= len(names)
    page.wait_for_function("document.querySelector('.handout') === null")
    wait_frames(explorer, 4)
    after = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    # The browser paints everything anew: rounded corners differ by a level of grey now and then.
    assert all(most <= 2 for _, most in ImageChops.difference(before, after).getextrema())
