"""Export a state as a Jupyter notebook with its link, the code that computes it, and a plot."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib.metadata import version
from typing import Any

from hess_explorer.export.code import code, lines_of
from hess_explorer.export.picture_data import Address


def notebook(address: Address) -> str:
    """Return the notebook as JSON in the format nbformat 4.5.

    The format is simple enough to write without a library, see
    https://nbformat.readthedocs.io/en/latest/format_description.html.
    """
    introduction = (
        f"# {address.scene.title}\n\n{address.scene.summary}\n\nThe state: `?{address.link}`\n\n"
        f"hess-explorer {version('hess-explorer')}: `pip install 'hess-explorer[notebook]'`."
    )
    made = lines_of(address)
    cells = [
        ("markdown", introduction),
        ("code", "import hess_explorer as hess"),
        ("code", "\n".join(made[:-1])),
        ("code", made[-1]),
        ("code", "data"),
    ]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return (
        json.dumps(
            {
                "nbformat": 4,
                "nbformat_minor": 5,
                "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
                "cells": [_cell(number, kind, source) for number, (kind, source) in enumerate(cells)],
            },
            ensure_ascii=False,
            indent=1,
        )
        + "\n"
    )


def _cell(number: int, kind: str, source: str) -> dict[str, Any]:
    outputs: dict[str, Any] = {"execution_count": None, "outputs": []} if kind == "code" else {}
    return {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": source.splitlines(True), **outputs}


PROGRAMS: Mapping[str, Callable[[Address], str]] = {"py": code, "ipynb": notebook}
"""Generators of code that computes a picture, by format."""
