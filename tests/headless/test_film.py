"""Films: the frames of the page at given times, whatever the speed of the machine."""

import io
import math
import sys
import tempfile

import numpy as np
import pytest
from PIL import Image
from pytest import approx
from scipy import ndimage

from hess_explorer.export.formats import FileRequest, Loop, formats_of
from hess_explorer.export.motion import period
from hess_explorer.export.picture_data import picture_data
from hess_explorer.headless.film import as_film, frames
from hess_mechanics.errors import ModelError
from support.films import frames_of, tags_of
from support.mechanics import followed
from support.suslov import HESS_BODY, field
from support.view import STATE

pytestmark = pytest.mark.usefixtures("browser")

LINK = "I22=0.96&I23=0.28&b3=-1&h=1.5&f=0.6&phi0=0.5&span=10&accuracy=precise"
SIDE = 480
"""Pixels of a film 60 mm wide."""


@pytest.fixture(scope="module")
def found():
    return picture_data(LINK, "omega")


def box_of(picture):
    """The frame of the plot in pixels: left, right, top, bottom, at the ends of its grey area."""
    grey = np.abs(picture.astype(int) - 0xEC).max(axis=2) < 4
    columns, rows = (np.flatnonzero(grey.mean(axis=axis) > 0.2) for axis in (0, 1))
    return columns.min(), columns.max(), rows.min(), rows.max()


def point_in(picture):
    """The middle of the yellow point, (x, y) in pixels from the left and from above."""
    red, green, blue = picture.astype(int).transpose(2, 0, 1)
    # The largest spot: at the edges of orange lines and letters single pixels are yellow too.
    spots, _ = ndimage.label((red > 190) & (green > 180) & (blue < 140))
    sizes = np.bincount(spots.ravel())[1:]
    assert sizes.max() > 20
    rows, columns = np.nonzero(spots == 1 + np.argmax(sizes))
    return np.median(columns), np.median(rows)


@pytest.mark.parametrize("kind", formats_of("film"))
def test_the_moving_point_is_where_the_orbit_is_and_a_film_is_the_same_every_time(found, kind, tmp_path):
    told = []
    path, request = tmp_path / f"film.{kind}", FileRequest(kind, 60.0, seconds=1.0)
    path.write_bytes(as_film(found, request, lambda *done: told.append(done)))
    assert told == [(i + 1, 25) for i in range(25)]
    pictures = frames_of(path, SIDE)
    assert len(pictures) == 25
    start = [found.columns["data-orbit"][name][0] for name in STATE]
    chosen = np.array([5, 14, 24])
    exact = followed(lambda _, y: field(HESS_BODY, y), start, 10.0 * chosen / 24.0)
    left, right, top, bottom = box_of(pictures[0])
    for i, (w1, w2) in zip(chosen, exact[:, :2], strict=True):
        x, y = point_in(pictures[i])
        (x0, x1), (y0, y1) = found.axes.x, found.axes.y
        # The point is 13 pixels wide; it may be off by one, where the film has its colours for four pixels together.
        assert x == approx(left + (right - left) * (w1 - x0) / (x1 - x0), abs=1.5)
        assert y == approx(bottom - (bottom - top) * (w2 - y0) / (y1 - y0), abs=1.5)
    said = tags_of(path)
    for fact in (found.title, found.link, found.facts["program"], "f = 0.6", "accuracy: precise", "error"):
        assert fact in said
    assert as_film(found, request) == path.read_bytes()


@pytest.mark.parametrize(
    "link, picture", [(LINK, "body"), ("scene=singular-measures&points=1000&accuracy=draft", "density")]
)
def test_a_frame_depends_on_its_time_alone(link, picture):
    shown = picture_data(link, picture)
    request = FileRequest("mp4", 60.0)
    first, later, again, back = frames(shown, request, np.array([0.0, 5.0, 5.0, 0.0]))
    assert (later, back) == (again, first)
    # Not only the clock above the picture.
    start, end = (np.asarray(Image.open(io.BytesIO(one)), int)[SIDE // 8 :] for one in (first, later))
    assert (np.abs(start - end).max(axis=2) > 60).sum() > 100


@pytest.mark.parametrize(
    "link, picture, lasts",
    [("scene=kharlamova", "domain", True), pytest.param(LINK, "body", False, marks=pytest.mark.thorough)],
)
def test_the_end_of_a_loop_meets_its_beginning(link, picture, lasts, tmp_path):
    shown, path = picture_data(link, picture), tmp_path / "loop.mp4"
    path.write_bytes(as_film(shown, FileRequest("mp4", seconds=1.0, loop=Loop(True, "https://example.org/"))))
    drawn = frames_of(path, 1080).astype(int)
    assert len(drawn) == 25
    first, second, middle, last = drawn[[0, 1, 12, -1]]
    assert first[:5, :5].mean() < 40
    # The last frame is as near to the first as the second is, and the middle is another picture.
    step, away, back = (np.abs(one - first).mean() for one in (second, middle, last))
    assert back < 2.0 * step + 0.05
    assert away > 0.1
    assert (period(shown) is not None) == lasts
    if lasts:
        state = shown.columns["data-orbit"]
        for name in ("q1", "q2"):
            assert np.interp(period(shown), state["t"], state[name]) == approx(state[name][0], abs=0.01)


def test_a_film_that_is_stopped_leaves_nothing_behind(found, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))

    def stop(done, of):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        as_film(found, FileRequest("webm", 60.0), stop)
    assert [one.name for one in tmp_path.iterdir() if "playwright" not in one.name] == []


def test_what_cannot_be_filmed_is_refused_with_a_sentence(found, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    for shown, request, said in (
        (found, FileRequest("webm", math.nan), "60 to 160 mm wide"),
        (found, FileRequest("webm", seconds=61.0), "1 to 60 seconds long"),
        (picture_data("scene=scattering&accuracy=draft", "map"), FileRequest("webm"), "Nothing moves in “"),
        (found, FileRequest("webm"), r"pip install 'hess-explorer\[export\]'"),
    ):
        with pytest.raises(ModelError, match=said):
            as_film(shown, request)
