"""The body of the orbit on show: a rigid body's ellipsoid, wheels that obey the constraint, and how it lies."""

import numpy as np
import pytest
from pytest import approx

from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.solid_body import ellipsoid_of_inertia, free_I33
from hess_mechanics.rigid_body.inertia import check_body
from support.captions import as_text

SCENES = {name: scene for name, scene in scenes().items() if "body" in scene.pictures}
WITH_WHEELS = [name for name, scene in SCENES.items() if any(getattr(view, "wheels", None) for view in scene.views)]


def body_of(name, preset):
    """The columns of the body, and the caption of its picture."""
    scene = scenes()[name]
    values, _ = scene.admit({**scene.defaults(), **scene.example(preset)})
    state = scene.compute(values, ("body", "sphere") if "sphere" in scene.pictures else ("body",), False)
    view = next(view for view in scene.views if view.name == "body")
    return state, state.drawn["body"], as_text(view.full_caption(state))


@pytest.mark.parametrize("name", WITH_WHEELS)
def test_every_example_of_a_constrained_body_is_drawn_as_it_lies(name):
    for preset in scenes()[name].presets:
        state, body, _ = body_of(name, preset)
        if "t" not in body:
            assert preset.name.endswith("(not a rigid body)")
            continue
        g, e = (np.stack([body[f"{letter}{k}"] for k in (1, 2, 3)], axis=1) for letter in "ge")
        assert np.linalg.norm(g, axis=1) == approx(1.0, abs=1e-6)
        assert np.sum(g * e, axis=1) == approx(0.0, abs=1e-6)
        orbit = state.drawn.get("data-orbit", {})
        if "g1" in orbit:
            # So long a motion turns by 0.4 radians from one of its samples to the next.
            sagitta = 0.03 if preset.name.startswith("Started 1e-300") else 6e-3
            for k in (1, 2, 3):
                assert np.interp(body["t"], orbit["t"], orbit[f"g{k}"]) == approx(body[f"g{k}"], abs=sagitta)
        # A wheel rolls along e.
        at, axis = np.array(body["wheels"][:3]), np.array(body["wheels"][3:6])
        assert (at @ at, axis @ axis, at @ axis) == approx((1.0, 1.0, 0.0), abs=1e-12)
        assert axis == approx([0.0, 0.0, 1.0])
        # The arc is the path of the contact point in space, between samples a little longer than its chord.
        contact = np.stack([g @ at, e @ at, np.cross(g, e) @ at], axis=1)
        chords = 2.0 * np.arcsin(0.5 * np.linalg.norm(np.diff(contact, axis=0), axis=1))
        assert np.abs(np.diff(body["arc"])) == approx(chords, rel=0.06, abs=2e-3)


@pytest.mark.parametrize(
    "tensor, is_body",
    [((2.0, 1.0, 0.3, 0.2), True), ((1.0, 2.5, 0.6, 0.6), False), ((0.1, 10.0, 9.0, -10.0), False)],
)
def test_the_ellipsoid_is_that_of_a_rigid_body_where_there_is_one(tensor, is_body):
    I11, I22, I13, I23 = tensor
    shape, said = ellipsoid_of_inertia(tensor, check_body(*tensor))
    whole = np.array([[I11, 0.0, I13], [0.0, I22, I23], [I13, I23, free_I33(tensor, check_body(*tensor))]])
    # The drawn surface is (ω, Iω) = const.
    for axis, half in zip(shape.axes, shape.semi_axes, strict=True):
        if half > 1.01 * min(shape.semi_axes):
            assert half**2 * (axis @ whole @ axis) == approx(0.64 * shape.moments.min(), rel=1e-6)
    assert np.all(shape.moments > 0.0)
    moments = np.sort(shape.moments)
    assert (moments[2] <= moments[0] + moments[1]) == is_body
    assert (said.verdict == "Not a rigid body.") != is_body
