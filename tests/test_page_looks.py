"""How the page looks: its layouts, light and dark, and whether everyone can use it."""

from __future__ import annotations

import io

import pytest
from axe_playwright_python.sync_playwright import Axe
from PIL import Image, ImageStat

SIZES = {"wide": (1600, 950), "laptop": (1280, 720), "phone": (390, 844)}
COLUMNS = {"wide": 4, "laptop": 2, "phone": 1}
PICTURES = ("omega", "sphere", "bifurcation", "circle")


def drawing(page, name):
    """The bounding box of a picture without its caption."""
    inside = "canvas.sphere" if name == "sphere" else ".bk-Figure"
    return page.locator(f".picture-{name} {inside}").first.bounding_box()


@pytest.mark.parametrize("size", SIZES)
def test_pictures_stand_in_as_many_columns_as_fit_and_are_square(open_page, size):
    page = open_page(size=SIZES[size])
    boxes = [drawing(page, name) for name in PICTURES]
    for box in boxes:
        assert box["width"] == pytest.approx(box["height"], abs=4)
        assert box["width"] >= 290
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= SIZES[size][0]
    columns = COLUMNS[size]
    for i, box in enumerate(boxes):
        row = boxes[i - i % columns]
        assert box["y"] == pytest.approx(row["y"], abs=2)
        if i % columns:
            assert box["x"] >= boxes[i - 1]["x"] + boxes[i - 1]["width"] - 1
        elif i:
            assert box["y"] >= boxes[i - 1]["y"] + boxes[i - 1]["height"] - 1
            assert box["x"] == pytest.approx(boxes[0]["x"], abs=2)


@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_wider_than_the_window(open_page, size):
    page = open_page(size=SIZES[size])
    assert page.evaluate("document.documentElement.scrollWidth") <= SIZES[size][0]


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("query", ["", "h=0.2&f=0.5", "h=1&f=0", "h=0.25&f=1.0606601717798212", "I22=0.5&I23=1.5"])
def test_every_caption_fits_into_its_place(open_page, size, query):
    page = open_page(query, size=SIZES[size])
    for name in PICTURES:
        caption = page.locator(f".picture-{name} h2")
        assert caption.evaluate("item => item.scrollHeight - item.clientHeight") <= 1, caption.inner_text()


def test_on_a_phone_the_controls_are_behind_the_menu_button(open_page):
    page = open_page(size=SIZES["phone"])
    slider = page.locator(".param-h input[type=range]")
    page.wait_for_function("item => item === null || item.getBoundingClientRect().right <= 0",
                           arg=slider.element_handle() if slider.count() else None)
    page.get_by_role("button").first.click()
    slider.wait_for(state="visible")
    page.wait_for_function("item => item.getBoundingClientRect().left >= 0", arg=slider.element_handle())


def brightness(page):
    return ImageStat.Stat(Image.open(io.BytesIO(page.screenshot())).convert("L")).median[0]


def axis_colour(page):
    return page.evaluate("""() => {
        const figure = Bokeh.documents[0].get_model_by_name("omega")
        return figure.below[0].major_label_text_color
    }""")


def test_dark_is_dark_and_its_axes_can_be_read(open_page):
    light, dark = open_page(), open_page("theme=dark")
    assert brightness(light) > 200
    assert brightness(dark) < 60
    assert axis_colour(light) != axis_colour(dark)


def test_the_button_turns_the_page_dark_and_the_link_says_so(open_page):
    page = open_page()
    page.get_by_role("button", name="theme").click()
    page.wait_for_function("location.search.includes('theme=dark')")
    assert brightness(page) < 60
    assert axis_colour(page) == axis_colour(open_page("theme=dark"))


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_screenshot_of_every_size_and_theme_is_kept(open_page, artefacts, size, theme):
    page = open_page(f"theme={theme}", size=SIZES[size])
    picture = page.screenshot(path=artefacts / f"{size}-{theme}.png")
    colours = Image.open(io.BytesIO(picture)).convert("RGB").getcolors(1 << 24)
    assert len(colours) > 500


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_no_rule_of_wcag_is_broken(open_page, theme):
    page = open_page(f"theme={theme}")
    found = Axe().run(page, options={"runOnly": ["wcag2a", "wcag2aa"]})
    broken = [(rule["id"], node["target"], node["html"][:200])
              for rule in found.response["violations"] for node in rule["nodes"]]
    assert not broken, broken
    assert len(found.response["passes"]) > 10


def test_every_control_is_reached_by_the_tab_key(open_page):
    page = open_page()
    reached = set()
    for _ in range(60):
        page.keyboard.press("Tab")
        reached |= set(page.evaluate("""() => {
            let item = document.activeElement
            while (item?.shadowRoot?.activeElement) item = item.shadowRoot.activeElement
            const names = []
            for (let at = item; at; at = at.parentElement ?? at.getRootNode().host)
                names.push(...[...(at.classList ?? [])].filter((name) => /^param-|^sphere$/.test(name)))
            return names
        }"""))
    wanted = {"param-preset", "param-accuracy", "param-reset", "param-link", "param-play", "param-t", "param-speed",
              "sphere", *(f"param-{name}" for name in ("I22", "I23", "b3", "h", "f", "phi0", "span"))}
    assert wanted <= reached, wanted - reached
