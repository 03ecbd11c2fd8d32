"""`hess-explorer lesson`: check a lesson file, or create one from an example."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from . import CommandError
from .command import Command, option
from .output import write_file

_GUIDE = Path(str(files("hess_explorer"))) / "docs/guides/lesson.md"


def _check(files: list[Path]) -> None:
    from hess_explorer.lessons.collection import examine_files, files_in

    count = 0
    for path, lesson, problems in examine_files(files_in(files)):
        for problem in sorted(problems, key=lambda one: one.line):
            print(f"{path}:{problem.line}: {problem.message}")
        if lesson is not None and not problems:
            print(f"{path}: {len(lesson.steps)} steps, no mistakes")
        count += len(problems)
    if count:
        raise CommandError(f"{count} {'mistake' if count == 1 else 'mistakes'} found.", status=1)


def _new(files: list[Path]) -> None:
    from hess_explorer.lessons.example import EXAMPLE

    for file in files:
        if file.exists():
            raise CommandError(f"{str(file)!r} exists: choose another name.")
        write_file(file, EXAMPLE.encode())
        print(f"Wrote {file}.  Open it with: hess-explorer serve --lesson {file}")


COMMAND = Command(
    f"Help to write a lesson: one Markdown file, given step by step on the page.  The format: {_GUIDE}",
    (
        option(
            "action",
            "check: print the mistakes in lessons, each with file and line; the exit status is 1 if there is one.  "
            "new: write an example with comments, to be changed into your own lesson",
            choices=("check", "new"),
            metavar="ACTION",
        ),
        option(
            "files",
            "Markdown files of lessons; with check also folders of them; with new they must not exist yet",
            type=Path,
            nargs="+",
            metavar="FILE",
        ),
    ),
    lambda options: (_new if options.action == "new" else _check)(options.files),
    "check first.md",
)
