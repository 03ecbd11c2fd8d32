"""The site: built by one command, read from the disk with the network off."""

import re
from pathlib import Path

import pytest

from hess_explorer.lessons import package_lessons
from hess_explorer.offline.site import build, pages
from hess_explorer.scenes import scenes
from hess_mechanics.errors import InvalidParameter
from support.command_line import run
from support.offline import move, opened

SOME = ("suslov-hess", "scattering-by-a-nonholonomic-top")


@pytest.fixture(scope="module", params=[SOME, pytest.param((), marks=pytest.mark.thorough)], ids=["some", "all"])
def site(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("site") / "pages"
    done = run("site", str(folder), "--values", "3", *(["--pages", *request.param] if request.param else []))
    assert done.returncode == 0, done.stderr
    return folder, pages(request.param), done.stdout.decode()


def test_the_index_leads_to_every_page_and_nowhere_else(site):
    folder, wanted, said = site
    index = (folder / "index.html").read_text(encoding="utf-8")
    assert {*re.findall(r'href="([^"#]+)', index)} - {"data:,"} == {*wanted.values()}
    files = {path.relative_to(folder).as_posix(): path.stat().st_size for path in folder.rglob("*") if path.is_file()}
    assert files.keys() == {*wanted.values(), "index.html"}
    # The command lists the bytes of each page.
    for path, size in files.items():
        assert re.search(rf"{size:,} bytes +{re.escape(path)}", said)
    assert f"{sum(files.values()):,} bytes: open" in said


def test_every_page_opens_and_its_sliders_move(site, browser):
    folder, wanted, _ = site
    with opened(browser, (folder / "index.html").as_uri(), ready="li a") as page:
        titles = page.locator("li a").all_inner_texts()
    for name, path in wanted.items():
        with opened(browser, (folder / path).as_uri(), (1280, 720)) as page:
            if name in package_lessons():
                assert package_lessons()[name].title in titles
                assert page.locator(".lesson .count").inner_text() == f"1 / {len(package_lessons()[name].steps)}"
                continue
            assert scenes()[name].title in titles
            sliders = page.locator(".controls input.hand")
            assert sliders.count() == 2, name
            for i in range(2):
                if sliders.nth(i).is_enabled():
                    move(page, sliders.nth(i))


def test_a_folder_with_other_files_and_an_unknown_page_are_refused(tmp_path):
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(InvalidParameter, match="holds other files: choose an empty one"):
        build(tmp_path)
    with pytest.raises(InvalidParameter, match="no page 'x': choose among limit-cycles-and-locking"):
        build(Path("nowhere"), ["x"])
