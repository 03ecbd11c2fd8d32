"""The record of a preset in "tests/scenes/presets.json": its columns in a few numbers, and its words.

A record is made from several runs, with starts moved by a few ulps and code for another processor.  What differs
between the runs hangs on the last bit: it is None, or # within a text.  Of what the oracle knows, the record has the
oracle's values.
"""

import json
import re
from pathlib import Path

import numpy as np

from hess_mechanics.suslov.scattering import Scattering
from hess_mechanics.suslov_hess.circle_map import CircleMap
from support.board import SCENES, flat
from support.view import View

PRESETS = Path(__file__).parents[1] / "scenes/presets.json"
EXAMPLES = [
    (scene, preset)
    for scene in SCENES.values()
    if scene.origin is None
    for preset in (scene.presets[:1] if scene.name == "own-body" else scene.presets)
]
"""All but those of the scenes that show what computations cost, and of bodies whose equations take 20 s to compile."""

PIXEL = 1e-3
"""What a picture can show of a column, relative to its largest number."""
STABLE = PIXEL / 10
"""Runs agree to this, so that another processor is within a pixel."""
FEW = 32
"""So many items have an exact number; of longer columns it belongs to adaptive steps."""
PLACED = ("-label", "-names", "-message")
"""Sources of texts in pictures; their places are where there is room."""
LESS = {"orbits": 4.0, "count": 20.0, "long": 20.0, "steps": 20.0}
"""What is computed of sections, exponents and diagrams: all that does not depend on how much is shown."""
MOMENTS = np.array([0.0, 0.1131, 0.2917, 0.5323, 0.8311])
"""Times at which the direction of γ is recorded, relative to the time span: no motion is the same at all of them."""
SPARSE = 0.3
"""Where γ turns by more from a sample to the next one, chords tell nothing of what is between them."""
COST = re.compile(r"\d (ms|s)\b|^auto")
DIGITS = re.compile(r"(?<![\w₀-₉])(?:−?\d+(?:,\d{3})*(?:\.\d+)?(?:e[−+]?\d+)?|#)")
ROUND_OFF = 1e-5
"""Smaller numbers in texts are errors."""
NOTHING = 1e-12
"""Columns of smaller numbers are 0 but for round-off."""
COUNTED = re.compile(r"\d[\d,]*(?= (?:Taylor steps|steps|points))|(?<=crossing )\d+")
"""Numbers in the status line that are those of adaptive steps."""


def view_of(scene, preset, seen=None):
    """Return the view of a preset with all of its pictures, or these; what is refused belongs to the record."""
    less = {name: number for name, number in LESS.items() if name in scene.defaults()}
    if seen is None:
        # Diagrams and what attracts in them are chaotic and take 10 s each: "test_orbit_diagram.py" has them.  Charts
        # and swarms have tests of their own.
        seen = {"body", "sphere"} if "diagram" in scene.pictures else {*scene.pictures} - {"chart", "spread"}
    coarse = {"accuracy": "draft"} if preset.values.get("colours") == "basins" else {}
    return View(scene, {**preset.values, **less, **coarse}, seen=seen, refusing=True)


def record(view):
    """Return the record of a view in this run."""
    report = view.report
    words = {name: text for name, text in view.text.items() if name not in ("signs", "windowed")}
    entries = (COUNTED.sub("#", entry) for entry in report.status.split(" · ") if not COST.search(entry))
    lists = {"derived": report.quantities, "notes": report.notes, "status": entries}
    columns = {source: reduced(source, columns) for source, columns in view.data.items()}
    return {
        "words": words | {name: "\n".join(lines) for name, lines in lists.items()},
        "columns": {source: found for source, found in columns.items() if found},
        "oracle": known_to_the_oracle(view),
    }


def reduced(source, columns):
    """Return {column: [count, least, largest, mean]}, or the texts of a column."""
    found = {}
    for name, items in ((name, flat(column)) for name, column in columns.items()):
        if items and all(isinstance(one, str) for one in items):
            found[name] = [" ".join(one.split()) for one in items]
        elif items and not source.endswith(PLACED):
            found[name] = of_numbers(items)
    return found


def of_numbers(items):
    """Return the count, the least and the largest number and the mean; a single number after the count 1."""
    numbers = np.array([one for one in items if not isinstance(one, str) and one == one], float)  # noqa: PLR0124
    reductions = (np.min, np.max, np.mean) if numbers.size > 1 else (np.sum,)
    return counted([reduction(numbers) for reduction in reductions], numbers.size)


def counted(numbers, count):
    return [count, *(float(f"{number:.4g}") for number in numbers)]


def known_to_the_oracle(view):
    """Return what independent methods compute: how the drawn γ turns, the trace of a circle map, cos χ."""
    map_, found = getattr(view.result, "map", None), {}
    orbit = view.data.get("data-orbit", {})
    if {"t", "g1", "g2", "g3"} <= set(orbit):
        t, *gamma = (np.asarray(orbit[name], float) for name in ("t", "g1", "g2", "g3"))
        if np.linalg.norm(np.diff(gamma), axis=0).max() < SPARSE:
            found["turned"] = cosines(np.column_stack([np.interp(moments(t[-1]), t, one) for one in gamma]))
    if isinstance(map_, CircleMap):
        found["trace"] = counted([map_.trace], 1)
    if isinstance(map_, Scattering):
        found["cos χ"] = counted(view.quantities("cos χ = #"), 1)
    return found


def moments(end):
    return end * MOMENTS


def cosines(gamma):
    """Return the cosines of the angles between γ (n, 3) at the moments and at first; chords are shorter than γ."""
    gamma = gamma / np.linalg.norm(gamma, axis=1)[:, None]
    return counted(gamma @ gamma[0], len(gamma))


def as_text(presets):
    """Return JSON with a line for each text and each source of each preset, by scene."""
    return written(presets, 3) + "\n"


def written(tree, depth):
    if not depth:
        return json.dumps(tree, ensure_ascii=False, separators=(",", ":"))
    return (
        "{\n"
        + ",\n".join(f"{json.dumps(key, ensure_ascii=False)}:{written(tree[key], depth - 1)}" for key in tree)
        + "}"
    )


# ---- one record of several runs ---------------------------------------------------------------------------------


def settled(runs):
    """Return what runs agree about: records, or parts of them; None and # stand for the rest."""
    first = runs[0]
    if isinstance(first, dict):
        return {key: settled([one.get(key) for one in runs]) for key in first}
    if not all(type(one) is type(first) for one in runs):
        return None
    if isinstance(first, str):
        return settled_text(runs)
    if len({(len(one), type(one[0])) for one in runs}) > 1:
        return None
    if isinstance(first[0], str):
        return [settled_text(texts) for texts in zip(*runs, strict=True)]
    within = STABLE * size_of(*runs)
    counts, *numbers = zip(*runs, strict=True)
    return [
        counts[0] if len(set(counts)) == 1 else None,
        *(row[0] if max(row) - min(row) <= within else None for row in numbers),
    ]


def settled_text(texts):
    """Return the first text with # for each number that differs between them or is an error; None if words differ."""
    if len({DIGITS.sub("#", one) for one in texts}) > 1:
        return None
    numbers = [set(same) for same in zip(*map(DIGITS.findall, texts), strict=True)]
    plain = iter(["#" if len(same) > 1 or is_round_off(*same) else same.pop() for same in numbers])
    return DIGITS.sub(lambda _: next(plain), texts[0])


def is_round_off(text):
    return "e−" in text and 0.0 < abs(number_of(text)) < ROUND_OFF


def number_of(text):
    return float(text.replace("−", "-").replace(",", ""))


def size_of(*columns):
    """Return the largest number of columns, apart from their counts."""
    return max((abs(one) for _, *numbers in columns for one in numbers if one is not None), default=0.0)


# ---- a record and another run -----------------------------------------------------------------------------------


def differences(expected, found, name=""):
    """Yield the places where a run differs from a record, with both values."""
    if isinstance(expected, dict):
        for key in expected | found:
            # It may be there or not.
            if expected.get(key, "") is None:
                continue
            if key not in found or key not in expected:
                yield f"{name} {key}: {'missing' if key in expected else 'not in the record'}"
            else:
                yield from differences(expected[key], found[key], f"{name} {key}")
    elif not are_alike(expected, found):
        yield f"{name}: {expected!r} ≠ {found!r}"


def are_alike(expected, found):
    """Return whether a text or a column is that of the record, as far as the record has it."""
    if expected is None:
        return True
    if isinstance(expected, str) or isinstance(found, str):
        return type(expected) is type(found) and are_texts_alike(expected, found)
    if len(expected) != len(found):
        return False
    if isinstance(expected[0], str | None) and isinstance(found[0], str):
        return all(map(are_alike, expected, found))
    (count, *numbers), (own, *others) = expected, found
    within = max(PIXEL * size_of(expected, found), NOTHING)
    if count not in (None, own):
        if count <= FEW or abs(count - own) > count / 20:
            return False
        # The mean depends on where the samples are.
        numbers = numbers[:2]
    return all(one is None or abs(one - other) <= within for one, other in zip(numbers, others, strict=False))


def are_texts_alike(expected, found):
    """Return whether words are the same, and numbers to a thousandth or a unit of their last digit."""
    pairs = zip(DIGITS.findall(expected), DIGITS.findall(found), strict=True)
    return DIGITS.sub("#", expected) == DIGITS.sub("#", found) and all(
        one in ("#", other) or ("." in one and abs(number_of(one) - number_of(other)) <= uncertainty(one))
        for one, other in pairs
    )


def uncertainty(text):
    """Return by how much a decimal number of a text may differ; one of three digits or more also in its last digit."""
    mantissa, _, exponent = text.partition("e")
    last = 10.0 ** (number_of(exponent or "0") - len(mantissa.partition(".")[2]))
    return max(PIXEL * abs(number_of(text)), 1.01 * last if len(re.sub(r"\D", "", mantissa).lstrip("0")) > 2 else 0.0)
