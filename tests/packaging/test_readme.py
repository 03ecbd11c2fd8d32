"""Checks of the READMEs: code runs, links resolve, tables can be measured again."""

import re
import shlex
import subprocess
import tomllib

import pytest

from hess_explorer.__main__ import main, parse
from hess_explorer.commands.output import PATIENCE
from support.mechanics import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
DOCUMENTS = [
    ROOT / name
    for name in (
        "README.md",
        "app/README.md",
        "models/README.md",
        "tests/manual/integrators/README.md",
        "tests/models/README.md",
        "tests/manual/README.md",
        "tests/manual/offline.md",
        "tests/manual/server.md",
        "tests/manual/sweep.md",
        "app/hess_explorer/sweep/README.md",
        "app/hess_explorer/server/README.md",
        "tests/README.md",
        ".github/CONTRIBUTING.md",
        ".github/CHANGELOG.md",
    )
] + sorted((ROOT / "app/hess_explorer/docs").rglob("*.md"))


def blocks(language, text=README):
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


COMMANDS = [
    shlex.split(line, comments=True)[1:]
    for document in (README, (ROOT / "app/hess_explorer/docs/guides/commands.md").read_text(encoding="utf-8"))
    for block in blocks("sh", document)
    for line in block.splitlines()
    if line.startswith("hess-explorer ")
]


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_its_links_lead_somewhere(document):
    # Quoted code contains no links.
    text = re.sub(r"`[^`\n]*`", "", document.read_text(encoding="utf-8"))
    links = re.findall(r"\]\(([^)#\s]+)\)", text) + re.findall(r'(?:src|srcset|href)="([^"#]+)"', text)
    for link in links:
        if "://" not in link:
            assert (document.parent / link).exists(), link


def test_the_runs_on_other_processors_name_tests_that_exist():
    words = " ".join(re.findall(r"tests/[\w/.{},]+", (ROOT / ".ci/processors").read_text(encoding="utf-8")))
    paths = subprocess.run(["bash", "-c", f"echo {words}"], capture_output=True, text=True, check=True).stdout.split()
    assert len(paths) > 4
    assert [path for path in paths if not (ROOT / path).exists()] == []


def test_the_python_of_the_readme_runs(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (code,) = blocks("python")
    exec(compile(code, "README.md", "exec"), {})
    assert capsys.readouterr().out.startswith("hyperbolic ")
    assert (tmp_path / "circle.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize("words", COMMANDS, ids=lambda words: words[0])
def test_the_commands_of_the_readme_work(words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if words[0] in ("shot", "serve", "site") or "--lesson" in words:
        # They take long, and have tests of their own: here, that they are understood.
        parse(words)
        return
    assert main(words) == 0
    out, err = capsys.readouterr()
    # Progress begins with a carriage return.
    assert err.startswith("\r") or err in ("", f"{PATIENCE}\n")
    assert out or list(tmp_path.iterdir())


def test_measured_tables_name_their_programs():
    texts = (path.read_text(encoding="utf-8") for part in ("app", "tests") for path in (ROOT / part).rglob("*.md"))
    programs = [program for text in texts for program in re.findall("<!-- measured by (.*?) -->", text)]
    assert len(programs) >= 5
    assert all((ROOT / program).is_file() for program in programs)


def test_the_change_log_begins_with_the_version():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    newest = re.search(r"^## (\S+)", (ROOT / ".github/CHANGELOG.md").read_text(), re.MULTILINE)
    assert newest[1] == version


SECTIONS = {"1", "1.1", "2", "2.1", "3"}
"""Numbered sections of the paper; its appendix has no number."""
FIGURES = range(1, 15)


def test_words_cite_sections_and_figures_that_the_paper_has():
    files = [
        *(path for path in (ROOT / "app/hess_explorer/scenes").rglob("*") if path.suffix in (".py", ".md")),
        *(ROOT / "models").rglob("*.py"),
        ROOT / "models/README.md",
    ]
    sections = figures = 0
    for path in files:
        text = path.read_text(encoding="utf-8")
        for cited in re.findall(r"[Ss]ection (\d+(?:\.\d+)?)", text):
            sections += 1
            assert cited in SECTIONS, (path, cited)
        for cited in re.findall(r"[Ff]igures? (\d+)(?:(?:[–,]| and)[ ]?(\d+))*", text):
            figures += 1
            assert all(int(number) in FIGURES for number in cited if number), (path, cited)
    assert min(sections, figures) > 10
