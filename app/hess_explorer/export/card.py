"""The picture of a state as a card of 1200 × 630 pixels, the size that chats and posts show for a link."""

from __future__ import annotations

import io
import textwrap

import numpy as np

from hess_explorer.export.picture_data import PictureData
from hess_explorer.views import theme
from hess_mechanics.errors import InvalidParameter

__all__ = ["SIZE", "card"]

SIZE = (1200, 630)
_MM = 85.0


def card(data: PictureData) -> bytes:
    """Return a PNG with the picture on the right, and title and caption on the left.

    Raises `InvalidParameter` if Matplotlib is not installed.
    """
    try:
        import matplotlib as mpl
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as error:
        raise InvalidParameter("Cards need Matplotlib: pip install 'hess-explorer[export]'.") from error
    # Not at the start, because no page needs HoloViews.
    from hess_explorer.export.figure import STYLE, draw

    width, height = SIZE
    with mpl.rc_context(dict(STYLE)):
        square = draw(data, _MM)
        square.set_dpi(height * 25.4 / _MM)
        canvas = FigureCanvasAgg(square)
        canvas.draw()
        picture = np.asarray(canvas.buffer_rgba())[:height]
        figure = Figure(figsize=(width / 100.0, height / 100.0), dpi=100.0, facecolor=theme.PAPER)
        figure.figimage(picture, xo=width - picture.shape[1], yo=0)
        words = (
            (0.9, "Hess Explorer", 15, 40, theme.MUTED),
            (0.82, data.scene.title, 26, 24, theme.INK),
            (0.6, data.title, 19, 34, theme.ORBIT),
            (0.47, data.caption, 16, 42, theme.INK),
        )
        for y, text, size, letters, colour in words:
            lines = "\n".join(textwrap.wrap(text, letters, max_lines=6, placeholder=" …"))
            figure.text(0.04, y, lines, fontsize=size, va="top", color=colour, parse_math=False)
        out = io.BytesIO()
        figure.savefig(out, format="png", dpi=100.0)
    return out.getvalue()
