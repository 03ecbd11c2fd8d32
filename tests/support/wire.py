"""Decoding of messages as in the browser."""

import json
import struct

import numpy as np


def _refuse(name):
    raise ValueError(f"JSON.parse in a browser refuses {name}")


def read_frame(frame):
    """Decode a response as "websocket.js" does: its head and its block."""
    if not frame:
        return {}, b""
    head, block = struct.unpack_from("<II", frame)
    assert len(frame) == 8 + head + block
    return json.loads(frame[8 : 8 + head], parse_constant=_refuse), frame[8 + head :]


def read(item, block):
    """Decode an item of the tree as "unpack.js" does: an array where the tree refers to one."""
    if isinstance(item, list):
        return [read(part, block) for part in item]
    if isinstance(item, dict):
        assert {"at", "n"} <= set(item) <= {"at", "n", "shape", "shorts"}
        if "shorts" in item:
            return np.frombuffer(block, "<i2", count=item["shorts"], offset=4 * item["at"])
        array = np.frombuffer(block, "<f4", count=item["n"], offset=4 * item["at"])
        return array.reshape(item["shape"]) if "shape" in item else array
    return item
