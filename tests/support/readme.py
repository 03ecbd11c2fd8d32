"""Tables of app/README.md about the paper, and the examples that they name."""

import re

from hess_explorer.scenes import scenes
from support.mechanics import ROOT

SCENES = {name: scene for name, scene in scenes().items() if scene.origin is None}
README = (ROOT / "app/README.md").read_text(encoding="utf-8")


def table(heading):
    """Return the rows below a heading, without the first two lines."""
    text = README.partition(f"## {heading}\n")[2].partition("\n## ")[0]
    lines = re.findall(r"^\|.*\|$", text, re.MULTILINE)[2:]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]


def named(examples, title):
    """Return the examples of that name; where it ends in … they may go on."""
    return [one for one in examples if one.name == title or (title[-1] == "…" and one.name.startswith(title[:-1]))]
