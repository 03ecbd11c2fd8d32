"""Bodies and clouds in figures, at the time and the turn of the link: against closed forms and SciPy."""

from math import cos, exp, floor, log, pi, sin

import numpy as np
import pytest
from hess_explorer.export.moment import clouds_at, density_at
from hess_explorer.export.sphere_canvas import seen
from hess_explorer.export.torus import sides
from matplotlib.colors import to_hex
from matplotlib.patches import Circle
from pytest import approx

from hess_explorer.export import revolved, solid
from hess_explorer.export.figure import draw
from hess_explorer.export.picture_data import picture_data
from support.ball import TENSOR, rates
from support.mechanics import followed
from support.suslov import HESS_BODY, field
from support.view import STATE

DRAFT = "accuracy=draft"
BODY = "I22=0.96&I23=0.28&b3=-1&h=1.5&f=0.6&phi0=0.5&span=10&accuracy=reference"
AXES = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
SEMI = np.array([0.8, 0.5, 0.3])


def on_surface(count=20_000):
    """Points of the ellipsoid's surface in the view, (count, 3)."""
    directions = np.random.default_rng(6).normal(size=(count, 3))
    return (directions / np.linalg.norm(directions, axis=1, keepdims=True) * SEMI) @ AXES


def test_the_outline_of_an_ellipsoid_is_the_edge_of_its_points():
    a, b, angle = solid.outline(AXES, SEMI)
    x, y, _ = on_surface().T
    c, s = cos(angle), sin(angle)
    reach = np.hypot((c * x + s * y) / a, (c * y - s * x) / b)
    assert reach.max() <= 1.0 + 1e-12
    # And it touches them all round.
    turns = np.floor((np.arctan2(c * y - s * x, c * x + s * y) + pi) / (pi / 6.0)).astype(int) % 12
    assert min(reach[turns == k].max() for k in range(12)) > 0.999
    assert solid.covers(AXES, SEMI, 0.9 * a * c, 0.9 * a * s)
    assert not solid.covers(AXES, SEMI, 1.1 * a * c, 1.1 * a * s)
    for point in on_surface(20):
        at, _ = solid.leaves(AXES, SEMI, 3.0 * point)
        assert at == approx(1.0 / 3.0)


def test_the_shading_is_that_of_the_surface_that_is_seen_and_no_other():
    side = 64
    colours, width, height = solid.shaded(AXES, SEMI, ("#FF0000", "#0000FF"), side)
    points = on_surface(200_000)
    # In each pixel, the point nearest to the viewer.
    columns, rows = ((points[:, i] / half + 1.0) * side / 2.0 for i, half in ((0, width), (1, height)))
    assert max(columns.max(), rows.max()) <= side * (1.0 + 1e-9)
    order = np.argsort(points[:, 2])
    nearest = np.full((side, side), -1)
    nearest[np.minimum(rows[order].astype(int), side - 1), np.minimum(columns[order].astype(int), side - 1)] = order
    signs = np.prod(np.sign(points @ AXES.T), axis=1)
    inside = nearest >= 0
    even = colours[..., 0] > colours[..., 2]
    # All but the pixels at the borders of octants.
    assert np.mean(even[inside] == (signs[nearest[inside]] > 0)) > 0.93
    assert colours.min() >= 0.0
    assert colours.max() <= 1.0


@pytest.mark.parametrize("t", [0.0, 10.0])
def test_the_centre_of_mass_is_where_the_motion_has_it(t):
    """Seen along the axis y of the picture: to the right r·e, e fixed in space, upwards −r·γ."""
    found = picture_data(f"{BODY}&t={t}&az={-0.5 * pi}&el=0", "body")
    b = np.array([HESS_BODY.b1, HESS_BODY.b2, HESS_BODY.b3])
    r = -b / np.linalg.norm(b)

    def right_side(_, y):
        return [*field(HESS_BODY, y[:5]), *np.cross(y[5:], [y[0], y[1], 0.0])]

    track, own = found.columns["data-orbit"], found.columns["body"]
    start = [
        *(track[name][0] for name in STATE),
        *(own[name][0] for name in ("e1", "e2", "e3")),
    ]
    end = followed(right_side, start, [t])[0] if t else np.array(start)
    gamma, e = end[2:5], end[5:]
    discs = [patch for patch in draw(found).axes[0].patches if isinstance(patch, Circle)]
    # Weights have another edge.
    (mass,) = (one for one in discs if one.radius > 0.05 and to_hex(one.get_edgecolor()) != "#39424d")
    # The track and the attitude are sampled for half a pixel.
    assert mass.center == approx((r @ e, -r @ gamma), abs=2e-3)


def test_clouds_between_two_frames_are_where_the_motion_takes_them():
    found = picture_data("scene=singular-measures&points=1000&accuracy=precise", "omega")
    columns = found.columns["omega"]
    times = columns["times"]
    before, after = float(times[3]), float(times[4])
    middle = 0.5 * (before + after)
    (start,), (there,) = clouds_at(columns, before), clouds_at(columns, middle)
    right_side = rates(dict(zip((*TENSOR, "b"), columns["body"], strict=True)))
    for i in range(0, 1000, 97):
        (exact,) = followed(right_side, [*start.omega[i], *start.gamma[i]], [middle - before])
        # To a pixel of pictures 600 pixels wide.
        assert there.omega[i] == approx(exact[:2], abs=columns["half"] / 300.0)
        assert there.gamma[i] == approx(exact[2:], abs=1.0 / 300.0)
    s = np.abs(there.omega @ columns["body"][2:4])
    assert s == approx(np.exp(there.log_s), rel=1e-9)
    at, share = density_at(columns, middle)
    first, wide, _ = columns["bins"]
    for x, y in zip(at, share, strict=True):
        k = floor((log(x) - first) / wide)
        low, high = exp(first + k * wide), exp(first + (k + 1) * wide)
        assert y * wide * x * 1000 == approx(np.sum((s >= low) & (s < high)), abs=1e-6)


# --- The torus in space ---------------------------------------------------------------------------------------

ANGLES = np.linspace(0.0, 2.0 * pi, 65)
RING = {"radius": 0.6 - 0.3 * np.cos(ANGLES), "height": 0.3 * np.sin(ANGLES)}
"""A torus with round cross-sections, from its inner equator."""
VIEWS = [(0.6, 0.35), (-2.0, -1.2)]


def on_ring(count=200_000):
    """Points of its surface, (count, 3), and the outward normals there."""
    phi, theta = np.random.default_rng(7).uniform(0.0, 2.0 * pi, (2, count))
    normals = np.column_stack([-np.cos(theta) * np.cos(phi), -np.cos(theta) * np.sin(phi), np.sin(theta)])
    axis = 0.6 * np.column_stack([np.cos(phi), np.sin(phi), np.zeros(count)])
    return axis + 0.3 * normals, normals


@pytest.mark.parametrize("view", VIEWS)
def test_the_torus_is_painted_where_its_points_are_with_the_inside_behind_the_outside(view):
    side, (points, _) = 64, on_ring()
    tones = (np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    image = revolved.shaded(RING, view, tones, side)
    columns, rows = (((seen(points, *view)[:, i] + 1.0) * side / 2.0).astype(int) for i in (0, 1))
    covered = np.zeros((side, side), bool)
    covered[rows, columns] = True
    painted = image[..., 3] > 0.0
    # A pixel is painted by its centre: only some at the edge are not.
    assert not np.any(painted & ~covered)
    assert painted.sum() > 0.85 * covered.sum()
    red, green, _ = image[painted][:, :3].T
    assert min(red.min(), green.min()) > 0.08
    dense = revolved.shaded({**RING, "re": np.full(65, 0.5), "im": np.zeros(65)}, view, tones, side)
    assert dense[..., 2].max() > image[..., 2].max() + 0.2


@pytest.mark.parametrize("view", VIEWS)
def test_a_point_of_the_torus_is_hidden_if_the_surface_is_before_it(view):
    points, normals = on_ring(2000)
    depth = seen(points, *view)
    found = seen(sides(RING, points, view), *view)[:, 2] > 0.0
    facing = seen(normals, *view)[:, 2]
    # Points that face away are behind their own tube.
    assert not np.any(found & (facing < -0.2))
    # Points that face the viewer are hidden only by the other side of the ring.
    hidden = ~found & (facing > 0.2)
    assert np.all(depth[hidden, 2] < 0.3)
    if abs(view[1]) > 1.0:
        assert not np.any(hidden)
    else:
        assert np.any(hidden)
