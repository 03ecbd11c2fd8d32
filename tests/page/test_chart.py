"""A chart beside the pictures: started, pointed at, clicked in, zoomed, stopped, saved and loaded."""

import json
import math
from pathlib import Path
from urllib.parse import parse_qsl, urlsplit

import numpy as np
from playwright.sync_api import expect
from pytest import approx

from hess_explorer.sweep import read
from hess_explorer.sweep.work import version
from hess_mechanics.numerics.accuracy import level
from hess_mechanics.suslov_hess.rotation_number import values_at
from support.accessible import assert_accessible

A = 0.28 / 0.96
"""a = I23/I22 of the first state."""


def rotation_numbers(h, f):
    """By the mechanics, called by hand: (rows, columns), NaN where no motion is possible."""
    hs, fs = np.meshgrid(h, f)
    found = values_at(np.full(hs.size, A), hs.ravel(), fs.ravel(), level("standard"))
    return np.where(found.possible, found.rho, np.nan).reshape(hs.shape)


def saved(page, panel):
    with page.expect_download() as download:
        panel.locator(".param-chart-save").click()
    return Path(download.value.path()), download.value.suggested_filename


def numbers(path):
    """Sides and numbers of a file."""
    file = json.loads(path.read_text(encoding="utf-8"))
    sides = [np.linspace(side["low"], side["high"], side["count"]) for side in (file["x"], file["y"])]
    values = np.array([np.nan if value is None else value for value in file["values"]])
    return file, sides, values.reshape(sides[1].size, sides[0].size), np.array(file["status"])


def test_a_chart_from_its_start_to_its_file(explorer, tmp_path):
    page = explorer.page
    before = explorer.link()
    explorer.picture("bifurcation").hover()
    page.get_by_role("button", name="Chart").click()
    panel = page.get_by_role("dialog", name="Chart")
    # The default is the quantity of the picture under the mouse, over its axes.
    assert panel.locator(".param-quantity").input_value() == "rotation-number"
    assert (panel.locator(".param-x").input_value(), panel.locator(".param-y").input_value()) == ("h", "f")
    _, x1, y0, _ = explorer.axes("bifurcation")
    assert float(panel.locator(".param-x-to").input_value()) == approx(x1, rel=1e-5)
    assert float(panel.locator(".param-y-from").input_value()) == approx(y0, rel=1e-5)
    for side, ends in (("x", (-0.9, 2.1)), ("y", (-1.5, 1.5))):
        for what, value in (("from", ends[0]), ("to", ends[1]), ("cells", 61)):
            panel.locator(f".param-{side}-{what}").fill(str(value))
    said, canvas, reading = panel.locator(".why"), panel.locator("canvas"), panel.locator(".reading")
    panel.locator(".param-chart-start").click()
    expect(said).to_have_text("61 × 61, standard accuracy. ")
    # Every number is that of the mechanics; where there is none, no motion is possible.
    path, name = saved(page, panel)
    assert name == "suslov-hess-rotation-number-h-f.json"
    file, (h, f), values, status = numbers(path)
    assert np.array_equal(values, rotation_numbers(h, f), equal_nan=True)
    assert np.array_equal(np.isnan(values.ravel()), status >= 10) and (status > 0).all()
    assert_accessible(page, panel)
    # By keys: the middle of the chart, then its state, as one change.
    canvas.focus()
    page.keyboard.press("ArrowRight")
    expect(reading).to_have_text(f"h = {h[31]:g}, f = 0: ρ = {values[30, 31]:.6g} turns per return".replace("-", "−"))
    page.keyboard.press("ArrowUp")
    explorer.change(lambda: page.keyboard.press("Enter"))
    reached = dict(parse_qsl(urlsplit(explorer.link()).query))
    wanted = {**dict(parse_qsl(urlsplit(before).query)), "h": h[31], "f": f[31]}
    assert reached.keys() == wanted.keys()
    for key, value in wanted.items():
        assert (reached[key] if isinstance(value, str) else float(reached[key])) == (
            value if isinstance(value, str) else approx(value, abs=1e-15)
        )
    explorer.change(lambda: page.locator(".param-undo").click())
    assert explorer.link() == before
    # The server reports places where no motion is possible.
    canvas.focus()
    page.keyboard.press("Escape")
    assert not panel.is_visible()
    page.get_by_role("button", name="Chart").click()
    box = canvas.bounding_box()
    left, top = box["x"] + 0.18 * box["width"], box["y"] + 0.1 * box["height"]
    page.mouse.move(left, top)
    expect(reading).to_contain_text("no such motion.")
    # A box is computed closer, and the one before comes back.
    page.mouse.down()
    page.mouse.move(left + 100, top + 100, steps=3)
    page.mouse.up()
    expect(panel.locator(".param-chart-out")).to_be_enabled()
    expect(said).to_have_text("61 × 61, standard accuracy. ")
    _, (closer_h, closer_f), closer, _ = numbers(saved(page, panel)[0])
    assert closer_h[0] > h[0] and closer_h[-1] < h[-1] and closer_f[0] > f[0] and closer_f[-1] <= f[-1]
    assert np.array_equal(closer, rotation_numbers(closer_h, closer_f), equal_nan=True)
    canvas.focus()
    page.keyboard.press("-")
    assert numbers(saved(page, panel)[0])[0] == file
    # One that takes long goes on in another scene, says so in the bar, and is stopped.
    panel.locator(".param-quantity").select_option("critical-a")
    for side in "xy":
        panel.locator(f".param-{side}-cells").fill("256")
    panel.locator(".param-chart-start").click()
    page.keyboard.press("Escape")
    explorer.change(lambda: page.evaluate("hess.tell('scene', 'kharlamova')"))
    button = page.locator(".param-chart")
    expect(button).to_contain_text("%")
    button.click()
    panel.locator(".param-chart-stop").click()
    expect(said).to_contain_text("Stopped.")
    expect(button).to_have_text("Chart")
    _, _, _, status = numbers(saved(page, panel)[0])
    assert (status == 0).any() and (status > 0).any()
    # A saved chart is shown again, here too; a click opens its scene.
    panel.locator("input[type=file]").set_input_files(path)
    expect(said).to_have_text("61 × 61, standard accuracy. ")
    assert numbers(saved(page, panel)[0])[0] == file
    canvas.focus()
    page.keyboard.press("ArrowRight")
    explorer.change(lambda: page.keyboard.press("Enter"))
    assert explorer.link().partition("h=")[0] == before.partition("h=")[0]
    # A file that holds something else is told, and changes nothing.
    for text, why in (
        ("{", "is not JSON"),
        ("[]", "is not a chart"),
        (json.dumps({**file, "values": [1]}), "is missing"),
        (json.dumps({**file, "x": {**file["x"], "count": 10**9}}), "is missing"),
    ):
        (tmp_path / "other.json").write_text(text, encoding="utf-8")
        panel.locator("input[type=file]").set_input_files(tmp_path / "other.json")
        expect(said).to_contain_text(why)
    assert numbers(saved(page, panel)[0])[0] == file
    page.keyboard.press("Escape")
    # Python reads it as it reads sweeps.
    found = read(path)
    assert np.array_equal(found.rotation_number.values.T, values, equal_nan=True)
    assert np.array_equal(found.h.values, h) and found.attrs["version"] == version()
    # Over a section: where the motion starts, of which a click leaves one.
    explorer.change(lambda: page.evaluate("hess.tell('restore', 'scene=suslov&accuracy=draft&starts=0.5,0.5;1,1')"))
    explorer.picture("section").hover()
    page.get_by_role("button", name="Chart").click()
    assert panel.locator(".param-quantity").input_value() == "megno-suslov"
    assert panel.locator(".param-x option:checked").text_content() == "ψ"
    assert panel.locator(".param-y option:checked").text_content() == "δ"
    for side in "xy":
        panel.locator(f".param-{side}-cells").fill("7")
    panel.locator(".param-chart-start").click()
    expect(said).to_have_text("7 × 7, draft accuracy. ")
    path, name = saved(page, panel)
    assert name == "suslov-megno-suslov-ψ-δ.json"
    found = read(path)
    psi, delta = (found[name].values for name in found.megno_suslov.dims)
    assert (psi[0], delta[-1]) == approx((-math.pi, math.pi), abs=1e-4)
    canvas.focus()
    page.keyboard.press("ArrowRight")
    explorer.change(lambda: page.keyboard.press("Enter"))
    (start,) = dict(parse_qsl(urlsplit(explorer.link()).query))["starts"].split(";")
    place = [*map(float, start.split(","))]
    i, j = (int(np.abs(axis - x).argmin()) for axis, x in zip((psi, delta), place, strict=True))
    assert place == approx([psi[i], delta[j]], abs=1e-9)
    expect(reading).to_contain_text(f"Ȳ = {found.megno_suslov.values[i, j]:.6g}".replace("-", "−"))
    page.keyboard.press("Escape")


def test_a_chart_of_categories_names_them(explorer, tmp_path):
    """Locked tori have two limit cycles; the file keeps the names, and one of an earlier version has numbers."""
    page = explorer.page
    page.get_by_role("button", name="Chart").click()
    panel = page.get_by_role("dialog", name="Chart")
    said, canvas, reading = panel.locator(".why"), panel.locator("canvas"), panel.locator(".reading")
    panel.locator(".param-quantity").select_option("locked")
    for side, low, high in (("x", 0.2, 3.8), ("y", -1.0, 1.0)):
        for what, value in (("from", low), ("to", high), ("cells", 3)):
            panel.locator(f".param-{side}-{what}").fill(str(value))
    panel.locator(".param-chart-start").click()
    expect(said).to_have_text("3 × 3, standard accuracy. ")
    path, _ = saved(page, panel)
    file, (h, f), values, _ = numbers(path)
    assert file["symbol"] == "locked"
    names = {0.0: "no limit cycle", 1.0: "two limit cycles"}
    assert {int(value): name for value, name in file["names"]} == names
    assert set(values.ravel()) == set(names), "the chart shows both"
    canvas.focus()
    page.keyboard.press("ArrowRight")
    expect(reading).to_have_text(f"h = {h[2]:g}, f = {f[1]:g}: {names[values[1, 2]]}".replace("-", "−"))
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowLeft")
    expect(reading).to_contain_text(names[values[1, 0]])
    earlier = tmp_path / "earlier.json"
    for text, why in (
        (json.dumps({**file, "names": [[0]]}), "is missing"),
        (json.dumps({**file, "names": 5}), "is missing"),
        (json.dumps({key: value for key, value in file.items() if key != "names"}), "3 × 3"),
    ):
        earlier.write_text(text, encoding="utf-8")
        panel.locator("input[type=file]").set_input_files(earlier)
        expect(said).to_contain_text(why)
    canvas.focus()
    page.keyboard.press("ArrowRight")
    expect(reading).to_contain_text(f"locked = {values[1, 2]:g}")
    page.keyboard.press("Escape")
