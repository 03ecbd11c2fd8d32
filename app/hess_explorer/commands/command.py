"""A command: its description, its options, and the function that runs it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn

from hess_explorer.commands import CommandError, arguments

Options = argparse.Namespace
"""The parsed options of a command."""


class _Help(argparse.HelpFormatter):
    """Formatter that wraps each paragraph and keeps indented lists."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        parts = text.split("\n\n")
        return "\n\n".join(one if "\n  " in one else super(_Help, self)._fill_text(one, width, indent) for one in parts)


Option = tuple[str, str, Mapping[str, Any]]
"""Name with the dashes, which a positional argument lacks; heading in the help; settings of `add_argument`."""


class Command(argparse.ArgumentParser):
    """A command that reports errors in one sentence, without the usage text, and accepts no abbreviations.

    Parameters
    ----------
    description : str
        Help text.
    options : sequence of Option
        Options and positional arguments.
    run : callable or None
        Runs the command with the parsed options, and may raise `CommandError`; None for a command with help only.
    example : str
        Arguments of an example.
    """

    def __init__(
        self,
        description: str,
        options: Sequence[Option] = (),
        run: Callable[[Options], None] | None = None,
        example: str = "",
    ) -> None:
        super().__init__(description=description, formatter_class=_Help, allow_abbrev=False)
        self.example = example
        self.places = [settings["metavar"] for name, _, settings in options if not name.startswith("-")]
        self.set_defaults(run=run)
        groups: dict[str, argparse._ActionsContainer] = {"": self}
        for name, group, settings in options:
            if group not in groups:
                groups[group] = self.add_argument_group(group)
            try:
                groups[group].add_argument(name, **settings)
            except argparse.ArgumentError as error:
                raise CommandError(f"There are two options {name}: rename one of them.") from error

    def parse(self, prog: str, words: Sequence[str] | None = None) -> Options:
        """Parse the arguments of a command line.

        Parameters
        ----------
        prog : str
            Name of the program in messages.
        words : sequence of str, optional
            The arguments, by default those of this process.

        Returns
        -------
        Options
            The values of the options.

        Raises
        ------
        CommandError
            If the arguments are invalid.
        """
        self.prog, self.usage = prog, " ".join([prog, "[OPTIONS]", *self.places])
        self.epilog = f"Example: {prog} {self.example}" if self.example else ""
        return self.parse_args(words)

    def error(self, message: str) -> NoReturn:
        """Raise `CommandError` with a message of `argparse`."""
        raise CommandError(f"{message} (see {self.prog} --help).")

    def list_words(self, heading: str, words: Mapping[str, str]) -> None:
        """Add a list of words with their meaning to the help text."""
        group = self.add_argument_group(heading)
        for word, meaning in words.items():
            group.add_argument(word, help=meaning.replace("%", "%%"))


def option(name: str, help: str, group: str = "", **settings: Any) -> Option:
    """Return an option with further arguments of `ArgumentParser.add_argument`."""
    return name, group, {"help": help, **settings}


def flag(name: str, help: str) -> Option:
    """Return an option without a value."""
    return option(name, help, action="store_true")


def integer_option(name: str, low: int, high: int, help: str, default: int) -> Option:
    """Return the option of an integer from `low` to `high`, both included."""
    return option(name, f"{help} (default {default})", type=arguments.integer(low, high), metavar="N", default=default)


OUT = option("--out", "write to this file instead of standard output", type=Path, metavar="FILE")
OUTPUT = (
    option("--accuracy", "draft, standard, precise (default) or reference", default="precise", metavar="LEVEL"),
    option(
        "--format",
        "text (default): the numbers, and the first and last rows; json: strict JSON with all digits; csv: a table, "
        "with other results as # comments; netcdf: arrays with their dimensions, for --out",
        choices=("text", "json", "csv", "netcdf"),
        default="text",
    ),
    OUT,
)
STATE = (
    option(
        "--state",
        "a link to the page, or its part after ? (default: the first scene)",
        type=arguments.state,
        default="",
        metavar="QUERY",
    ),
    flag("--lenient", "correct errors in the state and report them in notes, instead of rejecting it"),
)


def picture(more: str = "") -> tuple[Option, ...]:
    """Return the options of a state, a picture and an output file; `more` is help text on several pictures."""
    return (
        *STATE,
        option(
            "--picture",
            f"name of the picture, as in `pictures` of an embedding link (default: the first{more})",
            default="",
            metavar="NAME",
        ),
        OUT,
    )
