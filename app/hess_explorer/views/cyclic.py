"""A cyclic colour scale, for numbers with −½ and ½ identified.

Darkest at ±½, lightest at 0, blue below and yellow above, uniform in lightness and safe for colour-blind readers:
CET-CBC1 of P. Kovesi, "Good Colour Maps: How to Design Them" (arXiv:1509.03700), shifted so that it begins at its
darkest colour.  Only every eighth colour is copied here, because importing the package colorcet (CC BY 4.0) takes a
second.
"""

from __future__ import annotations

_COUNT = 256
_EVERY_EIGHTH = (
    "2F2E2C 2F323D 343C53 38486A 3B5383 3C5F9C 3B6BB5 3877D0 "
    "3A83E6 528FEF 709CF0 89A9F1 9FB6F2 B4C3F2 C7D1F3 DADFF3 "
    "E9E9ED EAE4D8 E2D7BC D8C9A1 CEBB85 C3AE6B B7A14F AB9433 "
    "9D8716 8F7A0F 806E17 72621D 645621 564B24 484025 3A3527 "
)


def _scale() -> tuple[str, ...]:
    anchors = [[int(one[i : i + 2], 16) for i in (0, 2, 4)] for one in _EVERY_EIGHTH.split()]
    step = _COUNT // len(anchors)
    mixed = (
        [((step - j) * x + j * y) / step for x, y in zip(anchor, anchors[(i + 1) % len(anchors)], strict=True)]
        for i, anchor in enumerate(anchors)
        for j in range(step)
    )
    return tuple("#" + "".join(f"{round(part):02X}" for part in colour) for colour in mixed)


TURN = _scale()
"""256 colours from −½ to just below ½."""
