"""`hess-explorer sweep`: numbers of a computation over one to three parameters, on one core or many, resumable."""

from __future__ import annotations

import inspect
import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from . import CommandError
from .arguments import assignment_of, user_object
from .command import OUTPUT, Command, Options, option
from .output import long_computation, write

if TYPE_CHECKING:
    import xarray as xr


def _values(text: str) -> tuple[float, float, int] | list[float]:
    """Return the numbers of LOW:HIGH:COUNT or of a list with commas."""
    if ":" not in text:
        return [float(part) for part in text.split(",")]
    low, high, count = text.split(":")
    return float(low), float(high), int(count)


def _workers(text: str) -> str | int:
    return text if text == "all" else int(text)


def _run(options: Options) -> None:
    # A sweep prints its own progress.
    with long_computation(own_progress=True):
        from hess_explorer.sweep import Outcome, read

        if options.computation:
            found = _swept(options)
        elif options.store is None:
            raise CommandError(
                "Name a computation after sweep, such as lyapunov suslov: hess-explorer --help lists all."
            )
        else:
            found = read(options.store)
    _write(options, found)
    failed = int(np.count_nonzero(found.status == Outcome.FAILED))
    if failed and options.computation:
        cell, why = next(iter(json.loads(found.attrs["failures"]).items()))
        raise CommandError(f"{failed} of {found.status.size} cells failed; {cell}: {why}.", status=1)


def _swept(options: Options) -> xr.Dataset:
    from hess_explorer.sweep import Interrupted, sweep

    name, fixed = " ".join(options.computation), dict(options.set)
    if wrong := fixed.keys() & inspect.signature(sweep).parameters:
        raise CommandError(
            f"--set cannot set {min(wrong)!r}, an argument of sweep: use the option of that name if there is one, "
            f"or rename the parameter of {name}."
        )
    try:
        return sweep(
            user_object(name, "function", callable) if ":" in name else name,
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
            _write(options, stopped.dataset)
        raise


def _write(options: Options, results: xr.Dataset) -> None:
    """Write the table of a sweep; as text only its facts if a store has the table."""
    from hess_explorer.sweep import Outcome

    cells = results.to_dataframe(dim_order=[*results.status.dims]).reset_index()
    cells["status"] = cells["status"].map({int(one): one.words for one in Outcome})
    facts = {
        **{name: results.attrs[name] for name in ("computation", "title", "accuracy", "version")},
        **{name: json.loads(results.attrs[name]) for name in ("parameters", "failures")},
        "units": {name: one.attrs["units"] for name, one in results.data_vars.items() if name != "status"},
        "cells": list(results.status.shape),
        "status_counts": cells["status"].value_counts(sort=False).to_dict(),
    }
    table = cells if options.store is None or options.format != "text" else cells[[]]
    write(options, table, facts, lambda: results)


COMMAND = Command(
    "Compute numbers of a computation for every combination of the values of one to three of its parameters, at most "
    "ten million cells; hess-explorer COMPUTATION --help lists its numbers and parameters.  Column status tells how "
    "each cell ended; a cell without a number is null, or empty in CSV.  With --store, finished parts are saved in a "
    "folder, and the same command resumes an interrupted sweep; text then has no table.  Ctrl-C stops "
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
            "parameter and its values, like h=0:2:30 (30 values from 0 to 2) or h=1,2,3; up to three times",
            action="append",
            type=assignment_of(_values),
            default=[],
            metavar="NAME=VALUES",
        ),
        option(
            "--set",
            "value of a fixed parameter that differs from its default",
            action="append",
            type=assignment_of(float),
            default=[],
            metavar="NAME=NUMBER",
        ),
        option(
            "--store",
            "folder that saves the results (Zarr); an existing store is resumed, or read if no computation is named",
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
        *OUTPUT,
    ),
    _run,
    "circle-map --numbers rotation-number,trace --over h=-0.9:2:30 --over f=0:1:20 --set a=0.5 --format csv",
)
