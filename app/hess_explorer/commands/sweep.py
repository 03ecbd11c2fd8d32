"""`hess-explorer sweep`: a quantity over one to three parameters, on one core or many, resumable."""

from __future__ import annotations

import argparse
import inspect
import json
import math
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from . import CommandError
from .arguments import assigned, ends, integer, listed, run_file, shown
from .arguments import number as any_number
from .command import OUTPUT, Command, Options, flag, option, whole
from .output import Answer, computing, show, write

if TYPE_CHECKING:
    import xarray as xr


__all__ = ["COMMAND"]

_MOST_ROWS = 1_000_000
_MOST_VALUES = 10_000


def _values(text: str) -> tuple[float, float, int] | list[float]:
    return ends(text, 9_999_999_999) if ":" in text else listed(text, _MOST_VALUES)


def _workers(text: str) -> str | int:
    if text == "all" or "://" in text:
        return text
    return integer(1, 10_000)(text)


def _part(text: str) -> tuple[int, int]:
    number, slash, parts = text.partition("/")
    if not slash:
        raise argparse.ArgumentTypeError(f"{shown(text)} is not a part; write it like 3/40")
    return integer(1, 10_000)(number), integer(1, 10_000)(parts)


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
            show(_listed(options.quantity).encode())
            return
        if options.read is not None:
            from hess_explorer.sweep import read

            if options.quantity or options.over or options.set or options.store:
                raise CommandError("--read can be combined only with --format and --out: remove the other options.")
            found = read(options.read)
        elif options.status is not None:
            if options.quantity or options.over or options.set or options.store:
                raise CommandError("--status can be combined only with --out: remove the other options.")
            _write_status(options, options.status)
            return
        else:
            found = _swept(options)
            if options.part is not None:
                _write_status(options, options.store)
                _require_no_failures(found)
                return
    table = options.store is None or options.format is not None or options.out is not None
    options.format = options.format or "json"
    _write(options, found, table)
    if options.read is None:
        _require_no_failures(found)


def _require_no_failures(found: xr.Dataset) -> None:
    """Raise `CommandError` if cells have failed."""
    from hess_explorer.sweep import Outcome
    from hess_explorer.sweep.work import named

    failed, failures = np.argwhere(found.status.values == Outcome.FAILED), _failures(found)
    if len(failed):
        axes = {str(name): found[name].values for name in found.status.dims}
        cells = (named({name: axes[name][i] for name, i in zip(axes, at, strict=True)}) for at in failed)
        text = next((f"; {cell}: {failures[cell]}" for cell in cells if cell in failures), "")
        words = "cell has" if len(failed) == 1 else "cells have"
        raise CommandError(f"{len(failed)} {words} failed of {found.status.size}{text}.", status=1)


def _failures(found: xr.Dataset) -> dict[str, str]:
    """Return the texts of the exceptions by cell."""
    return cast("dict[str, str]", json.loads(found.attrs.get("failures", "{}")))


def _swept(options: Options) -> xr.Dataset:
    from hess_explorer.sweep import Interrupted, sweep
    from hess_explorer.sweep.grid import MAX_NUMBERS
    from hess_explorer.sweep.quantities import quantity

    if options.quantity is None:
        raise CommandError("A sweep needs a quantity: run hess-explorer sweep --list to see all of them.")
    over, fixed = _once(options.over, "--over"), _once(options.set, "--set")
    what = _function(options.quantity) if ":" in options.quantity else quantity(options.quantity).name
    for name in fixed:
        # It becomes a keyword argument of `sweep`, which has others.
        if name in inspect.signature(sweep).parameters:
            raise CommandError(f"{options.quantity} has no parameter {name!r} that --set can give: rename it.")
    rows = math.prod(values[2] if isinstance(values, tuple) else len(values) for values in over.values())
    if options.store is None and rows > _MOST_ROWS:
        raise CommandError(
            f"The sweep has {rows} cells, but a table has at most {_MOST_ROWS} rows: use --store FOLDER."
        )
    try:
        return sweep(
            what,
            over,
            level=options.accuracy,
            store=options.store,
            part=options.part,
            workers=options.workers,
            progress=True,
            most_cells=options.most_cells or MAX_NUMBERS,
            **fixed,
        )
    except Interrupted as stopped:
        # A store already contains the results.
        if options.store is None:
            options.format = options.format or "json"
            _write(options, stopped.dataset, True)
        raise


def _listed(name: str | None) -> str:
    from hess_explorer.sweep.quantities import QUANTITIES, quantity

    if name is None:
        return "".join(f"{one.name}\n    {one.symbol}: {one.title}\n" for one in QUANTITIES.values())
    one = quantity(name)
    rows = (
        f"    {each.name}{'' if each.name in one.needed else f' = {each.default:g}'}: {each.doc} "
        f"({each.bounds[0]:g} … {each.bounds[1]:g})\n"
        for each in one.parameters
    )
    return f"{one.name}\n    {one.symbol}: {one.title}, {one.units}\n    {one.doc}\n\n{''.join(rows)}"


def _write_status(options: Options, store: Path) -> None:
    """Write what is missing in a store."""
    from hess_explorer.sweep import store_status

    found = store_status(store)
    options.format = "json"
    # As `sbatch --array` takes it.
    missing = ",".join(map(str, found.missing_parts))
    write(options, Answer({}, {"store": str(store), **asdict(found), "missing_parts": missing}))


def _write(options: Options, found: xr.Dataset, table: bool) -> None:
    """Write the table of a sweep, or only its facts."""
    from hess_explorer.sweep import Outcome

    status = found.status.values
    counts = {
        Outcome(code).words: int(count) for code, count in zip(*np.unique(status, return_counts=True), strict=True)
    }
    facts = {
        "quantity": found.attrs["quantity"],
        "title": found.attrs["title"],
        "units": found[_variables(found)[0]].attrs["units"],
        "parameters": json.loads(found.attrs["parameters"]),
        "level": found.attrs["level"],
        "version": found.attrs["version"],
        "cells": list(status.shape),
        "status_counts": counts,
        **{name: found.attrs[name] for name in ("link", "largest_error") if name in found.attrs},
        **({"failures": failures} if (failures := _failures(found)) else {}),
        **({} if options.store is None else {"store": str(options.store)}),
    }
    series = _series(found) if table else {}
    write(options, Answer(series, facts))


def _variables(found: xr.Dataset) -> list[str]:
    """Return the names of the variables with values."""
    return [str(name) for name in found.data_vars if name not in ("status", "error")]


def _series(found: xr.Dataset) -> dict[str, list[Any]]:
    from hess_explorer.sweep import Outcome

    status = found.status.values
    if status.size > _MOST_ROWS:
        raise CommandError(
            f"The table would have {status.size} rows, but at most {_MOST_ROWS} are allowed: open the store with "
            "hess_explorer.sweep.read."
        )
    axes = np.meshgrid(*(found[name].values for name in found.status.dims), indexing="ij")
    series: dict[str, list[Any]] = {
        str(name): axis.ravel().tolist() for name, axis in zip(found.status.dims, axes, strict=True)
    }
    columns: dict[str, Any] = {}
    for name in _variables(found):
        values = found[name].values
        if values.ndim > status.ndim:
            # A chart contains only one part.
            columns |= {f"{name}_{part}": values[..., i] for i, part in enumerate(found.number.values.tolist())}
        else:
            columns[name] = values
    if "error" in found:
        columns["error"] = found["error"].values
    for name, column in columns.items():
        series[name] = [value if math.isfinite(value) else None for value in column.ravel().tolist()]
    series["status"] = [Outcome(code).words for code in status.ravel().tolist()]
    return series


COMMAND = Command(
    "Compute a quantity (see --list) for every combination of the values of one to three of its parameters.  Column "
    "status tells how each cell ended; a cell without a number is null, or empty in CSV.  With --store, finished parts "
    "are saved in a folder, and the same command resumes an interrupted sweep; the table is printed only with "
    "--format.  Ctrl-C stops the sweep and keeps the finished parts.  The exit status is 1 if cells have "
    "failed; the texts of their exceptions are kept as failures.  Requires: pip install 'hess-explorer[sweep]'.",
    (
        option(
            "quantity",
            "quantity to compute, see --list; or a function of yours, FILE.py:NAME",
            nargs="?",
            metavar="QUANTITY",
        ),
        flag("--list", "list all quantities, or the parameters of the given quantity"),
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
        option(
            "--part",
            "compute only part k of n, counted from 1: the jobs of an array share the store",
            type=_part,
            metavar="K/N",
        ),
        option("--status", "tell what is missing in this store, without computing", type=Path, metavar="FOLDER"),
        option(
            "--read",
            "write the table of this store, or of a chart saved by the page, without computing",
            type=Path,
            metavar="PLACE",
        ),
        option(
            "--workers",
            "number of processes, all for one per core, or the address of a Dask scheduler such as tcp://host:8786 "
            "(default: one thread)",
            type=_workers,
            metavar="WHO",
        ),
        whole("--most-cells", 1, 9_999_999_999, "maximum number of values (default 10000000)"),
        OUTPUT[0],
        option("--format", OUTPUT[1].settings["help"], choices=("json", "csv")),
        OUTPUT[2],
    ),
    _run,
    "rotation-number --over h=-0.9:2:30 --over f=0:1:20 --set a=0.5 --format csv",
)
