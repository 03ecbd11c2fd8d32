"""What is taken away of the page: the file of a picture, by the dialog and from the server, and its command."""

from __future__ import annotations

import shlex
from pathlib import Path
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import urlopen

import pytest
from playwright.sync_api import expect

from hess_explorer.export.shown import shown
from hess_explorer.export.table import as_csv
from hess_explorer.protocol.parameters import MAX_QUERY
from support.accessible import assert_accessible

DRAFT = "h=1.2&f=0.3&accuracy=draft"


def test_the_dialog_saves_what_is_on_the_screen_and_names_the_command(explorer):
    page = explorer.page
    explorer.change(lambda: explorer.slide(f=0.3))
    page.get_by_role("button", name="Export").click()
    dialog = page.get_by_role("dialog", name="Export")
    assert dialog.locator(".param-picture option").count() == 5
    dialog.locator(".param-picture").select_option("circle")
    state = urlsplit(page.url).query
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Save file").click()
    assert download.value.suggested_filename == "suslov-hess-circle.csv"
    assert Path(download.value.path()).read_text(encoding="utf-8") == as_csv(shown(state, "circle"))
    assert "suslov-hess-circle.csv:" in dialog.locator(".why").text_content()
    dialog.locator(".param-format").select_option("svg")
    dialog.locator(".param-width").fill("60")
    dialog.locator(".param-black").check()
    words = shlex.split(dialog.locator(".snippet").input_value())
    assert words == ["hess-explorer", "export", "--state", state, "--picture", "circle", "--format", "svg", "--width",
                     "60", "--black", "--out", "suslov-hess-circle.svg"]
    # What cannot be made is said in the dialog, and nothing is saved.
    page.route("**/export?*", lambda route: route.continue_(url=route.request.url.replace("picture=body", "picture=x")))
    dialog.locator(".param-picture").select_option("body")
    dialog.get_by_role("button", name="Save file").click()
    expect(dialog.locator(".why")).to_contain_text("has no picture 'x'")
    page.unroute("**/export?*")
    # The browser itself reports an answer that refuses.
    explorer.errors[:] = [error for error in explorer.errors if "status of 400" not in error]
    assert_accessible(page)
    page.keyboard.press("Escape")
    assert not dialog.is_visible()
    explorer.assert_quiet()


def test_the_server_gives_files_and_sentences(server):
    with urlopen(f"{server}/export?{DRAFT}&picture=circle") as answer:
        assert answer.headers["Content-Type"].startswith("text/csv")
        assert answer.headers["Content-Disposition"] == 'attachment; filename="suslov-hess-circle.csv"'
        assert answer.read().decode() == as_csv(shown(DRAFT, "circle"))
    for kind, begins in (("json", b"{"), ("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
        with urlopen(f"{server}/export?{DRAFT}&picture=omega&format={kind}&width=40&black=1") as answer:
            assert answer.read().startswith(begins)


@pytest.mark.parametrize(("query", "sentence"), [
    ("picture=nothing", "choose one of body, omega"),
    ("h=" + "1" * MAX_QUERY, f"longer than {MAX_QUERY} characters"),
    ("scene=chaplygin-ball&I13=0&I23=0", "no line of equilibria"),
])
def test_what_cannot_be_made_is_refused_with_a_sentence(server, query, sentence):
    with pytest.raises(HTTPError) as refused:
        urlopen(f"{server}/export?{query}")
    assert refused.value.code == 400
    assert refused.value.headers["Content-Type"].startswith("text/plain")
    said = refused.value.read().decode()
    assert sentence in said
    assert said.endswith(".")
