"""The scenes of the principal axis in a browser: examples, a slider, clicks, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest

from hess_explorer.scenes.framework.periodic_search import NONE
from hess_mechanics.suslov.kharlamova import PlaneBody, arc, state_at
from support.kharlamova import ARC, POINT
from support.page import brought, chosen, flat, said
from support.painted import SOURCES, assert_painted
from support.pointer import click_on
from support.thorough import sample


@pytest.fixture
def arcs(tab):
    yield brought(tab, ARC)
    tab.assert_quiet()


@pytest.fixture
def point(tab):
    yield brought(tab, POINT)
    tab.assert_quiet()


def arc_of(values):
    body = PlaneBody(*(values[name] for name in ("I11", "I22", "b1", "b2")))
    p = (values["p"] * math.cos(values["alpha"]), values["p"] * math.sin(values["alpha"]))
    return arc(body, state_at(body, (values["q1"], values["q2"]), p))


@pytest.mark.parametrize("preset", sample(ARC.presets, 3), ids=lambda preset: preset.name)
def test_an_example_of_b3_0_is_drawn_with_the_numbers_of_its_captions(arcs, preset):
    found = arc_of(chosen(arcs, ARC, preset))
    if found.kind == "periodic":
        assert said(arcs, "domain", "back and forth. T = #.") == [pytest.approx(found.period, rel=6e-6)]
    else:
        assert {"asymptotic": "touches the edge", "fixed": "A stable fixed point" if found.stable else "fixed point"}[
            found.kind
        ] in arcs.caption("domain")
    # On the oval, with the mirror image upside down.
    orbit = {name: np.array(column) for name, column in arcs.data("data-orbit").items()}
    for tau, g3 in (("tau", "g3"), ("mirror_tau", "mirror_g3")):
        assert np.abs(orbit[g3]) == pytest.approx(found.height(orbit[tau]), abs=3e-3)
    assert_painted(arcs, ARC)


@pytest.mark.parametrize("preset", sample(POINT.presets, 3), ids=lambda preset: preset.name)
def test_an_example_of_the_quartic_potential_is_drawn_with_the_numbers_of_its_captions(point, preset):
    values = chosen(point, POINT, preset)
    I22, size = values["I22"], abs(values["b3"])
    reach = math.sqrt(2.0 * (values["h"] + size)) / size
    assert said(point, "domain", "half axes # and #") == pytest.approx(
        [reach * math.sqrt(I22), reach * math.sqrt(values["ratio"] * I22)], rel=6e-4
    )
    if values["periodic"] == NONE:
        points, _ = said(point, "section", "Chosen orbit: # points in #")
        assert points == len(point.data("section-own")["x"])
    else:
        # An elliptic orbit of a map that keeps area: |μ| = 1.
        assert np.hypot(*said(point, "section", "Period 1, elliptic. Multipliers μ = # ± #i")) == pytest.approx(
            1.0, abs=2e-4
        )
    assert_painted(point, POINT)


def test_a_slider_of_the_direction_moves_the_orbit_and_its_period(arcs):
    arcs.change(lambda: arcs.slide(alpha=1.5))
    found = arc_of({**ARC.defaults(), "alpha": 1.5})
    assert said(arcs, "domain", "T = #.") == [pytest.approx(found.period, rel=6e-6)]
    ring = arcs.data("period-chosen")
    assert (ring["x"][0], ring["y"][0]) == pytest.approx((1.5, found.period), rel=1e-5)


def test_a_click_starts_the_orbit_there(arcs, tab):
    unit = click_on(arcs, "domain", -0.4, 0.3)
    assert (arcs.shown("q1")[0], arcs.shown("q2")[0]) == (
        pytest.approx(-0.4, abs=unit[0]),
        pytest.approx(0.3, abs=unit[1]),
    )
    orbit = arcs.data("data-orbit")
    assert (orbit["q1"][0], orbit["q2"][0]) == pytest.approx((arcs.shown("q1")[0], arcs.shown("q2")[0]), abs=1e-6)
    section = brought(tab, POINT)
    unit = click_on(section, "section", 0.7, 0.3)
    # Across the shorter axis: q1 = 0.
    assert section.shown("Q1")[0] == pytest.approx(0.0, abs=1e-9)
    assert section.shown("Q2")[0] == pytest.approx(0.7, abs=unit[0])
    assert section.data("data-orbit")["g2"][0] == pytest.approx(0.3, abs=unit[1])


def test_what_is_no_motion_says_so_and_nothing_stale_stays(point):
    point.change(point.type, "b3", "0")
    assert point.text("status").startswith("b3 = 0: without a field the energy does not determine γ₃.")
    assert point.text("derived") == ""
    for name in point.page.evaluate(SOURCES):
        if not name.endswith("-message"):
            # The names of axes are blanks.
            assert set(flat(point.data(name))) <= ({" "} if name.endswith("-axes") else set()), name
    point.change(point.page.locator(".param-reset").click)
    assert len(point.data("section-own")["x"]) == POINT.defaults()["count"]
