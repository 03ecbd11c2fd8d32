"""The pages of the packages: every public name is on them, with its words, and they ask no other host."""

import html
import inspect
import re
import sys
import webbrowser

import hess_explorer
import hess_mechanics
from hess_explorer import sweep
from hess_explorer.__main__ import main
from hess_explorer.commands import docs


def test_every_public_name_has_its_words_on_a_page_that_asks_no_other_host(tmp_path, capsys):
    assert main(["docs", "--out", str(tmp_path / "pages")]) == 0
    assert capsys.readouterr().err == ""
    index = (tmp_path / "pages/index.html").read_text(encoding="utf-8")
    for package in (hess_mechanics, hess_explorer, sweep):
        page = html.unescape((tmp_path / f"pages/{package.__name__}.html").read_text(encoding="utf-8"))
        for name in package.__all__:
            # What Python says of it, which imports the package, as the pages do not.
            one = getattr(package, name)
            assert f"id='{name}'" in page and f"{package.__name__}.html#{name}" in index
            if inspect.isfunction(one) or inspect.isclass(one):
                assert (inspect.getdoc(one) or "") in page
            if inspect.isfunction(one):
                assert [
                    key
                    for key in inspect.signature(one).parameters
                    if not re.search(rf"<h2 id='{name}'>[^<]*\b{key}\b", page)
                ] == []
    everything = "".join(path.read_text(encoding="utf-8") for path in (tmp_path / "pages").iterdir())
    assert re.findall(r"(?:src|href)\s*=\s*.?(?:https?:)?//", everything) == []
    # `help` leads there.
    assert "hess-explorer docs" in hess_mechanics.__doc__ and "hess-explorer docs" in hess_explorer.__doc__


def test_they_are_opened_where_they_are_and_made_where_the_packages_are_edited(tmp_path, capsys, monkeypatch):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert main(["docs"]) == 0
    made = capsys.readouterr().out.strip()
    assert made.startswith(str(tmp_path)) and opened == [f"file://{made}"]
    (tmp_path / "packed").mkdir()
    (tmp_path / "packed/index.html").write_text("packed", encoding="utf-8")
    monkeypatch.setattr(docs, "_PACKED", tmp_path / "packed")
    assert main(["docs"]) == 0
    assert opened[1:] == [(tmp_path / "packed/index.html").as_uri()]
    assert main(["docs", "--out", str(tmp_path / "copy")]) == 0
    assert (tmp_path / "copy/index.html").read_text(encoding="utf-8") == "packed"


def test_what_cannot_be_written_is_refused_with_a_sentence(tmp_path, capsys, monkeypatch):
    (tmp_path / "file").write_text("")
    assert main(["docs", "--out", str(tmp_path / "file")]) == 2
    assert "choose another one." in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "griffe", None)
    assert main(["docs", "--out", str(tmp_path / "pages")]) == 2
    assert "pip install 'hess-explorer[docs]'" in capsys.readouterr().err
