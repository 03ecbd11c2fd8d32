"""`hess-explorer sweep`: numbers of a computation over one to three parameters, on one core or many, resumable."""

from __future__ import annotations

import inspect
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from . import CommandError
from .arguments import assigned, ends, integer, listed, run_file, shown
from .arguments import number as any_number
from .command import OUTPUT, Command, Options, flag, option, whole
from .output import computing, show, write

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["COMMAND"]

_MOST_ROWS = 1_000_000
_MOST_VALUES = 10_000


def _values(text: str) -> tuple[float, float, int] | list[float]:
    return ends(text, 9_999_999_999) if ":" in text else listed(text, _MOST_VALUES)


def _workers(text: str) -> str | int:
    return text if text == "all" else integer(1, 10_000)(text)


def _function(text: str) -> Callable[..., object]:
    """Return the function FILE.py:NAME."""
    path, _, name = text.rpartition(":")
    found = run_file(path).get(name)
    if not callable(found):
        raise CommandError(f"{shown(path)} defines no function {shown(name)}: write it like mine.py:energy.")
    return cast("Callable[..., object]", found)


def _once(pairs: list[tuple[str, Any]], option: str) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise CommandError(f"{option} names a parameter twice: name each only once.")
    return found


def _run(options: Options) -> None:
    # A sweep prints its own progress.
    with computing(own_progress=True):
        if options.list:
            show(_listed(" ".join(options.computation)).encode())
            return
        stored = options.read or options.status
        if stored is None:
            found = _swept(options)
        elif options.computation or options.over or options.set or options.store:
            raise CommandError("--read and --status take only --format and --out: remove the other options.")
        else:
            from hess_explorer.sweep import read

            found = read(stored)
    _write(options, found, options.status is None and (options.store is None or options.format or options.out))
    if stored is None:
        _require_no_failures(found)


def _require_no_failures(found: xr.Dataset) -> None:
    """Raise `CommandError` if cells have failed."""
    from hess_explorer.sweep import Outcome

    failed = int(np.count_nonzero(found.status == Outcome.FAILED))
    if failed:
        text = next((f"; {cell}: {why}" for cell, why in _failures(found).items()), "")
        words = "cell has" if failed == 1 else "cells have"
        raise CommandError(f"{failed} {words} failed of {found.status.size}{text}.", status=1)


def _failures(found: xr.Dataset) -> dict[str, str]:
    """Return the texts of the exceptions by cell."""
    return cast("dict[str, str]", json.loads(found.attrs.get("failures", "{}")))


def _swept(options: Options) -> xr.Dataset:
    from hess_explorer.sweep import Interrupted, sweep

    name = " ".join(options.computation)
    if not name:
        raise CommandError("A sweep needs a computation: run hess-explorer sweep --list to see all of them.")
    over, fixed = _once(options.over, "--over"), _once(options.set, "--set")
    for one in fixed:
        # It becomes a keyword argument of `sweep`, which has others.
        if one in inspect.signature(sweep).parameters:
            raise CommandError(f"{name} has no parameter {one!r} that --set can give: rename it.")
    rows = math.prod(values[2] if isinstance(values, tuple) else len(values) for values in over.values())
    if options.store is None and rows > _MOST_ROWS:
        raise CommandError(
            f"The sweep has {rows} cells, but a table has at most {_MOST_ROWS} rows: use --store FOLDER."
        )
    try:
        return sweep(
            _function(name) if ":" in name else name,
            over,
            numbers=options.numbers and options.numbers.split(","),
            level=options.accuracy,
            store=options.store,
            workers=options.workers,
            scheduler=options.scheduler,
            progress=True,
            **({} if options.most_cells is None else {"most_cells": options.most_cells}),
            **fixed,
        )
    except Interrupted as stopped:
        # A store already contains the results.
        if options.store is None:
            _write(options, stopped.dataset, True)
        raise


def _listed(name: str) -> str:
    from hess_mechanics.catalogue import catalogue, find

    if not name:
        return "".join(f"{one.key}\n    {one.title}\n" for one in catalogue().values())
    what = find(name)
    numbers = (f"    {key}: {one.symbol}, {one.title} ({one.unit})\n" for key, one in what.numbers.items())
    rows = (
        f"    {one.name} = {one.default:g}: {one.doc} ({one.bounds[0]:g} … {one.bounds[1]:g})\n"
        for one in what.parameters
    )
    return f"{what.key}\n    {what.doc}\n\nNumbers\n{''.join(numbers)}\nParameters\n{''.join(rows)}"


def _write(options: Options, found: xr.Dataset, table: bool) -> None:
    """Write the table of a sweep, or only its facts."""
    from hess_explorer.sweep import Outcome

    counts = zip(*np.unique(found.status.values, return_counts=True), strict=True)
    facts = {
        **{name: found.attrs[name] for name in ("computation", "title", "level", "version")},
        "parameters": json.loads(found.attrs["parameters"]),
        "units": {name: one.attrs["units"] for name, one in found.data_vars.items() if name != "status"},
        "cells": list(found.status.shape),
        "status_counts": {Outcome(code).words: int(count) for code, count in counts},
        **({"failures": failures} if (failures := _failures(found)) else {}),
        **({} if options.store is None else {"store": str(options.store)}),
    }
    options.format = options.format or "json"
    cells = _cells(found if table else found.isel({one: slice(0) for one in found.status.dims}))
    write(options, cells if table else cells[[]], facts, lambda: found)


def _cells(found: xr.Dataset) -> Any:
    """Return a DataFrame of all cells."""
    from hess_explorer.sweep import Outcome

    if found.status.size > _MOST_ROWS:
        raise CommandError(
            f"The table would have {found.status.size} rows, but at most {_MOST_ROWS} are allowed: open the store with "
            "hess_explorer.sweep.read."
        )
    cells = found.to_dataframe(dim_order=[*found.status.dims]).reset_index()
    cells["status"] = [Outcome(code).words for code in cells["status"]]
    return cells


COMMAND = Command(
    "Compute numbers of a computation (see --list) for every combination of the values of one to three of its "
    "parameters.  Column status tells how each cell ended; a cell without a number is null, or empty in CSV.  With "
    "--store, finished parts are saved in a folder, and the same command resumes an interrupted sweep; the table is "
    "printed only with --format.  Ctrl-C stops the sweep and keeps the finished parts.  The exit status is 1 if cells "
    "have failed; the texts of their exceptions are kept as failures.  Requires: pip install 'hess-explorer[sweep]'.",
    (
        option(
            "computation",
            "computation and system, see --list; or a function of yours, FILE.py:NAME",
            nargs="*",
            metavar="COMPUTATION",
        ),
        flag("--list", "list all computations, or the numbers and parameters of the given one"),
        option("--numbers", "numbers to compute, separated by commas (default: the first)", metavar="NAMES"),
        option(
            "--over",
            "parameter and its values: lo:hi:n or a list 1,2,3; up to three times",
            action="append",
            type=assigned(_values, "h=0:2:30"),
            default=[],
            metavar="NAME=VALUES",
        ),
        option(
            "--set",
            "value of a fixed parameter that differs from its default",
            action="append",
            type=assigned(any_number, "h=1.5"),
            default=[],
            metavar="NAME=NUMBER",
        ),
        option(
            "--store", "folder that saves the results (Zarr); an existing store is resumed", type=Path, metavar="FOLDER"
        ),
        option("--status", "tell how many cells of this store are missing", type=Path, metavar="FOLDER"),
        option("--read", "write the table of this store, without computing", type=Path, metavar="FOLDER"),
        option(
            "--workers",
            "number of processes on this machine, all for one per core (default: one thread)",
            type=_workers,
            metavar="N",
        ),
        option("--scheduler", "address of a Dask scheduler such as tcp://host:8786", metavar="ADDRESS"),
        whole("--most-cells", 1, 9_999_999_999, "maximum number of cells (default 10000000)"),
        OUTPUT[0],
        option("--format", OUTPUT[1].settings["help"], choices=OUTPUT[1].settings["choices"]),
        OUTPUT[2],
    ),
    _run,
    "circle-map --numbers rotation-number,trace --over h=-0.9:2:30 --over f=0:1:20 --set a=0.5 --format csv",
)
