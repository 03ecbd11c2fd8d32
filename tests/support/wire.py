"""What the browser reads of a message."""

from __future__ import annotations

import numpy as np


def read(item, block):
    """What "ready.js" makes of an item of the tree: an array where the tree says where one lies."""
    if isinstance(item, list):
        return [read(part, block) for part in item]
    if isinstance(item, dict):
        assert {"at", "n"} <= set(item) <= {"at", "n", "shape"}
        array = np.frombuffer(block, "<f4", count=item["n"], offset=4 * item["at"])
        return array.reshape(item["shape"]) if "shape" in item else array
    return item
