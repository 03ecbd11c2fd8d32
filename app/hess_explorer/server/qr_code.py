"""QR codes of links to this page, for the dialog *Share* and for what is printed."""

from __future__ import annotations

import asyncio
import io

import segno
from tornado.web import RequestHandler

from hess_explorer.server.refusal import refuse

__all__ = ["MOST", "QrCode", "drawing"]

MOST = 1500
"""Bytes of a text: a code of more is too fine for a phone's camera in front of a screen."""


def drawing(text: str) -> str:
    """The QR code (ISO/IEC 18004) of a text as SVG, black on white with the margin that readers need."""
    code = segno.make_qr(text, error="m", boost_error=False)
    svg = io.BytesIO()
    code.save(svg, kind="svg", border=4, dark="#000", light="#fff", xmldecl=False, omitsize=True)
    return svg.getvalue().decode()


class QrCode(RequestHandler):
    """GET /qr.svg?text=…: the code, or why there is none."""

    async def get(self) -> None:
        """Answer with the drawing; 400 and a sentence where the text is empty or too long."""
        text = self.get_query_argument("text", "", strip=False)
        length = len(text.encode())
        self.set_header("X-Content-Type-Options", "nosniff")
        if not 0 < length <= MOST:
            refuse(
                self,
                400,
                f"The link has {length} characters, and a QR code that a camera reads at most {MOST}: "
                "share the link itself.",
            )
            return
        # The largest takes a tenth of a second, in which the page of others should not wait.
        svg = await asyncio.get_running_loop().run_in_executor(None, drawing, text)
        self.set_header("Content-Type", "image/svg+xml; charset=utf-8")
        self.finish(svg)
