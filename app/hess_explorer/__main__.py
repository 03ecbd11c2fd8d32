"""Command line of the explorer.  `hess-explorer` alone serves the page; other commands compute or draw without it."""

from __future__ import annotations

import io
import re
import sys
from collections.abc import Sequence
from importlib import import_module, metadata

from hess_explorer.commands import COMMANDS, HEADINGS, CommandError
from hess_explorer.commands.command import Command, Options


def _with_command(words: list[str]) -> list[str]:
    """Prepend `serve` when the arguments name no command."""
    if words and (not words[0].startswith("-") or words[0] in ("-h", "--help", "--version")):
        return words
    return ["serve", *words]


def _with_negative_values(words: list[str]) -> list[str]:
    """Join `--omega -0.4,0.2` to `--omega=-0.4,0.2`; argparse would read the value as an option."""
    joined: list[str] = []
    for word in words:
        if joined and re.match(r"-([\d.]|inf|nan)", word, re.IGNORECASE) and re.fullmatch(r"--[\w-]+", joined[-1]):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def parse(words: Sequence[str]) -> Options:
    """Return the options of a command line, with the function `run` of the command.

    Only the module of the command is imported.  Raises `CommandError` for invalid arguments.
    """
    name, *rest = _with_negative_values(_with_command(list(words)))
    if name in COMMANDS:
        command: Command = import_module(f"hess_explorer.commands.{name}").COMMAND
        return command.parse(f"hess-explorer {name}", rest)
    from hess_explorer.commands import compute

    if not name.startswith("-"):
        return compute.parse(name, rest)
    parser = Command(
        "An interactive explorer of the Suslov problem, its Hess case and their relatives.  Without a command: serve.  "
        "COMMAND --help shows the options of a command.",
    )
    parser.add_argument("--version", action="version", version=f"hess-explorer {metadata.version('hess-explorer')}")
    for heading in HEADINGS:
        by_hand = {name: purpose for name, (of, purpose) in COMMANDS.items() if of == heading}
        parser.list_words(heading, {**by_hand, **compute.titles(heading)})
    return parser.parse("hess-explorer [COMMAND]", [name])


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments after the program name; by default those of the process.

    Returns
    -------
    int
        0 on success, 1 if a check has found mistakes or cells of a sweep have failed, 2 if the command cannot be
        carried out, 130 if it was interrupted.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    # A terminal that does not use UTF-8 shows Greek letters as escape sequences.
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        options = parse(words)
        options.run(options)
    except CommandError as error:
        print(f"hess-explorer: {error}", file=sys.stderr)
        return error.status
    except ValueError as error:
        from hess_mechanics.errors import ModelError

        if not isinstance(error, ModelError):
            raise
        print(f"hess-explorer: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        # Commands report expected errors of files; this one is unexpected, such as a failing disk.
        named = "" if error.filename is None else f"{error.filename!r} cannot be used: "
        print(f"hess-explorer: {named}{error.strerror or error}.", file=sys.stderr)
        return 2
    except KeyboardInterrupt as error:
        print(f"hess-explorer: {str(error) or 'interrupted.'}", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
