"""`hess-explorer serve`: serve the explorer and open it in the browser."""

from __future__ import annotations

import argparse
import gc
import json
import math
import os
import re
import signal
import socket
import sys
import webbrowser
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import CommandError
from .arguments import run_file
from .command import Command, Options, integer_option, option

if TYPE_CHECKING:
    import xarray as xr

    from hess_explorer.lessons.lesson import Lesson

_MOST_CELLS = 256
"""Largest number of cells of a stored sweep along each side that the page shows."""


def _host(text: str) -> str:
    if not re.fullmatch(r"(https?://)?(\*\.)?([A-Za-z0-9._-]{1,253}|\[[0-9A-Fa-f:.]{2,45}\])(:\d{1,5})?", text):
        raise argparse.ArgumentTypeError(f"{text!r} is not a host; write it like example.org:8080")
    return text


def _run(options: Options) -> None:
    for path in options.scenes:
        from hess_explorer.scenes import add

        add(run_file(path).get("SCENE"), f"SCENE of {path}")
    lessons, state = _lessons(options.lessons), ""
    if options.chart is not None:
        from hess_explorer.sweep import read

        state = f"/?{_chart_link(read(options.chart))}&large=chart"
    _require_free(options.address, options.port)
    if options.workers > 1 and not hasattr(os, "fork"):
        raise CommandError("--workers needs an operating system with fork: run the command without it.")
    # A browser cannot open a wildcard address.
    host = "localhost" if options.address in ("127.0.0.1", "0.0.0.0", "::") else options.address
    url = f"http://{f'[{host}]' if ':' in host else host}:{options.port}{state}"
    show = options.browser and _has_browser()
    print(_first_words(), flush=True)

    def ready() -> None:
        print(f"Hess Explorer is running at {url} (press Ctrl-C to stop).", flush=True)

    # Handle SIGTERM like Ctrl-C from the start, for process managers.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    # Imported objects live as long as the process, so garbage collection would only delay the start by 0.25 s.
    # `hess_explorer.server.warm` enables it again.
    gc.disable()
    with suppress(KeyboardInterrupt), _second_compiler():
        from hess_explorer.server.serving import serve

        embedders = ["*"] if options.embedders is None else [one for one in options.embedders if one != "none"]
        serve(
            port=options.port,
            address=options.address,
            show=show,
            origins=options.origins,
            ready=ready,
            lessons=lessons,
            embedders=embedders,
            workers=options.workers,
            sessions=options.sessions,
        )


def _chart_link(results: xr.Dataset) -> str:
    """Store a sweep over two evenly spaced parameters for the chart of a scene, and return the query of its state.

    Larger sweeps are thinned to at most 256 cells along each side.  Raises `InvalidParameter` if the axes are not
    of this kind, or no scene has such a chart.
    """
    import numpy as np

    from hess_explorer.protocol.specs import NumberSpec, encode
    from hess_explorer.scenes import scenes
    from hess_explorer.scenes.framework.chart_cells import STORED
    from hess_mechanics.errors import InvalidParameter

    names = tuple(map(str, results.status.dims))
    results = results.isel({name: slice(None, None, -(-results.sizes[name] // _MOST_CELLS)) for name in names})
    sides = [results[name].values for name in names]
    steps = [np.diff(side) for side in sides]
    if len(names) != 2 or not all(one.size and one[0] > 0.0 and np.allclose(one, one[0], atol=0.0) for one in steps):
        raise InvalidParameter(
            f"A chart is over two parameters LOW:HIGH:COUNT, LOW < HIGH, unlike this sweep over {', '.join(names)}: "
            "open it in Python with hess_explorer.sweep.read."
        )
    ends = ((side[0] - one[0] / 2.0, side[-1] + one[0] / 2.0) for side, one in zip(sides, steps, strict=True))
    window: Any = tuple(zip(*ends, strict=True))
    cells = results.transpose(*reversed(names))
    fixed = json.loads(results.attrs["parameters"])
    for scene in scenes().values():
        symbols = {one.name: one.symbol for one in scene.specs if isinstance(one, NumberSpec)}
        numbers = {} if scene.chart_set is None or not {*names} <= {*symbols} else scene.chart_set.numbers
        for chart, (source, name) in numbers.items():
            variable = name.replace("-", "_")
            if source.key != results.attrs["computation"] or variable not in results:
                continue
            x, y = names
            chosen = {"chart": chart, "chart_x": symbols[x], "chart_y": symbols[y]}
            own = {name: value for name, value in fixed.items() if name in symbols}
            values, _ = scene.admit({**scene.defaults(), **own, **chosen, "accuracy": results.attrs["accuracy"]})
            key = scene.of(values).chart_part.key
            corners = ({**fixed, **{name: float(results[name][i]) for name in names}} for i in (0, -1))
            if all(_same(key.arguments(one[x], one[y]), one) for one in corners):
                errors = cells.get(f"{variable}_error", np.full(cells.status.shape, np.nan))
                STORED[key] = np.stack([cells[variable], errors, cells.status], axis=1), window
                return encode(scene.name, values)
    raise InvalidParameter(
        f"No scene shows {results.attrs['computation']} over {' and '.join(names)} with these parameters: open the "
        "sweep in Python with hess_explorer.sweep.read."
    )


def _same(arguments: Mapping[str, Any], cell: Mapping[str, float]) -> bool:
    return all(math.isclose(arguments[name], value, rel_tol=1e-9, abs_tol=1e-12) for name, value in cell.items())


def _lessons(paths: Sequence[Path]) -> tuple[Lesson, ...]:
    """Return the lessons in files and folders; print mistakes.  Raises `CommandError` if no file has a valid lesson."""
    if not paths:
        return ()
    from hess_explorer.lessons.collection import read_paths

    lessons, mistakes = read_paths(paths)
    if not lessons:
        raise CommandError("\n".join(map(str, mistakes)))
    for mistake in mistakes:
        print(f"{mistake}  The lesson is omitted.", file=sys.stderr)
    return lessons


def _first_words() -> str:
    """Return the message printed at the start, with the time that the start will take."""
    from hess_explorer.server.compiled import KEEPS_KERNELS, all_compiled

    if not KEEPS_KERNELS:
        return (
            "Compiling, ready in about 20 s.  Every start compiles again, because no cache folder is writable: set "
            "NUMBA_CACHE_DIR to a writable folder."
        )
    return "Starting, ready in a few seconds." if all_compiled() else "Compiling, ready in about 20 s."


def _second_compiler() -> AbstractContextManager[object]:
    """Compile the circle map of the first scene in a second process, at the first start.

    Meanwhile this process compiles labels and the orbit, which takes as long.
    """
    from hess_explorer.server.compiled import KEEPS_KERNELS, all_compiled, compiler

    if not KEEPS_KERNELS or all_compiled():
        return nullcontext()
    return compiler("""
from hess_mechanics import circle_map

circle_map(0.5, 1.5, 0.6, "draft").theta([0.0])
""")


def _require_free(address: str, port: int) -> None:
    """Raise `CommandError` if the port is in use or cannot be opened, or the address is not one of this machine."""
    try:
        socket.create_server((address, port), family=socket.AF_INET6 if ":" in address else socket.AF_INET).close()
    except (OSError, UnicodeError) as error:
        raise CommandError(
            f"{error}: choose another --port, such as {port % 65535 + 1}, or --address 127.0.0.1 or 0.0.0.0."
        ) from error


def _has_browser() -> bool:
    try:
        browser = webbrowser.get()
    except webbrowser.Error:
        return False
    # Without a display only text browsers are found, which block the terminal and cannot show the page.
    return type(browser) is not webbrowser.GenericBrowser or "BROWSER" in os.environ


_SEVERAL = {"nargs": "+", "action": "extend"}

COMMAND = Command(
    "Serve the explorer on this machine and open it in the browser.",
    (
        integer_option("--port", 1, 65535, "port to listen on", 5006),
        option(
            "--address",
            "address to listen on (default 127.0.0.1, this machine only; 0.0.0.0 for all networks)",
            default="127.0.0.1",
        ),
        option("--no-browser", "do not open a browser", dest="browser", action="store_false"),
        option(
            "--allow-origin",
            "further hosts by which browsers reach the page, as in the address bar, for example of a proxy",
            dest="origins",
            type=_host,
            default=[],
            metavar="HOST:PORT",
            **_SEVERAL,
        ),
        option(
            "--embed-in",
            "hosts that may embed parts of the page (embed=1), like example.org or *.example.org; none for no host "
            "(default: any)",
            dest="embedders",
            type=_host,
            metavar="HOST",
            **_SEVERAL,
        ),
        integer_option("--workers", 1, 64, "number of worker processes; for a class, about the number of cores", 1),
        integer_option("--sessions", 1, 100_000, "maximum number of open pages per worker; 1000 need about 3 GB", 1000),
        option(
            "--chart",
            "store of a sweep over two parameters of a scene, which opens as a chart",
            type=Path,
            metavar="FOLDER",
        ),
        option(
            "--scene",
            "Python file of your own scene, SCENE = hess.scene(…), which is run; may be repeated, and the first opens",
            dest="scenes",
            type=Path,
            default=[],
            metavar="FILE",
            **_SEVERAL,
        ),
        option(
            "--lesson",
            "Markdown file of your own lesson, or a folder of such files; may be repeated, and the first lesson opens",
            dest="lessons",
            type=Path,
            default=[],
            metavar="FILE",
            **_SEVERAL,
        ),
    ),
    _run,
)
