"""Tables in Markdown that a script measures, and the part of a README that it replaces with them."""

import re


def line(cells):
    """A line of a table."""
    return f"| {' | '.join(cells)} |"


def table(head, rows):
    """A table."""
    return "\n".join(map(line, [head, ["---"] * len(head), *rows]))


def write_measured(readme, text):
    """Replace the text in `readme` between the comments `measured` and `end of measured`."""
    whole = readme.read_text(encoding="utf-8")
    pattern = re.compile(r"(<!-- measured[^>]*-->\n).*?(\n<!-- end of measured -->)", re.DOTALL)
    if len(pattern.findall(whole)) != 1:
        raise ValueError(f"{readme}: write the comments <!-- measured … --> and <!-- end of measured --> once.")
    readme.write_text(pattern.sub(lambda found: f"{found[1]}\n{text.strip()}\n{found[2]}", whole), encoding="utf-8")
