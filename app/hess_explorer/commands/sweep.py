"""`hess-explorer sweep`: a quantity over one to three parameters, on one core or many, stopped and gone on with."""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import CommandError
from .arguments import integer, number, shown
from .output import add_options, computing, show, write

if TYPE_CHECKING:
    import xarray as xr

    from hess_explorer.sweep import Quantity

__all__ = ["add"]

_MOST_ROWS = 1_000_000
_MOST_VALUES = 10_000


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "sweep", help="a quantity over one to three parameters",
        description="A quantity (--list names them) for every combination of the values of one to three of its "
                    "parameters.  status: how each cell ended; cells without a number have null, in CSV an empty "
                    "field.  With --store every finished part is kept in that folder, and the same command goes on "
                    "where it was ended; the table is then printed with --format.  Ctrl-C ends it, what is done is "
                    "kept.  Needs the extra: pip install 'hess-explorer[sweep]'.",
        epilog="Example: hess-explorer sweep rotation-number --over h=-0.9:2:30 --over f=0:1:20 --set a=0.5 "
               "--format csv")
    parser.add_argument("quantity", nargs="?", metavar="QUANTITY", help="what is computed, see --list")
    parser.add_argument("--list", action="store_true", help="name all quantities; with one, its parameters")
    parser.add_argument("--over", action="append", type=_axis, default=[], metavar="NAME=VALUES",
                        help="sweep this parameter over lo:hi:n, or a list 1,2,3; up to three times")
    parser.add_argument("--set", action="append", type=_setting, default=[], metavar="NAME=NUMBER",
                        help="a parameter that stays, if not the default")
    parser.add_argument("--store", type=Path, metavar="FOLDER", help="keep what is done here (Zarr), and go on with it")
    parser.add_argument("--read", type=Path, metavar="PLACE",
                        help="compute nothing: write the table of this store, or of a chart that the page has saved")
    parser.add_argument("--workers", type=_workers, metavar="WHO",
                        help="all: a process for each core; a number of processes; or the address of a Dask scheduler, "
                             "tcp://host:8786 (default: one thread)")
    parser.add_argument("--most-cells", type=integer(1, 9_999_999_999), metavar="N",
                        help="how many numbers are allowed (default 10000000)")
    add_options(parser)
    parser.set_defaults(run=_run, format=None)


def _split(text: str) -> tuple[str, str]:
    name, sign, value = text.partition("=")
    if not (name and sign and value):
        raise argparse.ArgumentTypeError(f"{shown(text)} is not a parameter; write it like h=1.5")
    return name, value


def _axis(text: str) -> tuple[str, tuple[float, float, int] | list[float]]:
    name, values = _split(text)
    if ":" not in values:
        parts = values.split(",")
        if len(parts) > _MOST_VALUES:
            raise argparse.ArgumentTypeError(f"{shown(text)} has {len(parts)} numbers; at most {_MOST_VALUES} are "
                                             "allowed in a list, use lo:hi:n")
        return name, [number(part) for part in parts]
    ends = values.split(":")
    if len(ends) != 3:
        raise argparse.ArgumentTypeError(f"{shown(text)} is not a range; write it like h=0:2:30")
    return name, (number(ends[0]), number(ends[1]), integer(2, 9_999_999_999)(ends[2]))


def _setting(text: str) -> tuple[str, float]:
    name, value = _split(text)
    return name, number(value)


def _workers(text: str) -> str | int:
    if text == "all" or "://" in text:
        return text
    return integer(1, 10_000)(text)


def _once(pairs: list[tuple[str, Any]], option: str) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise CommandError(f"{option} names a parameter twice: name each once.")
    return found


def _run(options: argparse.Namespace) -> None:
    # A sweep shows its own progress.
    with computing(told=True):
        if options.list:
            show(_listed(options.quantity).encode())
            return
        if options.read is not None:
            from hess_explorer.sweep import read

            if options.quantity or options.over or options.set or options.store:
                raise CommandError("--read computes nothing: leave the other options away, but for --format and --out.")
            found = read(options.read)
        else:
            found = _swept(options)
    table = options.store is None or options.format is not None or options.out is not None
    options.format = options.format or "json"
    _write(options, found, table)


def _swept(options: argparse.Namespace) -> xr.Dataset:
    from hess_explorer.sweep import Interrupted, sweep
    from hess_explorer.sweep.grid import MAX_NUMBERS
    from hess_explorer.sweep.quantities import quantity

    if options.quantity is None:
        raise CommandError("A sweep needs a quantity: hess-explorer sweep --list names them.")
    over, fixed = _once(options.over, "--over"), _once(options.set, "--set")
    what = quantity(options.quantity)
    for name in fixed:
        # Before they become keywords of `sweep`, which has others too.
        what.parameter(name)
    rows = math.prod(values[2] if isinstance(values, tuple) else len(values) for values in over.values())
    if options.store is None and rows > _MOST_ROWS:
        raise CommandError(f"These are {rows} cells, and a table has at most {_MOST_ROWS} rows: give a folder for "
                           "them, --store FOLDER.")
    try:
        return sweep(options.quantity, over, level=options.accuracy, store=options.store, workers=options.workers,
                     progress=True, most_cells=options.most_cells or MAX_NUMBERS, **fixed)
    except Interrupted as stopped:
        # In a store it is kept already.
        if options.store is None:
            options.format = options.format or "json"
            _write(options, stopped.dataset, True)
        raise


def _listed(name: str | None) -> str:
    from hess_explorer.sweep.quantities import QUANTITIES, quantity

    if name is None:
        return "".join(f"{one.name}\n    {one.symbol}: {one.title}\n" for one in QUANTITIES.values())
    one = quantity(name)
    rows = (f"    {each.name}{'' if each.default is None else f' = {each.default:g}'}: {each.doc} "
            f"({each.low:g} … {each.high:g})\n" for each in one.parameters)
    return f"{one.name}\n    {one.symbol}: {one.title}, {one.units}\n    {one.doc}\n\n{''.join(rows)}"


def _write(options: argparse.Namespace, found: xr.Dataset, table: bool) -> None:
    """The table of a sweep, or what is said of it."""
    import numpy as np

    from hess_explorer.sweep import Outcome
    from hess_explorer.sweep.quantities import quantity

    what = quantity(found.attrs["quantity"])
    status = found.status.values
    counts = {Outcome(code).words: int(count) for code, count in zip(*np.unique(status, return_counts=True),
                                                                     strict=True)}
    facts = {"quantity": what.name, "title": what.title, "units": what.units,
             "parameters": json.loads(found.attrs["parameters"]), "level": found.attrs["level"],
             "version": found.attrs["version"], "cells": list(status.shape), "status_counts": counts,
             **{name: found.attrs[name] for name in ("link", "largest_error") if name in found.attrs},
             **({} if options.store is None else {"store": str(options.store)})}
    series = _series(what, found) if table else {}
    write(options, series, tuple(series), facts, notes=())


def _series(what: Quantity, found: xr.Dataset) -> dict[str, list[Any]]:
    import numpy as np

    from hess_explorer.sweep import Outcome

    status = found.status.values
    if status.size > _MOST_ROWS:
        raise CommandError(f"A table of {status.size} rows is too long; at most {_MOST_ROWS} are written: open the "
                           "store with hess_explorer.sweep.read.")
    axes = np.meshgrid(*(found[name].values for name in found.status.dims), indexing="ij")
    series: dict[str, list[Any]] = {str(name): axis.ravel().tolist()
                                    for name, axis in zip(found.status.dims, axes, strict=True)}
    values = found[what.variable].values
    columns = {what.variable: values}
    if what.parts:
        # A chart has one of them.
        columns = {f"{what.variable}_{part}": values[..., i] for i, part in enumerate(found.number.values.tolist())}
    if "error" in found:
        columns["error"] = found["error"].values
    for name, column in columns.items():
        series[name] = [value if math.isfinite(value) else None for value in column.ravel().tolist()]
    series["status"] = [Outcome(code).words for code in status.ravel().tolist()]
    return series
