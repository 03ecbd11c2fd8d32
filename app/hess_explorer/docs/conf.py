"""Sphinx configuration of the documentation.  `hess-explorer docs` builds it, without network access."""

import inspect
import io
import shlex
from collections.abc import Iterable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from importlib.metadata import version as installed

from sphinx.application import Sphinx

from hess_explorer.__main__ import main
from hess_explorer.commands.compute import command_of
from hess_mechanics.catalogue import Computation, catalogue, motions
from hess_mechanics.numerics.accuracy import levels_table
from hess_mechanics.parameters import Parameter, plain

project = "Hess Explorer"
version = release = installed("hess-explorer")

extensions = ["myst_nb", "sphinx.ext.autodoc", "numpydoc"]
html_theme = "furo"
html_title = "Hess Explorer"
html_show_sourcelink = html_show_copyright = False

# Stop the build if a tutorial fails.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_execution_in_temp = True
nb_execution_timeout = 300
suppress_warnings = ["mystnb.unknown_mime_type"]  # HoloViews loads scripts of this type in a notebook.

autodoc_member_order = "alphabetical"
autodoc_typehints = "none"  # numpydoc shows the types of the parameters
numpydoc_show_class_members = False


def _escape_bars(app: object, what: str, name: str, of: object, options: object, lines: list[str]) -> None:
    """Escape the bars of |f|, which reStructuredText would read as a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def _table(*rows: Iterable[str]) -> Iterator[str]:
    """Yield the lines of a table; the first row is its head."""
    for i, row in enumerate(rows):
        cells = [cell.replace("|", "\\|").replace("*", "\\*").replace("\n", " ") for cell in row]
        yield f"| {' | '.join(cells)} |"
        if i == 0:
            yield "|---" * len(cells) + "|"
    yield ""


def _output(words: list[str]) -> str:
    """Return the output of a command.  Raises `RuntimeError` if the command fails."""
    said = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    # Discard stderr, where slow commands report their progress.
    with redirect_stdout(said), redirect_stderr(io.StringIO()) as errors:
        if main(words):
            raise RuntimeError(f"hess-explorer {shlex.join(words)}: {errors.getvalue()}")
    said.flush()
    return said.buffer.getvalue().decode().strip()


def _parameters(of: Iterable[Parameter]) -> Iterator[str]:
    head = ("parameter", "symbol", "meaning", "unit", "bounds", "default")
    rows = ((f"`{p.name}`", p.symbol, p.doc or p.label, p.unit, p.range, plain(p.default)) for p in of)
    yield from _table(head, *rows)


def _computations() -> Iterator[str]:
    """Yield the lines of the page of all computations: each once, and their systems."""
    every: dict[str, list[Computation]] = {}
    for one in catalogue().values():
        every.setdefault(one.name, []).append(one)
    for name, of in every.items():
        # Document each computation by the example of the Suslov problem, if it has one.
        one = next((one for one in of if one.system.startswith("suslov")), of[0])
        system = motions().get(one.system)
        own = [p for p in one.parameters if system is None or p not in (*system.parameters, *system.point)]
        words = f"{one.key} {command_of(one).example}".strip()
        yield f"({name})=\n## {one.title}\n\n{inspect.cleandoc(one.doc)}\n"
        python = f"{{py:func}}`{one.function.__name__} <hess_mechanics.{one.function.__name__}>`"
        yield f"- Python: {python}; command: `hess-explorer {name}{' SYSTEM' if system else ''}`"
        if system is not None:
            yield f"- Systems: {', '.join(f'[{each.system}](#system-{each.system})' for each in of)}"
        elif one.source:
            yield f"- Source: {one.source}"
        yield f"- Accuracy: [{one.kind}](#levels)\n"
        yield from _parameters(own) if own else ()
        yield from (f"`{choice.name}`: {choice.doc} {', '.join(choice.names)}.\n" for choice in one.choices)
        numbers = ((f"`{key}`", n.symbol, n.title, n.unit) for key, n in one.numbers.items())
        yield from _table(("number", "symbol", "meaning", "unit"), *numbers)
        yield f"```console\n$ hess-explorer {words}\n{_output(shlex.split(words))}\n```\n"
    yield "## Systems\n"
    for system in motions().values():
        yield f"(system-{system.name})=\n### {system.name}\n\n{system.title}. Source: {system.source or 'none'}.\n"
        yield from _parameters((*system.parameters, *system.point))
    yield "(levels)=\n## What a level promises\n"
    yield from _table(*levels_table())


def _fill(app: object, page: str, source: list[str]) -> None:
    """Write the page of all computations."""
    if page == "api/computations":
        source[0] += "\n".join(_computations())


def setup(app: Sphinx) -> None:
    """Connect the handlers of this file to the events of Sphinx."""
    app.connect("source-read", _fill)
    app.connect("env-get-outdated", lambda *_: ["api/computations"])
    app.connect("autodoc-process-docstring", _escape_bars)
