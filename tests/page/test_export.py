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
from support.asynchronous import wait_until
from support.command_line import typed
from support.films import frames_of, tags_of

DRAFT = "h=1.2&f=0.3&accuracy=draft"


def command_of(dialog):
    return typed(dialog.get_by_label("Command").get_by_role("textbox").input_value())


def test_the_dialog_saves_what_is_on_the_screen_and_names_the_command(explorer):
    page = explorer.page
    explorer.change(lambda: explorer.slide(f=0.3))
    page.get_by_role("button", name="Export").click()
    dialog = page.get_by_role("dialog", name="Export")
    assert dialog.locator(".param-picture option").count() == 6
    assert dialog.locator(".param-format option").evaluate_all("all => all.map((one) => one.value).join()") == (
        "csv,json,png,svg,pdf,webm,mp4,html"
    )
    dialog.locator(".param-picture").select_option("circle")
    state = urlsplit(page.url).query
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Save file").click()
    assert download.value.suggested_filename == "suslov-hess-circle.csv"
    assert Path(download.value.path()).read_text(encoding="utf-8") == as_csv(picture_data(state, "circle"))
    dialog.locator(".param-format").select_option("svg")
    dialog.locator(".param-width").fill("60")
    dialog.locator(".param-black").check()
    command = f"hess-explorer export --state '{state}' --picture circle --format svg --width 60 --black"
    assert command_of(dialog) == typed(f"{command} --out suslov-hess-circle.svg")
    # The lines of Python, those of the command line too, and the notebook.
    explorer.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    python = dialog.get_by_label("Python", exact=True).get_by_role("textbox")
    lines = code(address(state, "circle"))
    expect(python).to_have_value(lines)
    dialog.get_by_role("button", name="Copy Python").click()
    expect(dialog.locator(".param-copy-python")).to_have_text("Copied")
    assert page.evaluate("navigator.clipboard.readText()") == lines
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Open as notebook").click()
    assert download.value.suggested_filename == "suslov-hess-circle.ipynb"
    assert Path(download.value.path()).read_text(encoding="utf-8") == notebook(address(state, "circle"))
    # All of the state in one file: what it does is for "test_offline".
    dialog.locator(".param-format").select_option("html")
    assert dialog.locator(".param-picture").is_hidden()
    # With sliders that move it is made in a process of its own, with progress.
    dialog.get_by_label("Energy h").check()
    dialog.locator(".param-values").fill("3")
    expect(dialog.locator(".states")).to_have_text("About 3 states.")
    assert "--vary h=-0.99:4:3" in " ".join(command_of(dialog))
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Save file").click()
    assert download.value.suggested_filename == "suslov-hess.html"
    content = Path(download.value.path()).read_text(encoding="utf-8")
    assert '"points": [[1.5], [-0.99], [1.505], [4.0]]' in content
    dialog.locator(".param-format").select_option("csv")
    # The dialog reports formats that cannot be made, and nothing is saved.
    page.route("**/export?*", lambda route: route.continue_(url=route.request.url.replace("picture=body", "picture=x")))
    dialog.locator(".param-picture").select_option("body")
    dialog.get_by_role("button", name="Save file").click()
    expect(dialog.locator(".why")).to_contain_text("has no picture 'x'")
    page.unroute("**/export?*")
    # The browser itself reports an answer that refuses.
    explorer.errors[:] = [error for error in explorer.errors if "status of 400" not in error]
    assert_accessible(page, dialog)
    page.keyboard.press("Escape")
    assert not dialog.is_visible()


def test_a_png_of_a_body_is_drawn_by_the_page_at_once_as_the_command_draws_it(explorer):
    page = explorer.page
    explorer.change(lambda: explorer.slide(f=0.28))
    # The address has the view of the picture that was turned last.
    explorer.tell("turn", ["body", 0.5, 0.3])
    page.get_by_role("button", name="Export").click()
    dialog = page.get_by_role("dialog", name="Export")
    dialog.locator(".param-picture").select_option("body")
    dialog.locator(".param-format").select_option("png")
    dialog.locator(".param-black").uncheck()
    dialog.locator(".param-width").fill("10")
    dialog.get_by_role("button", name="Save file").click()
    assert dialog.locator(".param-width").evaluate("width => width.matches(':invalid:focus')")
    dialog.locator(".param-width").fill("62")
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Save file").click()
    assert not [url for url in asked if "export" in url]
    saved = Image.open(download.value.path())
    found = picture_data(urlsplit(page.url).query, "body", lenient=True)
    drawn = Image.open(io.BytesIO(png_of(found, 62.0)))
    assert saved.info["dpi"] == drawn.info["dpi"]
    # The file of the command has its numbers rounded: a few levels of 255 at edges.
    assert np.asarray(ImageChops.difference(saved, drawn)).mean() < 0.02
    for name in ("Title", "Comment", "Software"):
        assert saved.info[name] == drawn.info[name]
    program, link, *facts = re.split(r", \?| \| ", saved.info["Description"])
    assert program == found.facts["program"]
    assert picture_data(link, "body", lenient=True).link == found.link
    assert "f = 0.28" in facts[0]
    assert "error" in facts[1]
    dialog.locator(".param-width").fill("85")
    page.keyboard.press("Escape")


def filming():
    """Return the processes that make films of half a minute."""
    found = []
    for one in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = one.read_bytes().split(b"\0")
        except OSError:
            continue
        if b"--progress" in words and b"--seconds=30" in words:
            found.append(words)
    return found


def test_a_film_is_made_with_progress_and_is_stopped(explorer):
    page = explorer.page
    explorer.change(lambda: explorer.slide(f=0.25))
    page.get_by_role("button", name="Export").click()
    dialog = page.get_by_role("dialog", name="Export")
    assert dialog.locator(".param-seconds").is_hidden()
    dialog.locator(".param-picture").select_option("sphere")
    dialog.locator(".param-format").select_option("webm")
    dialog.locator(".param-width").fill("60")
    dialog.locator(".param-seconds").fill("1")
    state = urlsplit(page.url).query
    assert command_of(dialog)[-4:] == typed("--seconds 1 --out suslov-hess-sphere.webm")
    # All that is said while it is made.
    dialog.locator(".why").evaluate("""said => {
        window.heard = []
        new MutationObserver(() => window.heard.push(said.textContent)).observe(said, {childList: true})
    }""")
    # Films yield to everything else, and other tests keep the machine busy.
    with page.expect_download(timeout=300_000) as download:
        dialog.get_by_role("button", name="Save file").click()
    assert download.value.suggested_filename == "suslov-hess-sphere.webm"
    path = download.value.path()
    assert len(frames_of(path, 480)) == 25
    assert picture_data(state, "sphere").link in tags_of(path)
    heard = page.evaluate("window.heard")
    assert heard[0] == "Working…"
    assert "Frame 25 of 25." in heard
    assert heard[-1].startswith("suslov-hess-sphere.webm:")
    # A loop has its own width.
    dialog.locator(".param-loop").select_option("dark")
    dialog.locator(".param-seconds").fill("30")
    assert dialog.locator(".param-width").is_hidden()
    loop = typed("--format webm --loop dark --seconds 30 --out suslov-hess-sphere.webm")
    assert command_of(dialog)[-len(loop) :] == loop
    dialog.get_by_role("button", name="Save file").click()
    wait_until(filming, 300.0)
    dialog.get_by_role("button", name="Stop").click()
    expect(dialog.locator(".why")).to_have_text("Stopped.")
    wait_until(lambda: not filming(), 300.0)
    page.keyboard.press("Escape")


def test_the_server_gives_files(tab):
    answer = tab.page.request.get(f"{tab.base}/export?{DRAFT}&picture=circle")
    assert answer.headers["content-type"].startswith("text/csv")
    assert answer.headers["content-disposition"] == 'attachment; filename="suslov-hess-circle.csv"'
    assert answer.text() == as_csv(picture_data(DRAFT, "circle"))


@pytest.mark.parametrize(
    "query, sentence",
    [
        ("picture=nothing", "choose one of body, omega"),
        ("picture=-x&format=webm", "has no picture '-x'"),
        ("scene=chaplygin-ball&I13=0&I23=0", "no line of equilibria"),
    ],
)
def test_what_cannot_be_made_is_refused_with_a_sentence(tab, query, sentence):
    refused = tab.page.request.get(f"{tab.base}/export?{query}")
    assert refused.status == 400
    assert refused.headers["content-type"].startswith("text/plain")
    assert sentence in refused.text()
    assert refused.text().endswith(".")
