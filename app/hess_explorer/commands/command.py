"""A command as data: its description, its options, and the function that runs it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from hess_explorer.commands import CommandError, arguments

__all__ = ["OUT", "OUTPUT", "STATE", "Command", "Option", "Options", "Parser", "flag", "option", "picture", "whole"]

Options = argparse.Namespace
"""The parsed options of a command."""


class _Help(argparse.HelpFormatter):
    """Formatter that wraps each paragraph and keeps indented lists."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        parts = text.split("\n\n")
        return "\n\n".join(one if "\n  " in one else super(_Help, self)._fill_text(one, width, indent) for one in parts)


class Parser(argparse.ArgumentParser):
    """Argument parser that reports an error in one sentence, without the usage text, and knows no abbreviations."""

    def __init__(self, prog: str, usage: str, description: str, epilog: str = "") -> None:
        super().__init__(
            prog, f"{prog} {usage}", description, epilog, formatter_class=_Help, allow_abbrev=False, add_help=False
        )
        self.add_argument("-h", "--help", action="help", help="show this help and exit")

    def error(self, message: str) -> NoReturn:
        """Raise `CommandError`."""
        raise CommandError(f"{message} (see {self.prog} --help).")

    def list_words(self, heading: str, words: Mapping[str, str]) -> None:
        """Add a list of words with their meaning to the help text."""
        group = self.add_argument_group(heading)
        for word, meaning in words.items():
            group.add_argument(word, help=meaning.replace("%", "%%"))


@dataclass(frozen=True)
class Option:
    """An option.

    name : with the dashes; a positional argument has none.  settings : of `add_argument`.  group : heading in the help.
    """

    name: str
    settings: Mapping[str, Any]
    group: str = ""


@dataclass(frozen=True)
class Command:
    """A command.

    Attributes
    ----------
    description : help text.
    options : its options.
    run : runs the command with the parsed options; raises `CommandError`.
    example : arguments of an example.
    """

    description: str
    options: Sequence[Option]
    run: Callable[[Options], None]
    example: str = ""

    def parser(self, prog: str) -> Parser:
        """Return the parser of its arguments; prog : how the command is typed."""
        places = [one.settings["metavar"] for one in self.options if not one.name.startswith("-")]
        example = f"Example: {prog} {self.example}" if self.example else ""
        parser = Parser(prog, " ".join(["[OPTIONS]", *places]), self.description, example)
        groups: dict[str, argparse._ActionsContainer] = {"": parser}
        for one in self.options:
            if one.group not in groups:
                groups[one.group] = parser.add_argument_group(one.group)
            try:
                groups[one.group].add_argument(one.name, **one.settings)
            except argparse.ArgumentError as error:
                raise CommandError(f"{prog} has two options {one.name}: rename one of them.") from error
        parser.set_defaults(run=self.run)
        return parser


def option(name: str, help: str, group: str = "", **settings: Any) -> Option:
    """Return an option; settings : arguments of `ArgumentParser.add_argument`."""
    return Option(name, {"help": help, **settings}, group)


def flag(name: str, help: str) -> Option:
    """Return an option without a value."""
    return option(name, help, action="store_true")


def whole(name: str, low: int, high: int, help: str, default: int | None = None) -> Option:
    """Return the option of an integer from `low` to `high`."""
    description = help if default is None else f"{help} (default {default})"
    return option(name, description, type=arguments.integer(low, high), metavar="N", default=default)


OUT = option("--out", "write to this file instead of standard output", type=Path, metavar="FILE")
OUTPUT = (
    option("--accuracy", "draft, standard, precise (default) or reference", default="precise", metavar="LEVEL"),
    option(
        "--format",
        "text (default): the numbers, and the first and last rows; json: strict JSON with all digits; csv: a table, "
        "with other results as # comments; netcdf: arrays with their dimensions, needs --out",
        choices=("text", "json", "csv", "netcdf"),
        default="text",
    ),
    OUT,
)
STATE = (
    option(
        "--state",
        "a link to the page, or its part after ? (default: the first scene)",
        type=arguments.state_of,
        default="",
        metavar="QUERY",
    ),
    flag("--lenient", "correct errors in the state and report them in notes, instead of rejecting it"),
)


def picture(more: str = "") -> tuple[Option, ...]:
    """Return the options of a state, a picture and an output file; more : help text on several pictures."""
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
