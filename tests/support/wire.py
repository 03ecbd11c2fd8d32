"""What the browser reads of a message."""

from __future__ import annotations

import json
import struct

import numpy as np


def _refuse(name):
    raise ValueError(f"JSON.parse in a browser refuses {name}")


def read_frame(frame):
    """What "websocket.js" makes of an answer: its head, its block, the cells of a chart."""
    if not frame:
        return {}, b"", b""
    head, block = struct.unpack_from("<II", frame)
    return (
        json.loads(frame[8 : 8 + head], parse_constant=_refuse),
        frame[8 + head : 8 + head + block],
        frame[8 + head + block :],
    )


def read(item, block):
    """What "unpack.js" makes of an item of the tree: an array where the tree says where one lies."""
    if isinstance(item, list):
        return [read(part, block) for part in item]
    if isinstance(item, dict):
        assert {"at", "n"} <= set(item) <= {"at", "n", "shape"}
        array = np.frombuffer(block, "<f4", count=item["n"], offset=4 * item["at"])
        return array.reshape(item["shape"]) if "shape" in item else array
    return item
