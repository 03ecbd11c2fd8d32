"""Rules of WCAG: contrast, and those that axe asks of a page as it is."""

import numpy as np
from axe_playwright_python.sync_playwright import Axe

# Of the rules that hold a name is enough, and of those that do not the HTML; no sheet of styles is fetched again.
# Selectors of every node that was looked at take as long as the rules.
OPTIONS = {
    "runOnly": ["wcag2a", "wcag2aa", "best-practice"],
    # In present mode the title of the scene is out of sight.
    "rules": {"page-has-heading-one": {"enabled": False}},
    "resultTypes": ["violations"],
    "selectors": False,
    "preload": False,
}


def assert_accessible(page, part=None):
    """No rule of WCAG 2, A and AA, or of good practice is broken by the page, or by a part alone, which is faster."""
    page.evaluate(Axe().axe_script)
    found = (part or page.locator("html")).evaluate("(item, options) => axe.run(item, options)", OPTIONS)
    assert [(rule["id"], node["html"][:200]) for rule in found["violations"] for node in rule["nodes"]] == []
    # A page that is not there breaks no rule.
    assert len(found["passes"]) > (10 if part is None else 2)


def rgb(colour):
    """Red, green and blue, 0 to 1, of #RRGGBB, or of numbers up to 255."""
    return np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)] if isinstance(colour, str) else colour[:3]) / 255


def luminance(colour):
    """Relative luminance, as WCAG defines it."""
    parts = rgb(colour)
    return float(np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4) @ (0.2126, 0.7152, 0.0722))


def contrast(one, other):
    low, high = sorted(map(luminance, (one, other)))
    return (high + 0.05) / (low + 0.05)
