"""Strips of states: packed here, decoded by the page's module in Node, compared with what went in."""

import json
import subprocess
from pathlib import Path

import numpy as np

from hess_explorer.offline.strips import EXACT, PIXELS, OfflineStrip, steps_of_plots
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.views.layers import Axes
from hess_explorer.views.plot import Plot

DECODE = Path(__file__).parent / "decode.mjs"


def decoded(strip, folder):
    path = folder / "strip"
    path.write_bytes(strip.pack())
    words = ["node", "--disable-warning=MODULE_TYPELESS_PACKAGE_JSON", DECODE, path]
    return json.loads(subprocess.run(words, capture_output=True, timeout=60, check=True).stdout)


def numbers(column):
    return np.array([float(one) for one in column])


def add(strip, steps=None, **sources):
    """Append a state with these sources."""
    wire = Wire()
    for name, columns in sources.items():
        wire.put(name, columns)
    wire.set_text("status", "λ = 1")
    strip.add(*wire.pack(), steps or {})


def test_arrays_come_back_within_half_a_step(tmp_path):
    s = np.linspace(0, 6, 500)
    strip = OfflineStrip()
    curves, step = [], 8.0 / PIXELS
    for h in np.linspace(0.2, 1.0, 12):
        # A curve that leaves its plot by far, one of another length in each state, and a constant one.
        x, y = np.exp(2 * h * s), np.sin(s + h)
        other = np.cos(np.linspace(0, 6, 300 + int(100 * h)))
        curves.append((x, y, other))
        add(
            strip,
            {"plot": {"x": step, "y": step, "z": step}},
            plot={"x": x, "y": y, "z": 1e9 * x},
            orbit={"g": other},
            still={"c": np.full(50, 0.3)},
        )
    found = decoded(strip, tmp_path)
    assert [one["texts"]["status"] for one in found] == ["λ = 1"] * 12
    for (x, y, other), one in zip(curves, found, strict=True):
        back = one["sources"]
        assert np.abs(numbers(back["plot"]["y"]) - y).max() <= 0.51 * step
        assert np.array_equal(numbers(back["plot"]["z"]), (1e9 * x).astype(np.float32))
        # Far outside, single precision is coarser than the step.
        assert np.all(np.abs(numbers(back["plot"]["x"]) - x) <= 0.51 * step + 1e-6 * np.abs(x))
        assert np.abs(numbers(back["orbit"]["g"]) - other).max() <= 2.0 / 2**17
        assert np.allclose(numbers(back["still"]["c"]), 0.3, rtol=1e-6)
    # Neighbouring states share most of their bits: single precision takes 4 bytes a number.
    assert len(strip.pack()) < 2 * sum(3 * len(x) + len(other) for x, _, other in curves)


def test_gaps_whole_numbers_images_and_logarithmic_axes_are_exact(tmp_path):
    gaps = np.array([1.0, np.nan, 3.5, np.nan, *np.linspace(0, 1, 20)])
    image = np.tile(np.arange(256.0), (4, 1))
    decades = np.geomspace(1e-16, 1e3, 40)
    strip = OfflineStrip()
    for shift in (0.0, 1.0):
        add(
            strip,
            {"log": {"x": EXACT}},
            curve={"y": gaps + shift, "empty": np.empty(0)},
            picture={"image": [image + shift]},
            log={"x": decades * (1 + shift)},
            single={"text": ["γ"]},
            far={"x": np.array([np.inf, -2.5, 0.0])},
        )
    for shift, one in zip((0.0, 1.0), decoded(strip, tmp_path), strict=True):
        back = one["sources"]
        y = numbers(back["curve"]["y"])
        assert np.array_equal(np.isnan(y), np.isnan(gaps))
        assert np.nanmax(np.abs(y - gaps - shift)) <= 2.5 / 2**17
        assert back["curve"]["empty"] == []
        (grid,) = back["picture"]["image"]
        assert (grid["rows"], grid["columns"]) == (4, 256)
        assert np.array_equal(numbers(grid["numbers"]), (image + shift).ravel())
        assert np.array_equal(numbers(back["log"]["x"]), (decades * (1 + shift)).astype(np.float32))
        assert back["single"]["text"] == ["γ"]
        assert np.array_equal(numbers(back["far"]["x"]), [np.inf, -2.5, 0.0])


def test_a_column_of_several_plots_has_the_smallest_of_their_steps():
    scene = scenes()["suslov-hess"]
    plots = {view.name: view for view in scene.views if isinstance(view, Plot)}
    wide, narrow = Axes((-4.0, 4.0), (-8.0, 8.0)), Axes((-1.0, 1.0), (-1.0, 1.0))
    steps = steps_of_plots([(plots["omega"], wide)])["data-orbit"]
    assert steps == {"omega1": 8.0 / PIXELS, "omega2": 16.0 / PIXELS}
    steps = steps_of_plots([(plots["omega"], wide), (plots["omega"], narrow)])["data-orbit"]
    assert steps == {"omega1": 2.0 / PIXELS, "omega2": 2.0 / PIXELS}
