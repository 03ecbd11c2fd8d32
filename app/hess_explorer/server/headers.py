"""What the page may do in a browser, and who may show it inside another: headers of the document.

Scripts run with the nonce of their answer, or from this server: what finds its way into the page as text is not run.
Bokeh asks for more in two places.  Its `CustomJS`, with which Panel tells that the document is ready, is compiled in
the browser (`unsafe-eval`), and its styles, as those of Material UI, stand in the elements (`unsafe-inline`).
"""

from __future__ import annotations

import secrets
from typing import ClassVar

from panel.io.server import DocHandler

from hess_explorer.protocol.parameters import MAX_QUERY
from hess_explorer.server.refusal import refuse

__all__ = ["GuardedDocument", "policy"]

QUERY_LIMIT = 4 * MAX_QUERY
"""Characters of a link: the whole of it comes back with the websocket, in a header."""


def policy(nonce: str, embedders: tuple[str, ...]) -> str:
    """Return the Content-Security-Policy of an answer; embedders : who may show it."""
    # Where any page may, also one of a file, which "*" does not mean, nothing is said.
    ancestors = "" if "*" in embedders else " ".join(embedders)
    return "; ".join(
        [
            "default-src 'none'",
            # Panel makes modules of texts, as blobs, which import those of this server.
            f"script-src 'self' blob: 'nonce-{nonce}' 'unsafe-eval'",
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            "font-src 'self' data:",
            "media-src 'self' blob:",
            "worker-src 'self' blob:",
            # The websocket, and those modules; a page that compares states shows two of itself.
            "connect-src 'self' blob:",
            "frame-src 'self'",
            "base-uri 'self'",
            "form-action 'none'",
            *([f"frame-ancestors {ancestors}"] if ancestors else []),
        ]
    )


class GuardedDocument(DocHandler):
    """The document of the page, with these headers."""

    embedders: ClassVar[tuple[str, ...]] = ("*",)
    """Who may show a part of the page, `embed=1`."""

    # Before it is chosen Tornado refuses what is no method of it.
    _nonce = ""

    async def prepare(self) -> None:
        """Choose the nonce of this answer."""
        self._nonce = secrets.token_urlsafe(16)
        # Before anything is made of it; what is a little too long opens the page, with a note.
        if len(self.request.query) > QUERY_LIMIT:
            refuse(
                self,
                414,
                f"The link is longer than {QUERY_LIMIT} characters, and the explorer's own are shorter "
                f"than {MAX_QUERY}: open the page without the part of its address after “?”.",
            )
            return
        await super().prepare()  # type: ignore[no-untyped-call]  # Panel declares no types
        embedded = self.get_query_argument("embed", "") == "1"
        self.set_header("Content-Security-Policy", policy(self._nonce, self.embedders if embedded else ("'self'",)))
        if not embedded:
            # For what does not know the policy.
            self.set_header("X-Frame-Options", "SAMEORIGIN")
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Referrer-Policy", "same-origin")

    def write(self, chunk: str | bytes | dict[str, object]) -> None:
        """The page, its scripts with the nonce; in its data there are no such tags, which are escaped there."""
        if isinstance(chunk, str):
            chunk = chunk.replace("<script", f'<script nonce="{self._nonce}"')
        super().write(chunk)
