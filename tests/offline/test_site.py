"""The site: built by one command, read from the disk with the network off."""

import re
import threading
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from hess_explorer.lessons import shipped
from hess_explorer.offline.site import build, pages
from hess_explorer.page.showcase import EXHIBITS
from hess_explorer.scenes import scenes
from hess_mechanics.errors import InvalidParameter
from support.command_line import run
from support.offline import READY, change, move, opened

SOME = ("suslov-hess", "scattering-by-a-nonholonomic-top")


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


@contextmanager
def served(folder):
    """A folder on a plain web server of this machine; the address."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(folder))) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_address[1]}"
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture(scope="module", params=[SOME, pytest.param((), marks=pytest.mark.thorough)], ids=["some", "all"])
def site(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("site") / "pages"
    done = run("site", str(folder), "--values", "3", *(["--pages", *request.param] if request.param else []))
    assert done.returncode == 0, done.stderr
    return folder, pages(request.param), done.stdout.decode()


def test_the_index_leads_to_every_page_and_nowhere_else(site):
    folder, wanted, said = site
    index = (folder / "index.html").read_text(encoding="utf-8")
    targets = re.findall(r'href="([^"#]+)', index)
    assert {*targets} - {"data:,"} == {*wanted.values()}
    files = {path.relative_to(folder).as_posix(): path.stat().st_size for path in folder.rglob("*") if path.is_file()}
    assert files.keys() == {*wanted.values(), "index.html"}
    # The command lists the bytes of each page.
    for path, size in files.items():
        assert re.search(rf"{size:,} bytes +{re.escape(path)}", said)
    assert f"{sum(files.values()):,} bytes in" in said
    exhibits = {one.title for one in EXHIBITS if one.scene in wanted}
    assert exhibits <= {*re.findall(r"<strong>([^<]*)</strong>", index)}


def test_every_page_opens_and_its_sliders_move(site, browser):
    folder, wanted, _ = site
    with opened(browser, (folder / "index.html").as_uri(), ready="a.page") as page:
        titles = page.locator("a.page strong").all_inner_texts()
    for name, path in wanted.items():
        with opened(browser, (folder / path).as_uri(), (1280, 720)) as page:
            assert page.locator("a.contents").get_attribute("href") == "../index.html"
            if name in shipped():
                assert shipped()[name].title in titles
                assert page.locator(".lesson .count").inner_text() == f"1 / {len(shipped()[name].steps)}"
                continue
            assert scenes()[name].title in titles
            sliders = page.locator(".controls input.hand")
            assert sliders.count() == 2, name
            for i in range(2):
                if sliders.nth(i).is_enabled():
                    move(page, sliders.nth(i))
            for preset in [one.preset.name for one in EXHIBITS if one.scene == name]:
                change(page, page.locator(".param-preset select").select_option, preset)


def test_a_picture_of_the_gallery_opens_its_example(site, browser):
    folder, _, _ = site
    index = (folder / "index.html").read_text(encoding="utf-8")
    address = re.search(r'href="(scenes/suslov-hess.html#example=[^"]+)', index)[1]
    with opened(browser, f"{(folder / 'scenes').as_uri()}/{address.removeprefix('scenes/')}") as page:
        chosen = page.locator(".param-preset select").input_value()
        assert chosen in {one.preset.name for one in EXHIBITS if one.scene == "suslov-hess"}


@pytest.mark.thorough
def test_any_web_server_shows_it_also_in_a_frame(site, browser):
    folder, _, _ = site
    frame = '<!DOCTYPE html><iframe src="pages/scenes/suslov-hess.html" width="800" height="500"></iframe>'
    (folder.parent / "course.html").write_text(frame, encoding="utf-8")
    context = browser.new_context(reduced_motion="reduce")
    errors = []
    context.on("weberror", lambda error: errors.append(str(error.error)))
    with served(folder.parent) as base:
        page = context.new_page()
        page.goto(f"{base}/course.html")
        page.frame_locator("iframe").locator(READY).wait_for(state="attached")
        page.goto(f"{base}/pages/scenes/suslov-hess.html")
        page.locator(READY).wait_for(state="attached")
        page.locator("a.contents").click()
        page.get_by_role("heading", name="Lessons").wait_for()
    context.close()
    assert errors == []


def test_a_folder_with_other_files_and_an_unknown_page_are_refused(tmp_path):
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(InvalidParameter, match="holds other files: choose an empty one"):
        build(tmp_path)
    with pytest.raises(InvalidParameter, match="no page 'x': choose among limit-cycles-and-locking"):
        build(Path("nowhere"), ["x"])
