"""Exports: the file of a picture from the dialog and from the server, and the matching command."""

import io
import re
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest
from PIL import Image, ImageChops
from playwright.sync_api import expect

from hess_explorer.export.code import code
from hess_explorer.export.notebook import notebook
from hess_explorer.export.picture_data import address, picture_data
from hess_explorer.export.table import as_csv
from hess_explorer.headless.drawing import png_of
from support.accessible import assert_accessible
from support.command_line import typed
from support.films import frames_of, tags_of

DRAFT = "h=1.2&f=0.3&accuracy=draft"


def command_of(dialog):
    return typed(dialog.get_by_label("Command").get_by_role("textbox").input_value())


@pytest.fixture
def dialog(explorer):
    """The open dialog."""
    explorer.move(f=0.28)
    # The address has the view of the picture that was turned last.
    explorer.tell("turn", ["body", 0.5, 0.3])
    explorer.wait_url(f="0.28", az="0.5000")
    explorer.tool("export")
    found = explorer.page.get_by_role("dialog", name="Export")
    yield found
    explorer.page.keyboard.press("Escape")
    assert not found.is_visible()


def saved(dialog, button="Save file", seconds=60.0):
    """Press a button; return the name of the file that the browser gets, and its path."""
    with dialog.page.expect_download(timeout=1e3 * seconds) as download:
        dialog.get_by_role("button", name=button).click()
    return download.value.suggested_filename, Path(download.value.path())


def choose(dialog, **options):
    """Choose from menus, and fill boxes."""
    for name, value in options.items():
        control = dialog.locator(f".param-{name}")
        control.fill(value) if name in ("width", "seconds", "values") else control.select_option(value)


def test_the_dialog_saves_what_is_on_the_screen_and_names_the_command(explorer, dialog):
    page, state = explorer.page, urlsplit(explorer.page.url).query
    assert dialog.locator(".param-picture option").count() == 6
    formats = dialog.locator(".param-format option").evaluate_all("all => all.map((one) => one.value).join()")
    assert formats == "csv,json,png,svg,pdf,webm,mp4,html"
    choose(dialog, picture="circle")
    name, path = saved(dialog)
    assert (name, path.read_text("utf-8")) == ("suslov-hess-circle.csv", as_csv(picture_data(state, "circle")))
    choose(dialog, format="svg", width="60")
    dialog.locator(".param-black").check()
    command = f"hess-explorer export --state '{state}' --picture circle --format svg --width 60 --black"
    assert command_of(dialog) == typed(f"{command} --out suslov-hess-circle.svg")
    dialog.locator(".param-black").uncheck()
    # The lines of Python, those of the command line too, and the notebook.
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    lines = code(address(state, "circle"))
    expect(dialog.get_by_label("Python", exact=True).get_by_role("textbox")).to_have_value(lines)
    dialog.get_by_role("button", name="Copy Python").click()
    expect(dialog.locator(".param-copy-python")).to_have_text("Copied")
    assert page.evaluate("navigator.clipboard.readText()") == lines
    name, path = saved(dialog, "Open as notebook")
    assert (name, path.read_text("utf-8")) == ("suslov-hess-circle.ipynb", notebook(address(state, "circle")))
    # All of the state in one file, with sliders that move, is made in a process of its own, with progress.
    choose(dialog, format="html", values="3")
    assert dialog.locator(".param-picture").is_hidden()
    dialog.get_by_label("Energy h").check()
    expect(dialog.locator(".states")).to_have_text("About 3 states.")
    assert "--vary h=-0.99:4:3" in " ".join(command_of(dialog))
    # It yields to everything else, and other tests keep the machine busy.
    name, path = saved(dialog, seconds=300.0)
    assert name == "suslov-hess.html"
    assert '"points": [[1.5], [-0.99], [1.505], [4.0]]' in path.read_text("utf-8")
    # The dialog reports formats that cannot be made, and nothing is saved.
    page.route("**/export?*", lambda route: route.continue_(url=route.request.url.replace("picture=body", "picture=x")))
    choose(dialog, format="csv", picture="body")
    dialog.get_by_role("button", name="Save file").click()
    expect(dialog.locator(".why")).to_contain_text("has no picture 'x'")
    page.unroute("**/export?*")
    # The browser itself reports an answer that refuses.
    explorer.errors[:] = [error for error in explorer.errors if "status of 400" not in error]
    assert_accessible(page, dialog)


def test_a_png_of_a_body_is_drawn_by_the_page_at_once_as_the_command_draws_it(explorer, dialog):
    choose(dialog, format="png", picture="body", width="10")
    dialog.get_by_role("button", name="Save file").click()
    assert dialog.locator(".param-width").evaluate("width => width.matches(':invalid:focus')")
    choose(dialog, width="62")
    asked = []
    explorer.page.on("request", lambda request: asked.append(request.url))
    file = Image.open(saved(dialog)[1])
    assert not [url for url in asked if "export" in url]
    found = picture_data(urlsplit(explorer.page.url).query, "body", lenient=True)
    drawn = Image.open(io.BytesIO(png_of(found, 62.0)))
    # The file of the command has its numbers rounded: a few levels of 255 at edges.
    assert np.asarray(ImageChops.difference(file, drawn)).mean() < 0.02
    for name in ("dpi", "Title", "Comment", "Software"):
        assert file.info[name] == drawn.info[name]
    program, link, *facts = re.split(r", \?| \| ", file.info["Description"])
    assert program == found.facts["program"]
    assert picture_data(link, "body", lenient=True).link == found.link
    assert "f = 0.28" in facts[0]
    assert "error" in facts[1]
    choose(dialog, width="85")


def test_a_film_is_made_with_progress_and_is_stopped(explorer, dialog):
    assert dialog.locator(".param-seconds").is_hidden()
    choose(dialog, format="webm", picture="sphere", width="60", seconds="1")
    assert command_of(dialog)[-4:] == typed("--seconds 1 --out suslov-hess-sphere.webm")
    # All that is said while it is made.
    why = dialog.locator(".why")
    why.evaluate("""said => {
        window.heard = []
        new MutationObserver(() => window.heard.push(said.textContent)).observe(said, {childList: true})
    }""")
    name, path = saved(dialog, seconds=300.0)
    assert name == "suslov-hess-sphere.webm"
    assert len(frames_of(path, 480)) == 25
    assert picture_data(urlsplit(explorer.page.url).query, "sphere").link in tags_of(path)
    heard = explorer.page.evaluate("window.heard")
    assert heard[0] == "Working…"
    assert "Frame 25 of 25." in heard
    assert heard[-1].startswith("suslov-hess-sphere.webm:")
    # A loop has its own width.
    choose(dialog, loop="dark", seconds="30")
    assert dialog.locator(".param-width").is_hidden()
    loop = typed("--format webm --loop dark --seconds 30 --out suslov-hess-sphere.webm")
    assert command_of(dialog)[-len(loop) :] == loop
    dialog.get_by_role("button", name="Save file").click()
    expect(why).to_contain_text("Frame ", timeout=300_000)
    dialog.get_by_role("button", name="Stop").click()
    expect(why).to_have_text("Stopped.")


def test_the_server_gives_files_and_refuses_others_with_a_sentence(tab):
    def answer(query):
        return tab.page.request.get(f"{tab.base}/export?{query}")

    given = answer(f"{DRAFT}&picture=circle")
    assert given.headers["content-type"].startswith("text/csv")
    assert given.headers["content-disposition"] == 'attachment; filename="suslov-hess-circle.csv"'
    assert given.text() == as_csv(picture_data(DRAFT, "circle"))
    for query, sentence in (
        ("picture=nothing", "choose one of body, omega"),
        ("picture=-x&format=webm", "has no picture '-x'"),
        ("scene=chaplygin-ball&I13=0&I23=0", "no line of equilibria"),
    ):
        refused = answer(query)
        assert (refused.status, refused.headers["content-type"][:10]) == (400, "text/plain")
        assert sentence in refused.text() and refused.text().endswith(".")
