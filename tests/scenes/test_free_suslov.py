"""The scenes "free Suslov problem" and "scattering": captions are those of the model, and clicks choose."""

from math import cos, log, sqrt

import pytest
from pytest import approx

from hess_explorer.views.text import digits
from support.free_suslov import (
    FREE,
    SCATTERING,
    energy,
    shown,
    tensor_of,
)
from support.view import View

every_free = pytest.mark.parametrize("preset", FREE.presets, ids=lambda preset: preset.name)
# ---- the free Suslov problem ------------------------------------------------------------------------------------


@every_free
def test_captions_circles_and_points_are_those_of_the_model(preset):
    view = View(FREE, preset.values)
    state, points = view.result, view.result.points
    assert view.numbers("omega", "Rate ω₀ = #, E = #.") == shown([points.rate, energy(view.values)])
    assert view.numbers("gamma1", "At # radians per unit of time") == shown([points.speed])
    assert view.quantities("I₁₁ = #") == shown([tensor_of(view.values)[0]])
    for name, point in (("stable", points.stable), ("unstable", points.unstable)):
        assert view.columns(f"omega-{name}-point", "x", "y")[0] == approx(point, rel=1e-6)
    # Both leave one circle, where they turn alike, φ′ − φ apart.
    (came, went), (also, other) = state.orbit.limits, state.second.limits
    assert also == approx(came, abs=1e-6)
    assert view.numbers("Gamma", "From Γ⁻ = # to Γ⁺ = # and # (dotted)") == shown([came, went, other])
    heights = [height for *_, height, look in view.data["sphere"]["circles"] if look != "muted"]
    assert heights == shown([came, went, other])


def test_a_passage_beyond_the_time_span_is_announced_where_it_comes():
    view = View(FREE, {"w2": 1e-300})
    # ω2 = √(I11/I22) ω1 = 3.12 at the top of the ellipse, after growing as e^t and then as 1/cosh: half of 2 · 3.12.
    t = log(2.0 * sqrt(2.44) * 2.0) + 300.0 * log(10.0)
    assert view.report.notes == [f"The passage comes at t = {digits(t)}: choose a longer time span to see it."]


# ---- scattering -------------------------------------------------------------------------------------------------


def test_next_to_a_slanting_line_the_start_is_as_close_as_a_double_can_tell():
    # Where the sphere agrees with the position of the ring to less than a pixel; on an axis nothing is in the way.
    for values, digits_, within in (({"I13": 0.3, "I23": 0.5}, 12.0, 1e-3), ({}, 300.0, 1e-6)):
        view = View(SCATTERING, {**values, "digits": 300.0}, noted=True)
        assert view.values["digits"] == digits_
        assert ["1e−12" in note for note in view.notes] == [True] * bool(values)
        assert view.result.orbit.limits[1] == approx(cos(view.result.theta_plus), abs=within)


@pytest.mark.parametrize(
    "scene, picture, picked",
    [
        (FREE, "omega", {"w1": 0.25, "w2": 1.5}),
        (SCATTERING, "map", {"phi": 0.25, "theta": 1.5}),
        (SCATTERING, "chi", {"k": 0.25}),
        (SCATTERING, "sphere", {}),
    ],
)
def test_a_click_chooses_what_its_axes_say(scene, picture, picked):
    assert View(scene, {}).stage.pick(picture, 0.25, 1.5) == picked
