"""`hess-explorer lesson`: the mistakes of a file, and an example to begin with."""

import re

import pytest

from hess_explorer.__main__ import main
from hess_explorer.lessons.reading import KEYS, read_file
from hess_mechanics.suslov_hess.bifurcation import f_max


def test_the_example_is_a_lesson_with_all_settings_but_two_and_is_not_written_over(tmp_path, capsys):
    path = tmp_path / "first.md"
    assert main(["lesson", "new", str(path)]) == 0
    assert f"hess-explorer serve --lesson {path}" in capsys.readouterr().out
    text = path.read_text(encoding="utf-8")
    assert [key for key in KEYS if f"\n{key}: " not in text] == ["example", "pictures"]
    assert main(["lesson", "check", str(path)]) == 0
    assert capsys.readouterr().out == f"{path}: {len(read_file(path).steps)} steps, no mistakes\n"
    path.write_text("mine")
    for file, said in ((path, "exists: choose another name"), (tmp_path / "nowhere/first.md", "Cannot write")):
        assert main(["lesson", "new", str(file)]) == 2
        assert said in capsys.readouterr().err
    assert path.read_text() == "mine"


def test_mistakes_are_printed_by_file_and_line(tmp_path, capsys):
    good, wrong, corrected = (tmp_path / f"{name}.md" for name in ("good", "wrong", "corrected"))
    main(["lesson", "new", str(good)])
    whole = good.read_text(encoding="utf-8")
    text = whole.replace("look: circle", "look: circel").replace("minutes: 5", "minutes: -5")
    wrong.write_text(text, encoding="utf-8")
    # A state that the scene would correct is a mistake too.
    corrected.write_text(whole.replace('h=1.5&f=0.6"}', 'h=0.5&f=2"}'), encoding="utf-8")
    numbers = [n for n, line in enumerate(text.split("\n"), 1) if line in ("minutes: -5", "look: circel")]
    capsys.readouterr()
    assert main(["lesson", "check", str(tmp_path)]) == 1
    out, err = capsys.readouterr()
    assert [int(line) for line in re.findall(rf"^{wrong}:(\d+):", out, re.MULTILINE)] == numbers
    assert len(numbers) == 4
    line = whole.split("\n").index("## Guess") + 1
    found = re.search(rf"{corrected}:{line}: the state of predict is not possible: choose f = ([\d.]+)\. ", out)
    assert float(found[1]) == pytest.approx(f_max(0.5), rel=1e-4)
    assert f"{good}: 3 steps, no mistakes" in out
    assert err == "hess-explorer: 5 mistakes found.\n"


def test_what_is_not_there_has_a_mistake(tmp_path, capsys):
    assert main(["lesson", "check", str(tmp_path / "none.md")]) == 1
    assert "none.md:1: the file cannot be read" in capsys.readouterr().out
    for words in (["lesson", "check"], ["export", "--format", "html", "--lesson"], ["serve", "--lesson"]):
        assert main([*words, f"{'1' * 300}.md"]) == 2
        assert capsys.readouterr().err.endswith(": File name too long.\n")
    assert main(["lesson", "check", str(tmp_path)]) == 2
    assert "has no lesson" in capsys.readouterr().err
