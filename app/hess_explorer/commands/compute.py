"""`hess-explorer COMPUTATION [SYSTEM]`: the computations of the catalogue."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from difflib import get_close_matches
from functools import partial
from typing import Any

from hess_mechanics.catalogue import Computation, Motions, NoValue, catalogue, computations_of, motions
from hess_mechanics.dynamics.system import System
from hess_mechanics.parameters import Parameter, plain

from . import COMMANDS, CommandError
from .arguments import user_object
from .command import OUTPUT, Command, Option, Options, option
from .output import long_computation, write


def titles(group: str) -> dict[str, str]:
    """Return the titles of the computations under a heading, by name."""
    return {one.name: one.title for one in catalogue().values() if one.group == group}


def parse(name: str, rest: list[str]) -> Options:
    """Parse the arguments of a computation.

    Parameters
    ----------
    name : str
        Name of the computation.
    rest : list of str
        The arguments after its name.

    Raises
    ------
    CommandError
        If there is no such computation or system, the system is missing, or an option is invalid.
    """
    of = {one.system: one for one in catalogue().values() if one.name == name}
    if not of:
        raise _unknown("command", name, [*COMMANDS, *titles("compute"), *titles("prove")])
    prog = f"hess-explorer {name}"
    if "" in of:
        return command_of(of[""]).parse(prog, rest)
    if rest and not rest[0].startswith("-"):
        what = _own(name, rest[0]) if ":" in rest[0] else of.get(rest[0])
        if what is None:
            raise _unknown("system", rest[0], [*of])
        return command_of(what).parse(f"{prog} {rest[0]}", rest[1:])
    if not {"-h", "--help"} & {*rest}:
        raise CommandError(f"Add a system after {name}: {', '.join(of)}.")
    overview = Command(f"{next(iter(of.values())).title}.  SYSTEM --help shows the options.")
    own = {"FILE.py:NAME": "a System that a Python file of yours defines"}
    overview.list_words("systems", {system: motions()[system].title for system in of} | own)
    return overview.parse(f"{prog} SYSTEM", ["--help"])


def _unknown(kind: str, name: str, names: list[str]) -> CommandError:
    close = get_close_matches(name, names, 3)
    hint = f"did you mean {' or '.join(close)}?" if close else f"choose from {', '.join(names)}."
    return CommandError(f"There is no {kind} {name[:60]!r}: {hint}")


def _own(name: str, text: str) -> Computation:
    """Return the computation of the system FILE.py:NAME."""
    system = user_object(text, "System", lambda found: isinstance(found, (System, Motions)))
    of = [one for one in computations_of(system).values() if one.name == name]
    if not of:
        raise CommandError(f"{name} needs a section or another system than {system.name}: choose another computation.")
    return of[0]


def command_of(what: Computation) -> Command:
    """Return the command of a computation, with an option for each parameter."""
    numbers = (f"  {name:<18} {one.title} ({one.symbol}{_unit(one.unit)})" for name, one in what.numbers.items())
    description = [
        f"{what.title}.",
        inspect.cleandoc(what.doc),
        *([f"Source: {what.source}."] if what.source else []),
        "\n".join(["Numbers of the result:", *numbers]),
    ]
    words = [
        option(_typed(one.name), one.doc, choices=one.names, default=one.default, dest=_typed(one.name))
        for one in what.choices
    ]
    example = " ".join(f"{_typed(name)} {str(value).removesuffix('.0')}" for name, value in what.example.items())
    options = (*map(_option, what.parameters), *words, *OUTPUT)
    return Command("\n\n".join(description), options, partial(_run, what), example)


def _typed(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _unit(unit: str) -> str:
    return "" if unit == "1" else f", {unit}"


def _option(of: Parameter) -> Option:
    bounds = f"{of.symbol}{_unit(of.unit)}, {of.range}, default {plain(of.default)}"
    help = f"{of.doc or of.label} ({bounds})".replace("%", "%%")
    name = _typed(of.name)
    return option(name, help, of.group, type=float, default=of.default, metavar=of.name.upper(), dest=name)


def _run(what: Computation, options: Options) -> None:
    with long_computation():
        given = what.values({name: vars(options)[_typed(name)] for name in what.values()})
        result = what.compute(given, options.accuracy)
        notes = _notes_on_body(given)
        numbers: dict[str, float | None] = {}
        errors = {}
        for name, of in what.numbers.items():
            numbers[name] = None
            try:
                numbers[name] = of.read(result)
                # NaN stands for no estimate.
                if math.isfinite(error := of.error(result)):
                    errors[name] = error
            except (NoValue, ArithmeticError) as missing:
                notes.append(f"{name}: {missing}")
        known = result.labels()
        facts = {
            "computation": what.key,
            "accuracy": options.accuracy,
            "parameters": given,
            "numbers": numbers,
            "errors": errors,
            "facts": known.facts,
            "units": known.units,
        }
        write(options, result.to_pandas(), facts, result.to_xarray, notes)


def _notes_on_body(values: Mapping[str, Any]) -> list[str]:
    """Return a list with a note if no rigid body has these moments of inertia, otherwise an empty list."""
    from hess_mechanics import HeavyBody, check_body

    checks: dict[tuple[str, ...], Callable[..., Any]] = {
        ("I11", "I22", "I13", "I23"): check_body,
        ("a1", "a2", "a3"): lambda *moments: HeavyBody(moments, (0.0, 0.0, 0.0), 0.0).check,
    }
    found = [of(*map(values.get, names)) for names, of in checks.items() if {*names} <= values.keys()]
    return [one.sentence for one in found if not one.is_body]
