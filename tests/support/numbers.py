"""Numbers as captions write them."""

NUMBER = r"(−?[\d.]+(?:e−?\d+)?)"
