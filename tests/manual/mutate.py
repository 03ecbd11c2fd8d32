"""Which tests notice a fault?  `python tests/manual/mutate.py [words…]` seeds the faults of "faults.toml" in turn.

Each fault is put into a copy of the repository, and the tests named beside it run until the first fails, which has to
pass without the fault.  With words only the faults whose names contain one of them.  `--random 30 --seed 1` draws
faults by operator and constant from the mechanics and the scenes instead, and runs the tests of the changed module, of
its folder and of its layer.  The exit code is the number of faults that nobody noticed.
"""

import argparse
import io
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import tokenize
import tomllib
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
ROOT = TESTS.parent
DRAWN = "models/hess_mechanics", "app/hess_explorer/scenes"
PAIRS = ("+", "-"), ("*", "/"), ("<", "<="), (">", ">="), ("==", "!="), ("and", "or")
SWAPS = {one: other for pair in PAIRS for one, other in (pair, pair[::-1])}


@dataclass(frozen=True)
class Fault:
    """Replace `old`, which occurs once in `file`, by `new`; some of `tests` should fail."""

    name: str
    file: str
    old: str
    new: str
    tests: list[str]


def faults(words):
    """Return the faults of "faults.toml" whose names contain one of the words, or all."""
    every = [Fault(**one) for one in tomllib.loads((TESTS / "faults.toml").read_text("utf-8"))["fault"]]
    return [one for one in every if not words or any(word in one.name for word in words)]


def not_found_once(chosen):
    """Return the names of faults that cannot be seeded: the file is missing, or the text does not occur just once."""
    return [
        one.name
        for one in chosen
        if not (ROOT / one.file).is_file() or (ROOT / one.file).read_text("utf-8").count(one.old) != 1
    ]


# ---- random faults ----------------------------------------------------------------------------------------------


def changes(source):
    """Yield (start, end, other) for each operator and number of Python code: other code for these characters of it."""
    lines = [0, *accumulate(map(len, source.splitlines(keepends=True)))]
    for kind, text, (row, column), _, _ in tokenize.generate_tokens(io.StringIO(source).readline):
        start = lines[row - 1] + column
        end = start + len(text)
        if kind == tokenize.NUMBER and "j" not in text:
            yield start, end, f"{2.0 * float(text) or 1.0}" if "." in text or "e" in text else f"{int(text, 0) + 1}"
        # An operator of two operands has a space on both sides.
        elif text in SWAPS and source[start - 1] == " " == source[end]:
            yield start, end, SWAPS[text]


def tests_of(file):
    """Return the tests of the module, of its folder and of its layer, in this order."""
    layer, folder = TESTS / ("models" if file.startswith("models") else "scenes"), Path(file).parent.name
    own = sorted(layer.rglob(f"test_*{Path(file).stem.removesuffix('_kernels')}*.py"))
    found = [*own, *([layer / folder] if (layer / folder).is_dir() else []), layer]
    return [str(path.relative_to(ROOT)) for path in found]


def drawn(count, seed):
    """Return this many random faults, the same for the same sources."""
    files = sorted(path for folder in DRAWN for path in (ROOT / folder).rglob("*.py"))
    every = [(path, *change) for path in files for change in changes(path.read_text("utf-8"))]
    for path, start, end, other in random.Random(seed).sample(every, count):
        source, file = path.read_text("utf-8"), path.relative_to(ROOT).as_posix()
        name = f"{file}:{source[:start].count(chr(10)) + 1} {source[start:end]} → {other}"
        yield Fault(name, file, source, source[:start] + other + source[end:], tests_of(file))


# ---- seeding ----------------------------------------------------------------------------------------------------


def copied(folder):
    """Copy all files that git tracks or would add."""
    listing = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(listing, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


def failure(copy, mechanics, tests, limit):
    """Return the first test that fails in the copy with these mechanics, or None if all pass."""
    env = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(map(str, (copy / "app", mechanics))),
        # A copy with the time stamps of another fault would be taken for this one.
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", "--tb=line", *tests]
    run = subprocess.run(command, cwd=copy, env=env, capture_output=True, text=True, timeout=limit, check=False)
    if run.returncode == 0:
        return None
    failed = re.search(r"^(?:FAILED|ERROR) (tests/[^\s\[]+)", run.stdout, re.MULTILINE)
    if failed is None:
        raise RuntimeError(run.stdout[-300:] + run.stderr[-300:])
    return failed[1]


def seeded(fault, copy, limit):
    """Seed the fault, run its tests, restore the file; return whether one notices it, and what happened."""
    path = copy / fault.file
    text = path.read_text("utf-8")
    path.write_text(text.replace(fault.old, fault.new), "utf-8")
    try:
        # Kernels belong to the folder of their source: where that is whole, those that are there already will do.
        mechanics = (copy if fault.file.startswith("models/") else ROOT) / "models"
        failed = failure(copy, mechanics, fault.tests, limit)
    except (subprocess.TimeoutExpired, RuntimeError) as error:
        return False, f"NOT KNOWN: {error}"
    finally:
        path.write_text(text, "utf-8")
    if failed is None:
        return False, "NOT NOTICED"
    # A machine that is too busy, or a test that fails anyway, has noticed nothing.
    if ".py::" in failed and failure(copy, ROOT / "models", [failed], limit) is not None:
        return False, f"FAILS WITHOUT THE FAULT TOO: {failed}"
    return True, f"noticed by {failed}"


def main():
    """Seed the faults, run the tests, print what happened."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("words", nargs="*", help="only faults whose names contain one of these")
    parser.add_argument("--random", type=int, metavar="N", help="draw so many faults instead")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=float, default=1800.0, help="seconds that the tests of a fault may take")
    parser.add_argument("--list", action="store_true", help="only print the faults and their tests")
    options = parser.parse_args()
    chosen = list(drawn(options.random, options.seed)) if options.random else faults(options.words)
    if options.list:
        print("\n".join(f"{one.name}: {' '.join(one.tests)}" for one in chosen))
        return 0
    noticed = 0
    with tempfile.TemporaryDirectory() as folder:
        copy = copied(Path(folder))
        for fault in chosen:
            ok, said = seeded(fault, copy, options.limit)
            noticed += ok
            print(f"{fault.name}: {said}", flush=True)
    print(f"{noticed} of {len(chosen)} are noticed.")
    return len(chosen) - noticed


if __name__ == "__main__":
    sys.exit(main())
