"""The chart that `hess-explorer serve --chart` opens."""

from __future__ import annotations

from tornado.web import RequestHandler

__all__ = ["ServedChart"]


class ServedChart(RequestHandler):
    """GET /chart.json: the chart, as the page saves it."""

    HEAD = '<meta name="chart" content="chart.json">\n    '
    """Tells the page to open the chart."""

    def initialize(self, content: str) -> None:
        """Store the text of the chart."""
        self._content = content

    def get(self) -> None:
        """Respond with the chart."""
        self.set_header("Content-Type", "application/json")
        self.set_header("X-Content-Type-Options", "nosniff")
        self.finish(self._content)
