"""A command as data: its description, its options, and the function that runs it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hess_explorer.commands import arguments

if TYPE_CHECKING:
    from hess_mechanics.parameters import Parameter

__all__ = [
    "OUT",
    "OUTPUT",
    "STATE",
    "Command",
    "Option",
    "Options",
    "flag",
    "number",
    "option",
    "picture",
    "samples",
    "vector",
    "whole",
]

Options = argparse.Namespace
"""The parsed options of a command."""


@dataclass(frozen=True)
class Option:
    """An option: its name with the dashes (a positional argument without them), and its argparse settings."""

    name: str
    settings: Mapping[str, Any]


@dataclass(frozen=True)
class Command:
    """A command.

    Attributes
    ----------
    description : help text.
    options : its options.
    run : runs the command with the parsed options; raises `CommandError`.
    example : arguments of an example.
    purpose : short description of a subcommand.
    systems : subcommands by name; there are no options and no example then.
    kind : what the subcommands are, for the help text.
    exclusive : names of mutually exclusive options.
    """

    description: str = ""
    options: Sequence[Option] = ()
    run: Callable[[Options], None] | None = None
    example: str = ""
    purpose: str = ""
    systems: Mapping[str, Command] = field(default_factory=dict)
    exclusive: Sequence[str] = ()
    kind: str = "SYSTEM"

    def declare(self, parser: argparse.ArgumentParser) -> None:
        """Declare the command in a parser."""
        if self.systems:
            if self.description:
                parser.description = self.description
            systems = parser.add_subparsers(required=True, metavar=self.kind)
            for name, one in self.systems.items():
                one.declare(systems.add_parser(name, help=one.purpose))
            return
        parser.description = self.description
        if self.example:
            parser.epilog = f"Example: {parser.prog} {self.example}"
        group = parser.add_mutually_exclusive_group() if self.exclusive else parser
        for each in self.options:
            (group if each.name in self.exclusive else parser).add_argument(each.name, **each.settings)
        parser.set_defaults(run=self.run)


def option(name: str, help: str, **settings: Any) -> Option:
    """Return an option; settings : arguments of `ArgumentParser.add_argument`."""
    return Option(name, {"help": help, **settings})


def flag(name: str, help: str) -> Option:
    """Return an option without a value."""
    return option(name, help, action="store_true")


def _required(default: object) -> dict[str, Any]:
    return {"required": True} if default is None else {"default": default}


def number(of: Parameter, default: float | None = None, *, name: str = "", help: str = "", **settings: Any) -> Option:
    """Return the option of a parameter; it is required unless it has a default.

    name, help : replace those of the parameter.
    """
    description = help or of.doc
    if default is not None:
        description += f" (default {default:g})"
    return option(
        name or f"--{of.name}",
        description,
        type=arguments.checked(of),
        metavar=of.name.upper(),
        **{**_required(default), **settings},
    )


def vector(
    name: str, of: str | Sequence[Parameter], help: str, default: tuple[float, ...] | None = None, **settings: Any
) -> Option:
    """Return the option of a comma-separated list of numbers; of : parameters, or names such as "w1,w2"."""
    names = of if isinstance(of, str) else ",".join(one.name for one in of)
    return option(name, help, type=arguments.vector(of), metavar=names, **{**_required(default), **settings})


def whole(name: str, low: int, high: int, help: str, default: int | None = None) -> Option:
    """Return the option of an integer from `low` to `high`."""
    description = help if default is None else f"{help} (default {default})"
    return option(name, description, type=arguments.integer(low, high), metavar="N", default=default)


def samples(of: Parameter, help: str, default: list[float] | None = None) -> Option:
    """Return the option of many values of a parameter: a list or lo:hi:n."""
    return option(
        f"--{of.name}",
        f"{help}: a number, a list 1,2,3 or lo:hi:n",
        type=arguments.samples(of),
        metavar="VALUES",
        **_required(default),
    )


OUT = option("--out", "write to this file instead of standard output", type=Path, metavar="FILE")
OUTPUT = (
    option("--accuracy", "draft, standard, precise (default) or reference", default="precise", metavar="LEVEL"),
    option(
        "--format",
        "json (default): strict JSON with all digits; csv: a table, with other results as # comments",
        choices=("json", "csv"),
        default="json",
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
