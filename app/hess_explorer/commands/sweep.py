"""`hess-explorer sweep`: numbers of a computation over one to three parameters, on one core or many, resumable."""

from __future__ import annotations

import inspect
import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from . import CommandError
from .arguments import assigned, defined, ends, integer, listed, number
from .command import OUTPUT, Command, Options, option
from .output import computing, write

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["COMMAND"]


def _values(text: str) -> tuple[float, float, int] | list[float]:
    return ends(text) if ":" in text else listed(text)


def _workers(text: str) -> str | int:
    return text if text == "all" else integer(1, 10_000)(text)


def _run(options: Options) -> None:
    # A sweep prints its own progress.
    with computing(own_progress=True):
        from hess_explorer.sweep import Outcome, read

        if options.read is None:
            found = _swept(options)
        elif options.computation or options.over or options.set or options.store:
            raise CommandError("--read takes only --format and --out: remove the other options.")
        else:
            found = read(options.read)
    _write(options, found, table=options.store is None or options.format or options.out)
    failed = int(np.count_nonzero(found.status == Outcome.FAILED))
    if failed and options.read is None:
        texts = json.loads(found.attrs.get("failures", "{}"))
        first = next((f"; {cell}: {why}" for cell, why in texts.items()), "")
        words = "cell has" if failed == 1 else "cells have"
        raise CommandError(f"{failed} {words} failed of {found.status.size}{first}.", status=1)


def _swept(options: Options) -> xr.Dataset:
    from hess_explorer.sweep import Interrupted, sweep

    name, fixed = " ".join(options.computation), dict(options.set)
    if not name:
        raise CommandError("Name a computation after sweep, such as lyapunov suslov: hess-explorer --help lists all.")
    for flag, pairs in (("--over", options.over), ("--set", options.set)):
        if len(dict(pairs)) < len(pairs):
            raise CommandError(f"{flag} names a parameter twice: name each only once.")
    if wrong := fixed.keys() & inspect.signature(sweep).parameters:
        raise CommandError(f"{name} has no parameter {min(wrong)!r} that --set can give: rename it.")
    try:
        return sweep(
            defined(name, "function", callable) if ":" in name else name,
            dict(options.over),
            numbers=options.numbers and options.numbers.split(","),
            accuracy=options.accuracy,
            store=options.store,
            workers=options.workers,
            scheduler=options.scheduler,
            progress=True,
            **fixed,
        )
    except Interrupted as stopped:
        # A store already contains the results.
        if options.store is None:
            _write(options, stopped.dataset, table=True)
        raise


def _write(options: Options, found: xr.Dataset, table: bool) -> None:
    """Write the table of a sweep, or only its facts."""
    from hess_explorer.sweep import Outcome

    counts = zip(*np.unique(found.status.values, return_counts=True), strict=True)
    facts = {
        **{name: found.attrs[name] for name in ("computation", "title", "level", "version")},
        **{name: json.loads(found.attrs[name]) for name in ("parameters", "failures") if name in found.attrs},
        "units": {name: one.attrs["units"] for name, one in found.data_vars.items() if name != "status"},
        "cells": list(found.status.shape),
        "status_counts": {Outcome(code).words: int(count) for code, count in counts},
        **({} if options.store is None else {"store": str(options.store)}),
    }
    options.format = options.format or "json"
    shown = found if table else found.isel({one: slice(0) for one in found.status.dims})
    cells = shown.to_dataframe(dim_order=[*found.status.dims]).reset_index()
    cells["status"] = [Outcome(code).words for code in cells["status"]]
    write(options, cells if table else cells[[]], facts, lambda: found)


COMMAND = Command(
    "Compute numbers of a computation for every combination of the values of one to three of its parameters, at most "
    "ten million cells; hess-explorer COMPUTATION --help lists its numbers and parameters.  Column status tells how "
    "each cell ended; a cell without a number is null, or empty in CSV.  With --store, finished parts are saved in a "
    "folder, and the same command resumes an interrupted sweep; the table is printed only with --format.  Ctrl-C stops "
    "the sweep and keeps the finished parts.  The exit status is 1 if cells have failed; the texts of their exceptions "
    "are kept as failures.  Requires: pip install 'hess-explorer[sweep]'.",
    (
        option(
            "computation",
            "computation and system, such as lyapunov suslov; or a function of yours, FILE.py:NAME",
            nargs="*",
            metavar="COMPUTATION",
        ),
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
            type=assigned(number, "h=1.5"),
            default=[],
            metavar="NAME=NUMBER",
        ),
        option(
            "--store", "folder that saves the results (Zarr); an existing store is resumed", type=Path, metavar="FOLDER"
        ),
        option(
            "--read",
            "write the table of this store without computing, with the number of cells by status",
            type=Path,
            metavar="FOLDER",
        ),
        option(
            "--workers",
            "number of processes on this machine, all for one per core (default: one thread)",
            type=_workers,
            metavar="N",
        ),
        option("--scheduler", "address of a Dask scheduler such as tcp://host:8786", metavar="ADDRESS"),
        OUTPUT[0],
        option("--format", OUTPUT[1].settings["help"], choices=OUTPUT[1].settings["choices"]),
        OUTPUT[2],
    ),
    _run,
    "circle-map --numbers rotation-number,trace --over h=-0.9:2:30 --over f=0:1:20 --set a=0.5 --format csv",
)
