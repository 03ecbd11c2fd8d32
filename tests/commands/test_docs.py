"""The documentation: its tutorials run, every public name is in it, and it loads nothing from another host."""

import math
import re
import webbrowser
from importlib.resources import files
from itertools import pairwise

import numpy as np
import pytest

import hess_explorer
import hess_mechanics
from hess_explorer import sweep
from hess_explorer.__main__ import main
from hess_explorer.scenes import scenes
from hess_mechanics.catalogue import catalogue, motions

TUTORIALS = files("hess_explorer") / "docs" / "tutorials"
thorough = pytest.mark.thorough  # the build takes a minute


def run(name):
    """Run the cells of a tutorial as a notebook does; return its names."""
    text = (TUTORIALS / f"{name}.md").read_text(encoding="utf-8")
    cells = re.findall(r"^```\{code-cell\}\n(?::[^\n]*\n)*(.*?)^```", text, re.DOTALL | re.MULTILINE)
    assert len(cells) == text.count("```{code-cell}") > 0
    names = {"__name__": "__main__"}
    for cell in cells:
        exec(compile(cell, name, "exec"), names)
    return names


@pytest.mark.parametrize("name", ["circle_map", "section", "theorem"])
def test_the_code_of_a_tutorial_runs(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run(name)


def test_what_the_tutorial_on_certainty_says_is_so(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = run("certainty")
    draft, standard, precise = names["orbits"].values()
    for coarse, fine in ((draft, standard), (standard, precise)):
        change = np.abs(coarse.states - fine.states).max()
        assert 0.0 < change <= coarse.error_estimate + fine.error_estimate
    # The integral over one period in closed form: Wallis' product.
    n = 100_000_000
    exact = 100.0 / math.sqrt(math.pi) * math.exp(math.lgamma((n + 1) / 2) - math.lgamma(n / 2 + 1))
    assert names["exact"] == pytest.approx(exact, rel=1e-6)
    missed, *met = names["ends"].values()
    assert missed == 0.0
    # A rounded sine to the power n has a relative error of n times 1e-16.
    assert met == pytest.approx([exact, exact], rel=1e-7)
    values = names["values"]
    assert all(0.0 < after < 0.7 * before for before, after in pairwise(values))
    proved = names["proved"]
    assert proved.tube.complete
    assert 0.0 < proved.least <= proved.largest <= proved.orbit.error_estimate


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("docs")
    assert main(["docs", "--out", str(folder)]) == 0
    return {str(file.relative_to(folder)): file.read_text(encoding="utf-8") for file in folder.rglob("*.html")}


@thorough
def test_every_public_name_computation_and_scene_is_in_it_and_it_loads_nothing_from_another_host(site):
    for page, package in (("hess_mechanics", hess_mechanics), ("hess_explorer", hess_explorer), ("sweep", sweep)):
        names = set(re.findall(r'<dt[^>]* id="([\w.]+)"', site[f"api/{page}.html"]))
        assert [name for name in package.__all__ if f"{package.__name__}.{name}" not in names] == []
    text = site["api/computations.html"]
    names = {one.name for one in catalogue().values()}
    assert [name for name in (*names, *(f"system-{one}" for one in motions())) if f'id="{name}"' not in text] == []
    # With the output of its example.
    assert len(re.findall("\ncomputation: ", re.sub("<[^>]+>", "", text))) == len(names)
    shown = [scene for scene in scenes().values() if scene.origin is None]
    assert [scene.title for scene in shown if scene.title not in site["gallery.html"]] == []
    assert len(re.findall(r"<img[^>]*_images/", site["gallery.html"])) == len(shown)
    # Links are allowed; scripts, styles, pictures and fonts from other hosts are not.
    loaded = re.compile(r'<(?:script|img|iframe)[^>]*src="(?:https?:)?//|<link[^>]*href="(?:https?:)?//', re.IGNORECASE)
    assert {name: loaded.findall(text) for name, text in site.items() if loaded.search(text)} == {}


def test_a_build_that_cannot_be_is_refused_with_a_sentence(tmp_path, capsys, monkeypatch):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    (tmp_path / "file").write_text("")
    assert main(["docs", "--out", str(tmp_path / "file")]) == 2
    said = capsys.readouterr().err
    assert "could not be built" in said
    assert "pip install 'hess-explorer[docs" in said
    assert opened == []
