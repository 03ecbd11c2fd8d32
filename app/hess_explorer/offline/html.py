"""Write a page as one HTML file that works without a server: the modules of the page and computed states."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Mapping
from functools import cache
from html import escape
from importlib.metadata import version
from typing import Any

from bokeh.resources import Resources

from hess_explorer.assets import STATIC
from hess_explorer.bundle import bundle
from hess_explorer.offline.recording import Recording
from hess_explorer.page.component import styles
from hess_explorer.protocol.specs import CLIENT

HOME = "http://localhost:5006/"
"""Default address of the explorer."""

_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src data:"
)
"""Content-Security-Policy that blocks all requests to other hosts."""
_EMPTY = ("large", "present", "theme", "lesson", "step")
_CLIENT = {**{spec.name: repr(spec.default) for spec in CLIENT}, **dict.fromkeys(_EMPTY, "")}

_PAGE = """<!DOCTYPE html>
<html lang="en" data-home="{home}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="generator" content="{program}">
<meta name="description" content="{summary}">
<title>{title} · Hess Explorer</title>
<link rel="icon" href="data:,">
<style>:root {{ color-scheme: light dark }} body {{ margin: 0; color: CanvasText; background: Canvas }}</style>
<script type="application/json" id="facts">{facts}</script>
<script type="application/json" id="model">{model}</script>
{strips}
<script type="application/octet-stream" id="code">{code}</script>
</head>
<body>
<div id="page"></div>
<script type="module">{loader}</script>
</body>
</html>
"""


def document(
    title: str,
    summary: str,
    recording: Recording,
    facts: Mapping[str, Any],
    client: Mapping[str, str],
    lesson: str = "",
    steps: Mapping[str, int] | None = None,
    home: str = HOME,
) -> bytes:
    """Return the HTML file of a page.

    Parameters
    ----------
    title, summary : str
        The title, and one sentence for search engines.
    recording : Recording
        The states.
    facts : mapping
        Metadata, kept in the file as JSON.
    client : mapping
        The keys that the browser keeps, such as the time and the view of spheres.
    lesson : str
        The description of the lesson as JSON; "" for none.
    steps : mapping, optional
        The number of the family of each step, by "lesson/number/revealed": number from 0, revealed "true" or "false".
    home : str
        The address of the explorer, for the links.

    Returns
    -------
    bytes
        The contents of the file.
    """
    index, strips = recording.pack()
    found = json.loads(lesson) if lesson else None
    program = f"hess-explorer {version('hess-explorer')}"
    model = {
        "client": {**_CLIENT, **client},
        "lesson": lesson,
        "sheets": styles(),
        "recording": {
            **index,
            "scenes": recording.descriptions(),
            "steps": steps or {},
            "lessons": {found["name"]: found} if found else {},
        },
    }
    page = _PAGE.format(
        policy=escape(_POLICY),
        home=escape(home),
        program=escape(program),
        title=escape(title),
        summary=escape(summary),
        loader=(STATIC / "offline/loader.js").read_text(encoding="utf-8"),
        code=_code(),
        facts=_json({**facts, "program": program}),
        model=_json(model),
        strips="\n".join(
            f'<script type="application/octet-stream" id="strip-{i}">{strip}</script>' for i, strip in enumerate(strips)
        ),
    )
    return page.encode()


def module_address() -> str:
    """Return the address from which the page imports its modules."""
    return f"data:text/javascript;base64,{base64.b64encode(bundle('offline/file.js').encode()).decode()}"


@cache
def _code() -> str:
    """Return Bokeh and the modules of the page, compressed, in base 64."""
    bokeh = "\n".join(Resources(mode="inline", components=["bokeh"]).js_raw)
    code = json.dumps({"bokeh": bokeh, "page": module_address()})
    return base64.b64encode(zlib.compress(code.encode(), 9)).decode()


def _json(value: Any) -> str:
    """Return JSON that is safe inside an HTML script element."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
