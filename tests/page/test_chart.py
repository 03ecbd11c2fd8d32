"""A chart beside the pictures: started, pointed at, clicked in, zoomed, stopped, saved and loaded."""

import json
from pathlib import Path
from urllib.parse import parse_qsl, urlsplit

import numpy as np
from playwright.sync_api import expect
from pytest import approx

from hess_explorer.sweep import read
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


def test_a_chart_from_its_start_to_its_file(explorer):
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
    assert [float(reached[name]) for name in "hf"] == approx([h[31], f[31]], abs=1e-15)
    assert {**reached, "h": "1.5", "f": "0.6"} == dict(parse_qsl(urlsplit(before).query))
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
    page.keyboard.press("Escape")
    # Python reads it as it reads sweeps.
    assert np.array_equal(read(path).rotation_number.values.T, values, equal_nan=True)


def test_a_chart_of_categories_names_them(explorer):
    """Locked tori have two limit cycles; the file keeps the names."""
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
    page.keyboard.press("Escape")
