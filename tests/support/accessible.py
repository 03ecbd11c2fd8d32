"""Rules of WCAG, asked of a page as it is: axe."""

from axe_playwright_python.sync_playwright import Axe

# Of the rules that hold a name is enough, and of those that do not the HTML; no sheet of styles is fetched again.
# Selectors of every node that was looked at take as long as the rules.
OPTIONS = {"runOnly": ["wcag2a", "wcag2aa"], "resultTypes": ["violations"], "selectors": False, "preload": False}


def assert_accessible(page):
    """No rule of WCAG 2, A and AA, is broken by what the page holds."""
    found = Axe().run(page, options=OPTIONS).response
    assert [(rule["id"], node["html"][:200]) for rule in found["violations"] for node in rule["nodes"]] == []
    # A page that is not there breaks no rule.
    assert len(found["passes"]) > 10
