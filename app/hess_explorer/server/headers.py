"""Security headers of the document: what the page may load, and which sites may embed it.

Scripts must come from this server or have the nonce of the response, so injected text is never executed.  Bokeh needs
two exceptions: its `CustomJS`, with which Panel signals that the document is ready, is compiled in the browser
(`unsafe-eval`), and its styles are inline (`unsafe-inline`).
"""

from __future__ import annotations

import secrets
from typing import ClassVar

from panel.io.server import DocHandler

from hess_explorer.assets import modules_path
from hess_explorer.page.opening import THEME
from hess_explorer.protocol.specs import MAX_QUERY, decode
from hess_explorer.server.refusal import refuse

QUERY_LIMIT = 4 * MAX_QUERY
"""Maximum length of a query in characters; the websocket request repeats it in a header."""

# A relative URL also works behind a proxy that serves the page under a prefix.
_BASE = f"""
    <meta name="viewport" content="width=device-width, initial-scale=1">
    <style>html, body {{ color: CanvasText; background: Canvas }}</style>
    <script type="module" src="{modules_path()}/page/start.js"></script>
    """
_END = "</head>"


def _schemes(query: str) -> str:
    """Return the meta element with the theme of a link, in which the browser paints the first frame."""
    theme = decode(query, (THEME,))[0]["theme"]
    schemes = "light dark" if theme == THEME.default else theme
    return f'<meta name="color-scheme" content="{schemes}">\n    '


def policy(nonce: str, embedders: tuple[str, ...]) -> str:
    """Return the Content-Security-Policy of a response.

    Parameters
    ----------
    nonce : str
        Nonce of the scripts of this response.
    embedders : tuple of str
        Sites that may embed the page; "*" allows all.
    """
    # Without frame-ancestors any page may embed this one; "*" would exclude local files.
    ancestors = "" if "*" in embedders else " ".join(embedders)
    return "; ".join(
        [
            "default-src 'none'",
            # Panel loads its component from a blob URL.
            f"script-src 'self' blob: 'nonce-{nonce}' 'unsafe-eval'",
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            "font-src 'self' data:",
            "media-src 'self' blob:",
            # 'self' allows the websocket, blob: allows Panel's component.
            "connect-src 'self' blob:",
            # A comparison of two states shows the page in two frames.
            "frame-src 'self'",
            "base-uri 'self'",
            "form-action 'none'",
            *([f"frame-ancestors {ancestors}"] if ancestors else []),
        ]
    )


class GuardedDocument(DocHandler):
    """Handler of the document that adds the security headers."""

    embedders: ClassVar[tuple[str, ...]] = ("*",)
    """Sites that may embed a part of the page (`embed=1`)."""

    # A default is needed, because Tornado may send an error before `prepare`.
    _nonce = ""

    async def prepare(self) -> None:
        """Create the nonce of the response and set the headers; respond with 414 if the query is far too long."""
        self._nonce = secrets.token_urlsafe(16)
        # Reject a far too long query before it is parsed; a slightly too long one opens the page with a note.
        if len(self.request.query) > QUERY_LIMIT:
            refuse(
                self,
                414,
                f"The link is longer than {QUERY_LIMIT} characters; links of the explorer have at most {MAX_QUERY}: "
                "open the page without the part of its address after “?”.",
            )
            return
        await super().prepare()  # type: ignore[no-untyped-call]  # Panel declares no types
        embedded = self.get_query_argument("embed", "") == "1"
        self.set_header("Content-Security-Policy", policy(self._nonce, self.embedders if embedded else ("'self'",)))
        if not embedded:
            # Older browsers do not support frame-ancestors.
            self.set_header("X-Frame-Options", "SAMEORIGIN")
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Referrer-Policy", "same-origin")

    def write(self, chunk: str | bytes | dict[str, object]) -> None:
        """Write a chunk of the page; add start script and theme to its head, and the nonce to scripts.

        In the data of the page "<" is escaped, so these tags occur only in its markup.
        """
        if isinstance(chunk, str):
            if _END in chunk:
                head = _BASE + _schemes(self.request.query)
                chunk = chunk.replace(_END, head + _END, 1)
            chunk = chunk.replace("<script", f'<script nonce="{self._nonce}"')
        super().write(chunk)
