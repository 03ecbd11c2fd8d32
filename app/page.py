"""The page: controls beside, pictures in a row, player, status, words."""

from __future__ import annotations

from typing import Any

import panel as pn
import panel_material_ui as pmui
from panel.util import edit_readonly

from app.components import STATIC, Player, Ready, Text
from app.controls import Controls
from app.scenes import scenes
from app.session import Session
from app.state import CLIENT, Choice, Values, decode
from app.words import with_formulas

__all__ = ["page"]

THEME = Choice("theme", "Theme", ("light", "dark"), "light")

PAGE_CSS = (STATIC / "page.css").read_text(encoding="utf-8")

LEGEND = """
<ul class="legend" aria-label="Legend">
<li><span class="line orbit"></span>orbit</li>
<li><span class="line stable"></span>stable cycle</li>
<li><span class="line unstable"></span>unstable cycle</li>
<li><span class="dot point"></span>moving point</li>
<li><span class="box forbidden"></span>impossible</li>
<li><span class="box locked"></span>locked</li>
<li><span class="box rho"></span>ρ from −½ to ½</li>
</ul>
"""

CHOOSE = "Choose an example…"

COPY = "navigator.clipboard?.writeText(window.location.href)"


def _query() -> str:
    context = pn.state.curdoc.session_context if pn.state.curdoc else None
    request = getattr(context, "request", None)
    arguments = getattr(request, "arguments", None) or {}
    return "&".join(
        f"{name}={values[0].decode('utf-8', 'replace')}" for name, values in arguments.items() if values
    )


def page() -> pmui.Page:
    """A new page for one session, in the state that its URL describes."""
    scene = next(iter(scenes().values()))
    specs = (*scene.specs, *CLIENT, THEME)
    state, notes = decode(_query(), specs)
    client = {spec.name: float(state.pop(spec.name)) for spec in CLIENT}
    dark = state.pop("theme") == "dark"

    stage = scene.stage()
    ready = Ready(client={name: repr(value) for name, value in client.items()}, width=0, height=0, margin=0)
    status = Text(key="status", look="status", live=True, sizing_mode="stretch_width")
    remarks = Text(key="notes", look="notes", live=True, sizing_mode="stretch_width")
    derived = Text(key="derived", look="derived", tag="div", sizing_mode="stretch_width", margin=(8, 4))

    def show_menus(values: Values) -> None:
        controls.show(values)
        examples.value = next(
            (preset.name for preset in scene.presets if scene.example(preset).items() <= values.items()), CHOOSE)

    def choose(name: str) -> None:
        for preset in scene.presets:
            if preset.name == name:
                session.change(scene.example(preset))

    session = Session(scene, stage, ready, state, notes, show_menus)
    admitted = scene.admit(state)[0]
    controls = Controls(scene.specs, admitted, scene.limits(admitted), session.change)
    sphere = next(picture.root for picture in stage.pictures if picture.name == "sphere")
    sphere.param.update(azimuth=client["az"], elevation=client["el"])
    player = Player(
        t=client["t"], speed=client["speed"], angles=list(stage.angles), sizing_mode="stretch_width",
        dots={name: list(columns) for name, columns in stage.dots.items()}, margin=(0, 8),
    )

    examples = pmui.Select(
        label="Example", options=[CHOOSE, *(preset.name for preset in scene.presets)], size="small",
        css_classes=["param-preset"], sizing_mode="stretch_width", margin=(8, 8),
    )
    examples.param.watch(lambda event: choose(event.new), "value")
    reset = pmui.Button(label="Reset", variant="outlined", size="small", css_classes=["param-reset"])
    reset.on_click(lambda _: session.reset())
    link = pmui.Button(label="Copy link", variant="outlined", size="small", css_classes=["param-link"])
    link.jscallback(clicks=COPY)

    session.attach()
    cells = [_cell(picture) for picture in stage.pictures]
    result = pmui.Page(
        title=f"Hess Explorer · {scene.title}",
        meta_name="Hess Explorer",
        meta_description=scene.summary,
        dark_theme=dark,
        sidebar=[preset, *controls.roots, pn.Row(reset, link, margin=(8, 4)), derived],
        sidebar_width=300,
        main=[
            pn.Column(*cells, css_classes=["pictures"], stylesheets=[PAGE_CSS], sizing_mode="stretch_width"),
            pn.pane.HTML(LEGEND, stylesheets=[PAGE_CSS], sizing_mode="stretch_width", margin=(0, 8)),
            pn.Column(player, css_classes=["dock"], stylesheets=[PAGE_CSS], sizing_mode="stretch_width"),
            pn.Column(status, remarks, sizing_mode="stretch_width", margin=(4, 8)),
            pn.pane.Markdown(with_formulas(scene.words), sizing_mode="stretch_width", css_classes=["words"],
                             stylesheets=[PAGE_CSS], margin=(0, 8)),
            ready,
        ],
        busy_indicator=None,
    )
    # The page's own busy flag is sent with every event and makes Panel walk through all models each
    # time (100 ms); `data-ready` says the same.
    with edit_readonly(result):
        result.busy = False
    return result


def _cell(picture: Any) -> pn.Column:
    root = picture.root
    body = root if isinstance(root, pn.viewable.Viewable) else pn.pane.Bokeh(root, sizing_mode="stretch_width", margin=0)
    return pn.Column(
        picture.caption, body, css_classes=["picture", f"picture-{picture.name}"], stylesheets=[PAGE_CSS],
        sizing_mode="stretch_width",
    )
