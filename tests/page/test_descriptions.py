"""Descriptions of scenes are kept on disk, and what draws them is not loaded at the start."""

import subprocess
import sys

import pytest

from hess_explorer.page import description, descriptions
from support.page import HESS


@pytest.fixture
def drawn(tmp_path, monkeypatch):
    """drawn(name) → the description in a new process, which is the number of those drawn; files in `drawn.folder`."""
    times = []
    monkeypatch.setattr(description, "description", lambda name: times.append(name) or f"{len(times)}")
    monkeypatch.setattr(descriptions, "CACHE_FOLDER", tmp_path)
    found = descriptions.describe.__wrapped__

    def describe(name):
        return found(name)

    describe.folder = tmp_path
    return describe


def test_a_description_is_drawn_once_and_again_if_its_file_is_damaged_or_old(drawn):
    assert [drawn(HESS), drawn(HESS)] == ["1", "1"]
    (file,) = drawn.folder.iterdir()
    whole = file.read_text()
    for times, damaged in enumerate(("", "[]", whole[:-3], '[[], "of other sources"]', '{"a": 1}'), 2):
        file.write_text(damaged)
        assert [drawn(HESS), drawn(HESS)] == [f"{times}"] * 2


def test_a_file_that_is_changed_is_a_reason_to_draw_again(drawn, tmp_path_factory, monkeypatch):
    sources = tmp_path_factory.mktemp("sources")
    words = sources / "scene.md"
    words.write_text("words")
    monkeypatch.setattr(descriptions, "_SOURCES", (sources,))
    monkeypatch.setattr(descriptions, "_made_from", descriptions._made_from.__wrapped__)
    assert [drawn(HESS), drawn(HESS)] == ["1", "1"]
    words.write_text("other words")
    assert [drawn(HESS), drawn(HESS)] == ["2", "2"]


def test_a_scene_of_ones_own_is_drawn_in_each_process(drawn, monkeypatch):
    monkeypatch.setattr(descriptions, "is_shipped", lambda name: False)
    assert [drawn(HESS), drawn(HESS)] == ["1", "2"]
    assert list(drawn.folder.iterdir()) == []


def test_a_server_starts_without_what_only_some_pages_need():
    seldom = {"holoviews", "matplotlib", "panel_material_ui", "hess_explorer.sweep"}
    code = f"import sys, hess_explorer.server.serving; print({seldom!r} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"
