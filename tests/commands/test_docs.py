"""The pages of the packages: every public name is on them, with its words, and they ask no other host."""

import re

import hess_mechanics
from hess_explorer.__main__ import main


def test_every_public_name_has_its_words_on_a_page_that_asks_no_other_host(tmp_path, capsys):
    assert main(["docs", "--out", str(tmp_path / "pages")]) == 0
    assert capsys.readouterr().err == ""
    page = (tmp_path / "pages/hess_mechanics.html").read_text(encoding="utf-8")
    assert [name for name in hess_mechanics.__all__ if f'id="{name}"' not in page] == []
    assert "The largest Lyapunov exponent of the orbit from a state" in page
    everything = "".join(path.read_text(encoding="utf-8") for path in (tmp_path / "pages").rglob("*.*"))
    assert re.findall(r"(?:src|href)=\"(?:https?:)?//(?!pdoc\.dev)[^\"]+\.(?:js|css)", everything) == []
    assert "hess-explorer docs" in hess_mechanics.__doc__


def test_what_cannot_be_written_is_refused_with_a_sentence(tmp_path, capsys, monkeypatch):
    (tmp_path / "file").write_text("")
    assert main(["docs", "--out", str(tmp_path / "file")]) == 2
    assert "choose another one." in capsys.readouterr().err
    monkeypatch.setitem(__import__("sys").modules, "pdoc", None)
    assert main(["docs", "--out", str(tmp_path / "pages")]) == 2
    assert "pip install 'hess-explorer[docs]'" in capsys.readouterr().err


