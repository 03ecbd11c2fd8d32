"""Checks of models/README.md: its example runs, its table is complete, kernels have their own files."""

import re
from pathlib import Path

import hess_mechanics

PACKAGE = Path(hess_mechanics.__file__).parent
README = (PACKAGE.parent / "README.md").read_text(encoding="utf-8")
ROWS = [[cell.strip() for cell in row.strip("|").split("|")] for row in re.findall(r"^\|.*\|$", README, re.MULTILINE)]
SUBJECTS = [row for row in ROWS if len(row) == 5 and row[0] not in ("subject", "---")]


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


FILES = sorted(PACKAGE.rglob("*.py"))
LABELS = {label for row in SUBJECTS for label in quoted(row[2])}


def test_the_example_runs_and_says_what_its_comments_say():
    names = {}
    exec(re.search(r"```python\n(.*?)```", README, re.DOTALL)[1], names)
    assert (names["theta"].kind, names["theta"].rotation_number) == ("hyperbolic", 0.0)
    assert len(names["theta"].fixed_points) == 2
    assert names["orbit"].states.shape == (500, 5)


def test_every_subject_has_a_row_and_every_row_a_file():
    named = {path for row in SUBJECTS for path in quoted(row[3])}
    packages = ("suslov", "suslov_hess", "chaplygin_ball", "euler_poisson")
    files = {str(path.relative_to(PACKAGE)) for name in packages for path in (PACKAGE / name).glob("*.py")}
    subjects = {path for path in files if not path.endswith(("__init__.py", "kernels.py"))}
    assert subjects <= named
    assert all((PACKAGE / path).is_file() for path in named)


def test_files_cite_labels_of_the_table_only():
    label = re.compile(r"`((?:Biz|biz|bizi|eqs?|Geq|hh|gess|klas|m15|fig|g2p)[-\w*.]*\d[-\w*.]*)`")
    cited = {(one, path.name) for path in FILES for one in label.findall(path.read_text(encoding="utf-8"))}
    assert not {(one, name) for one, name in cited if one not in LABELS}
