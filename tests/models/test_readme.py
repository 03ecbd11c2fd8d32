"""Checks of models/README.md: its example runs, its table is complete, kernels have their own files."""

import ast
import re
from pathlib import Path

import pytest

import hess_mechanics

PACKAGE = Path(hess_mechanics.__file__).parent
README = (PACKAGE.parent / "README.md").read_text(encoding="utf-8")
ROWS = [[cell.strip() for cell in row.strip("|").split("|")] for row in re.findall(r"^\|.*\|$", README, re.MULTILINE)]
SUBJECTS = [row for row in ROWS if len(row) == 5 and row[0] not in ("subject", "---")]
NUMBERED = re.compile(r"\bS\d+(\.\d)?\b")


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


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


@pytest.mark.parametrize("path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_files_cite_labels_of_the_table_only(path):
    text = path.read_text(encoding="utf-8")
    assert not NUMBERED.search(text), "internal numbers of subjects mean nothing to a reader"
    cited = set(re.findall(r"`((?:Biz|biz|bizi|eqs?|Geq|hh|gess|klas|m15|fig|g2p)[-\w*.]*\d[-\w*.]*)`", text))
    assert cited <= LABELS, cited - LABELS


def decorators(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))
    return {ast.unparse(decorator) for function in functions for decorator in function.decorator_list}


@pytest.mark.parametrize("path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_kernels_are_in_files_told_apart_by_name(path):
    has_kernels = bool(decorators(path) & {"kernel", "inner", "part", "as_written"})
    assert has_kernels == path.name.endswith("kernels.py")
    # mypy's patterns cannot tell them by the end of their names: each says so itself.
    assert path.read_text(encoding="utf-8").startswith("# mypy: allow-untyped-defs\n") == has_kernels
