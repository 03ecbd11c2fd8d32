"""Which tests notice a fault?  `python tests/manual/mutate.py [words…]` seeds the faults of "faults.toml" in turn.

Each fault is put into a copy of the repository, the tests named beside it run until the first fails, and that test has
to pass without the fault.  A table is printed: fault, file, the test that noticed it, seconds.  With words only the
faults whose names contain one of them; `--write` keeps the table in "README.md".  The exit code is the number of faults
that nobody noticed or that could not be seeded.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
ROOT = TESTS.parent
README = TESTS / "README.md"
MARKS = "<!-- faults -->", "<!-- end of faults -->"
SECONDS = 900
"""The longest that the tests of a fault may take."""
NOTICED, CLEAN = 1, 0
"""Exit codes of pytest: a test failed; all passed."""


@dataclass(frozen=True)
class Fault:
    """Replace `old`, which occurs once in `file`, by `new`; some of `tests` should fail."""

    name: str
    file: str
    old: str
    new: str
    tests: list[str]


@dataclass(frozen=True)
class Outcome:
    """`by`: the test that failed first, or what went wrong; `ok`: a test noticed the fault."""

    fault: Fault
    ok: bool
    by: str
    seconds: float


def faults(words: list[str]) -> list[Fault]:
    """Return the faults of "faults.toml" whose names contain one of the words, or all."""
    every = [Fault(**one) for one in tomllib.loads((TESTS / "faults.toml").read_text("utf-8"))["fault"]]
    return [one for one in every if not words or any(word in one.name for word in words)]


def not_found_once(chosen: list[Fault]) -> list[str]:
    """Return the names of faults that cannot be seeded: the file is missing, or the text does not occur just once."""
    return [
        one.name
        for one in chosen
        if not (ROOT / one.file).is_file() or (ROOT / one.file).read_text("utf-8").count(one.old) != 1
    ]


def copied(folder: Path) -> Path:
    """Copy all files that git tracks or would add."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


def pytest_in(copy: Path, mechanics: Path, tests: list[str]) -> tuple[int, str]:
    """Exit code and output of the tests in the copy, with these mechanics, until the first fails."""
    # Nothing compiled is kept: a copy with the time stamps of another fault would be taken for this one.
    env = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(map(str, (copy / "app", mechanics))),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", "--tb=line", *tests]
    try:
        run = subprocess.run(command, cwd=copy, env=env, capture_output=True, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return -1, f"took longer than {SECONDS} s"
    return run.returncode, run.stdout + run.stderr


def seeded(fault: Fault, copy: Path) -> Outcome:
    """Run the tests on the copy with this fault, restore the file, and return the outcome."""
    path, begun = copy / fault.file, time.monotonic()
    if not path.exists():
        return Outcome(fault, False, "NO SUCH FILE", 0.0)
    text = path.read_text("utf-8")
    if (count := text.count(fault.old)) != 1:
        return Outcome(fault, False, f"THE TEXT STANDS THERE {count} TIMES", 0.0)
    path.write_text(text.replace(fault.old, fault.new), "utf-8")
    try:
        # Kernels belong to the folder of their source: where that is whole, those that are there already will do.
        whole = not fault.file.startswith("models/")
        code, said = pytest_in(copy, (ROOT if whole else copy) / "models", fault.tests)
    finally:
        path.write_text(text, "utf-8")
    seconds = time.monotonic() - begun
    if code == CLEAN:
        return Outcome(fault, False, "NOBODY", seconds)
    failed = re.search(r"^(?:FAILED|ERROR) (tests/.+?)(?: - .*)?$", said, re.MULTILINE)
    if code != NOTICED or failed is None:
        return Outcome(fault, False, f"PYTEST DID NOT RUN ({code}): {said.strip().splitlines()[-1]}", seconds)
    # A machine that is too busy, or a test that fails anyway, has noticed nothing.
    test = failed[1].split("[")[0]
    code, _ = pytest_in(copy, ROOT / "models", [test])
    if code != CLEAN:
        return Outcome(fault, False, f"FAILS WITHOUT THE FAULT TOO: {test}", seconds)
    return Outcome(fault, True, test.removeprefix("tests/"), seconds)


def table(outcomes: list[Outcome]) -> str:
    """The outcomes as a table of Markdown."""
    rows = [
        f"| {one.fault.name} | `{one.fault.file}` | {f'`{one.by}`' if one.ok else f'**{one.by}**'} "
        f"| {one.seconds:.0f} |"
        for one in outcomes
    ]
    noticed = sum(one.ok for one in outcomes)
    return "\n".join(
        [
            f"{noticed} of {len(outcomes)} faults are noticed.",
            "",
            "| fault | file | noticed by | s |",
            "|---|---|---|---:|",
            *rows,
        ]
    )


def main() -> int:
    """Seed the faults, run the tests, print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("words", nargs="*", help="only faults whose names contain one of these")
    parser.add_argument("--write", action="store_true", help=f"keep the table in {README.name}")
    parser.add_argument("--anchors", action="store_true", help="only look whether each fault can be seeded")
    given = parser.parse_args()
    chosen = faults(given.words)
    if given.anchors:
        missing = not_found_once(chosen)
        print("\n".join(f"NOT FOUND ONCE: {name}" for name in missing) or f"All {len(chosen)} are found.")
        return len(missing)
    outcomes = []
    with tempfile.TemporaryDirectory() as folder:
        copy = copied(Path(folder))
        for fault in chosen:
            outcomes.append(seeded(fault, copy))
            print(f"{outcomes[-1].by}: {fault.name} ({outcomes[-1].seconds:.0f} s)", file=sys.stderr, flush=True)
    print(table(outcomes))
    if given.write:
        before, rest = README.read_text("utf-8").split(MARKS[0])
        after = rest.split(MARKS[1])[1]
        README.write_text(f"{before}{MARKS[0]}\n{table(outcomes)}\n{MARKS[1]}{after}", "utf-8")
    return sum(not one.ok for one in outcomes)


if __name__ == "__main__":
    sys.exit(main())
