"""The figure as sent to the browser."""

import json
import re

import pytest
from bokeh.embed import json_item

from hess_explorer.scenes import scenes
from hess_explorer.views import bokeh_figure

PLOTS = [view for view in scenes()["suslov-hess"].views if view.kind == "plot"]


def numbered(roots):
    """With the models' names in the order in which they come: each figure has new ones."""
    names = {}
    return json.loads(re.sub(r'"p\d+"', lambda found: names.setdefault(found[0], f'"{len(names)}"'), json.dumps(roots)))


@pytest.mark.parametrize("plot", PLOTS, ids=lambda plot: plot.name)
def test_it_is_what_bokeh_itself_would_say_but_for_definitions_that_the_page_has(plot):
    own = bokeh_figure.describe(plot)["item"]
    bokehs = json_item(bokeh_figure.build(plot))
    assert own.keys() == bokehs.keys()
    assert own["doc"].keys() == bokehs["doc"].keys() - {"defs"}
    assert (own["doc"]["version"], own["version"]) == (bokehs["doc"]["version"], bokehs["version"])
    assert own["root_id"] == own["doc"]["roots"][0]["id"]
    for part in ("config", "roots"):
        assert numbered(own["doc"][part]) == numbered(bokehs["doc"][part])
