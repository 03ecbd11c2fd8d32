"""Generate the Python code that computes and draws a picture of the page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from hess_explorer.export.picture_data import Address
from hess_explorer.protocol.specs import NumberSpec, Points, Spec, Value, points_of

_WIDTH = 100


def code(address: Address) -> str:
    """Return a script that computes and draws a picture; its data are identical to the CSV file.

    The script names all parameters, so that it does not depend on defaults.
    """
    return "\n".join(
        [f"# {line}" for line in _about(address)] + ["import hess_explorer as hess", "", *lines_of(address), ""]
    )


def _about(address: Address) -> list[str]:
    return [f"{address.scene.title}, a state of Hess Explorer:", f"?{address.link}"]


def lines_of(address: Address) -> list[str]:
    """Return the lines of code that create the state, compute the data, and draw; the last line draws."""
    scene, name = address.scene, address.picture.name
    given = {spec.name: _value(spec, address.values[spec.name]) for spec in scene.specs}
    given |= {key: repr(value) for key, value in address.view_values.items()}
    words = [repr(scene.name).replace("'", '"'), *(f"{key}={value}" for key, value in given.items() if value)]
    return ["state = hess.state(", *_wrap(words), f'data = state.data("{name}")', f'state.plot("{name}")']


def _wrap(words: Sequence[str]) -> Iterator[str]:
    """Yield lines with the wrapped arguments and the closing bracket."""
    line = "   "
    for word in words[:-1]:
        if len(line) + len(word) > _WIDTH:
            yield line
            line = "   "
        line += f" {word},"
    yield f"{line} {words[-1]})"


def _value(spec: Spec, value: Value) -> str:
    """Return a value as Python code; empty if the argument is omitted."""
    if isinstance(spec, NumberSpec):
        return repr(float(value))
    if isinstance(spec, Points):
        return repr(points_of(value)).replace(" ", "") if value or spec.default else ""
    return f'"{value}"'
