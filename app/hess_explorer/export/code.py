"""The few lines of Python that compute and draw what is on the screen."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from hess_explorer.export.shown import Address
from hess_explorer.protocol.parameters import Number, Places, Spec, Value, places

__all__ = ["code", "lines_of"]

_WIDTH = 100


def code(address: Address) -> str:
    """A program that leaves the numbers of a picture in `data`: the columns of its CSV, bit for bit at the same level.

    All parameters are named, so that it means the same when a default changes.
    """
    return "\n".join(
        [f"# {line}" for line in _about(address)] + ["import hess_explorer as hess", "", *lines_of(address), ""]
    )


def _about(address: Address) -> list[str]:
    return [f"{address.scene.title}, a state of Hess Explorer:", f"?{address.link}"]


def lines_of(address: Address) -> list[str]:
    """Those that make the state, compute and draw."""
    scene, name = address.scene, address.picture.name
    given = {spec.name: _value(spec, address.values[spec.name]) for spec in scene.specs}
    given |= {key: repr(value) for key, value in address.looks.items()}
    words = [repr(scene.name).replace("'", '"'), *(f"{key}={said}" for key, said in given.items() if said)]
    return ["state = hess.state(", *_filled(words), f'data = state.data("{name}")', f'state.plot("{name}")']


def _filled(words: Sequence[str]) -> Iterator[str]:
    """Arguments, as many in a line as there is room for, and the closing bracket."""
    line = "   "
    for word in words[:-1]:
        if len(line) + len(word) > _WIDTH:
            yield line
            line = "   "
        line += f" {word},"
    yield f"{line} {words[-1]})"


def _value(spec: Spec, value: Value) -> str:
    """As Python writes it; empty for what is left out."""
    if isinstance(spec, Number):
        return repr(float(value))
    if isinstance(spec, Places):
        return repr(places(value)).replace(" ", "") if value or spec.default else ""
    return f'"{value}"'
