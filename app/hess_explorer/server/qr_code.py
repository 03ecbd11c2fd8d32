"""QR codes of links to the page, for the dialogs *Share* and *Invite*."""

from __future__ import annotations

import asyncio
import io

import segno
from tornado.web import RequestHandler

from hess_explorer.server.refusal import refuse

MAX_LENGTH = 1500
"""Maximum length of a text in bytes; a phone camera cannot read a denser code from a screen."""


def drawing(text: str) -> str:
    """Return the QR code (ISO/IEC 18004) of a text as SVG, black on white with a quiet zone."""
    code = segno.make_qr(text, error="m", boost_error=False)
    svg = io.BytesIO()
    code.save(svg, kind="svg", border=4, dark="#000", light="#fff", xmldecl=False, omitsize=True)
    return svg.getvalue().decode()


class QrCode(RequestHandler):
    """GET /qr.svg?text=…: the QR code, or an error message."""

    async def get(self) -> None:
        """Respond with the SVG; with 400 and a message if the text is empty or too long."""
        text = self.get_query_argument("text", "", strip=False)
        length = len(text.encode())
        self.set_header("X-Content-Type-Options", "nosniff")
        if not 0 < length <= MAX_LENGTH:
            refuse(
                self,
                400,
                f"The link has {length} bytes, but a readable QR code holds at least 1 and at most {MAX_LENGTH}: share "
                "the link itself.",
            )
            return
        # A large code takes 0.1 s, too long for the event loop.
        svg = await asyncio.get_running_loop().run_in_executor(None, drawing, text)
        self.set_header("Content-Type", "image/svg+xml; charset=utf-8")
        self.finish(svg)
