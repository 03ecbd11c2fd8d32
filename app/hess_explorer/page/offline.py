"""Export a state as one HTML file that works without a server: the modules of the page with the data inside."""

from __future__ import annotations

import base64
import json
import posixpath
import re
from collections.abc import Sequence
from html import escape
from importlib.metadata import version
from typing import Any

from bokeh.resources import Resources

from hess_explorer.assets import STATIC
from hess_explorer.export.picture_data import address, complete, picture_of
from hess_explorer.page.component import styles
from hess_explorer.page.controls import show_controls
from hess_explorer.page.description import describe, without_gestures
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes.framework.stage import Stage

__all__ = ["HOME", "as_html", "bundled"]

HOME = "http://localhost:5006/"
"""Default address of the page."""

_ENTRY = "page/offline.js"
_IMPORT = re.compile(r'(?<=from )"(\.{1,2}/[\w./]+\.js)"')
_POLICY = "default-src 'none'; script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; img-src data: blob:"
"""Content-Security-Policy that blocks all requests to other hosts."""

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="generator" content="{program}">
<meta name="description" content="{summary}">
<title>{title} · Hess Explorer</title>
<link rel="icon" href="data:,">
<style>{style}</style>
<script type="importmap">{modules}</script>
<script type="application/json" id="facts">{facts}</script>
<script type="application/json" id="state">{state}</script>
<script type="application/octet-stream" id="block">{block}</script>
<script>{bokeh}</script>
</head>
<body>
<header><h1>{title}</h1><a href="{link}">{link}</a></header>
<main id="pictures"></main>
<div id="player"></div>
<aside>
<div id="derived"></div>
<fieldset disabled id="controls"><legend>Parameters</legend>
<p>This file holds one state, so they are fixed; the link above opens the explorer, where they move.</p></fieldset>
<div id="status" class="status-line"></div>
<div id="notes"></div>
<div id="legend"></div>
<div id="words"></div>
<p>{program}</p>
</aside>
<script type="module">import "{entry}"</script>
</body>
</html>
"""


def as_html(query: str, pictures: Sequence[str] = (), home: str = HOME, *, lenient: bool = False) -> tuple[str, bytes]:
    """Return the name of the scene of a query, and the HTML file of its state.

    Parameters
    ----------
    query : str
        Query of the state.
    pictures : sequence of str
        Names of the pictures; by default those that are open at first.
    home : str
        Address of the explorer, for the link in the file.
    lenient : bool
        True to correct an invalid query, as in `address`.

    Returns
    -------
    tuple of str and bytes
        The name of the scene and the contents of the file.

    Raises
    ------
    InvalidParameter
        If the scene has no such picture, or the query is invalid.
    ModelError
        If the state cannot be computed.
    """
    found = address(query, lenient=lenient)
    scene, values, link = found.scene, found.values, found.link
    wanted = [picture_of(scene, name).name for name in pictures] or scene.open_pictures
    chosen = [name for name in scene.pictures if name in wanted]
    wire = Wire()
    stage = Stage(scene, wire)
    state, report = complete(scene, values, chosen, lambda state: stage.show(state, False))
    for key, text in (
        ("summary", report.summary),
        ("status", report.status),
        ("derived", "\n".join(report.derived)),
        ("notes", "\n".join([*found.notes, *report.notes])),
    ):
        wire.say(key, text)
    show_controls(scene, values, wire)
    tree, block = wire.pack()
    description = json.loads(describe(scene.name))
    # Remove the interactions that need a server.
    description["handle"] = None
    description["pictures"] = [without_gestures(one) for one in description["pictures"] if one["name"] in chosen]
    program = f"hess-explorer {version('hess-explorer')}"
    facts: dict[str, Any] = {
        "link": link,
        "scene": scene.name,
        "title": scene.title,
        "pictures": chosen,
        "parameters": dict(values),
        "status": [f"accuracy: {state.work.chosen}", *state.status()],
        "notes": [*found.notes, *report.notes],
        "program": program,
    }
    parameters = ", ".join(f"{name} = {value}" for name, value in values.items())
    looks = {"speed": "1", **{name: repr(value) for name, value in found.client.items()}}
    page = _PAGE.format(
        policy=escape(_POLICY),
        program=escape(program),
        title=escape(scene.title),
        entry=_ENTRY,
        summary=escape(f"{program}, ?{link} | {parameters} | {'; '.join(facts['status'])}"),
        link=escape(f"{home}?{link}"),
        style=(STATIC / "page/offline.css").read_text(encoding="utf-8"),
        modules=json.dumps({"imports": bundled(_ENTRY)}),
        facts=_json(facts),
        block=base64.b64encode(block).decode(),
        state=_json({"description": description, "tree": tree, "client": looks, "sheets": styles()}),
        bokeh="\n".join(Resources(mode="inline", components=["bokeh"]).js_raw).replace("</script", "<\\/script"),
    )
    return scene.name, page.encode()


def bundled(entry: str) -> dict[str, str]:
    """Return a module and all that it imports, by path, as data URLs for an import map.

    Relative imports are rewritten to paths, because they cannot be resolved from a data URL.
    """
    found: dict[str, str] = {}

    def add(path: str) -> None:
        if path in found:
            return
        found[path] = ""
        code = (STATIC / path).read_text(encoding="utf-8")

        def named(match: re.Match[str]) -> str:
            other = posixpath.normpath(posixpath.join(posixpath.dirname(path), match[1]))
            add(other)
            return f'"{other}"'

        code = _IMPORT.sub(named, code)
        found[path] = f"data:text/javascript;base64,{base64.b64encode(code.encode()).decode()}"

    add(entry)
    return found


def _json(value: Any) -> str:
    """Return JSON that is safe inside an HTML script element."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
