"""Films: they decode, have the requested number of frames, and show the point at the right place."""

import json
import math
import re
import sys
import tempfile

import numpy as np
import pytest
from hess_explorer.export.film import as_film, pictures_at, times_of
from hess_explorer.export.loop import footer, loop_times, period
from pytest import approx
from scipy import ndimage

from hess_explorer.__main__ import main
from hess_explorer.export.formats import Loop, holding
from hess_explorer.export.picture_data import picture_data
from hess_mechanics.errors import ModelError
from support.films import frames_of, tags_of
from support.mechanics import followed
from support.suslov import HESS_BODY, field
from support.view import STATE

LINK = "I22=0.96&I23=0.28&b3=-1&h=1.5&f=0.6&phi0=0.5&span=10&accuracy=precise"
SIDE = 480
"""Pixels of a film 60 mm wide."""


@pytest.fixture(scope="module")
def found():
    return picture_data(LINK, "omega")


def box_of(picture):
    """The frame of the plot in pixels: left, right, top, bottom, where its dark lines are."""
    dark = picture.astype(int).sum(axis=2) < 500
    columns, rows = (np.flatnonzero(dark.mean(axis=axis) > 0.5) for axis in (0, 1))
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


@pytest.mark.parametrize("kind", holding("film"))
def test_the_moving_point_is_where_the_orbit_is_at_that_time(found, kind, tmp_path):
    told = []
    path = tmp_path / f"film.{kind}"
    path.write_bytes(as_film(found, kind, 60.0, seconds=1.0, report=lambda *done: told.append(done)))
    assert told == [(i + 1, 25) for i in range(25)]
    pictures = frames_of(path, SIDE)
    assert len(pictures) == 25
    track = found.columns["data-orbit"]
    chosen = np.array([5, 14, 24])
    start = [track[name][0] for name in STATE]
    exact = followed(lambda _, y: field(HESS_BODY, y), start, 10.0 * chosen / 24.0)
    left, right, top, bottom = box_of(pictures[0])
    for i, (w1, w2) in zip(chosen, exact[:, :2], strict=True):
        x, y = point_in(pictures[i])
        (x0, x1), (y0, y1) = found.axes.x, found.axes.y
        # The point is 13 pixels wide; it may be off by one, where the film has its colours for four pixels together.
        assert x == approx(left + (right - left) * (w1 - x0) / (x1 - x0), abs=1.2)
        assert y == approx(bottom - (bottom - top) * (w2 - y0) / (y1 - y0), abs=1.2)

    said = tags_of(path)
    for fact in (found.title, found.link, found.facts["program"], "f = 0.6", "accuracy: precise", "error"):
        assert fact in said


def test_what_moves_moves_and_what_stands_stands():
    cloud = picture_data("scene=singular-measures&points=1000&accuracy=draft", "omega")
    times = times_of(cloud, 4.0)
    assert (times[0], times[-1], len(times)) == (0.0, cloud.columns["omega"]["times"][-1], 100)
    first, last = (np.array(one, int) for one in pictures_at(cloud, times[[0, -1]], 60.0))
    left, right, top, bottom = box_of(first)
    changed = np.abs(first - last).sum(axis=2) > 60
    inside = changed[top : bottom + 1, left : right + 1]
    assert inside.sum() > 200
    changed[top : bottom + 1, left : right + 1] = False
    # Besides, only the clock in the corner.
    rows, columns = np.nonzero(changed)
    assert rows.max() < top
    assert columns.min() > SIDE / 2
    body = picture_data(f"{LINK}&t=3", "body")
    first, again = pictures_at(body, np.array([3.0, 3.0]), 60.0)
    assert np.array_equal(first, again)


@pytest.mark.parametrize(
    "link, picture, lasts",
    [
        # Motion on a closed curve; a limit cycle that is only approached; a body, which leaves a trail.
        ("scene=kharlamova", "domain", True),
        (LINK, "omega", False),
        (LINK, "body", False),
    ],
)
def test_the_end_of_a_loop_meets_its_beginning(link, picture, lasts, tmp_path):
    shown, dark = picture_data(link, picture), Loop(dark=True, home="https://example.org/")
    if lasts:
        path = tmp_path / "loop.mp4"
        path.write_bytes(as_film(shown, "mp4", seconds=1.0, loop=dark))
        frames = frames_of(path, 1080).astype(int)
        assert len(frames) == 25
        frames = frames[[0, 1, 12, -1]]
    else:
        times = loop_times(shown, 25)[[0, 1, 12, -1]]
        frames = np.array([picture.astype(int) for picture in pictures_at(shown, times, 60.0, loop=dark)])
    assert frames[0][:5, :5].mean() < 40
    # The last frame is as near to the first as the second is, and the middle is another picture.
    step, away, back = (np.abs(one - frames[0]).mean() for one in frames[1:])
    assert back < 2.0 * step + 0.05
    assert away > 0.1
    assert (period(shown) is not None) == lasts
    times = loop_times(shown, 100)
    if lasts:
        state = shown.columns["data-orbit"]
        for name in ("q1", "q2", "g1", "g2"):
            assert np.interp(period(shown), state["t"], state[name]) == approx(state[name][0], abs=0.01)
    else:
        assert times == approx(times[::-1][[-1, *range(99)]])
        assert times.max() == approx(shown.columns["data-orbit"]["t"][-1])
    assert footer(shown, "https://example.org/").count("\n") <= 3


def test_a_film_that_is_stopped_leaves_nothing_behind(found, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))

    def stop(done, of):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        as_film(found, "webm", 60.0, report=stop)
    assert list(tmp_path.iterdir()) == []


def test_the_command_writes_films_and_pages_and_says_how_far_it_is(found, tmp_path, capsys):
    film, page = tmp_path / "film.mp4", tmp_path / "page.html"
    words = ["export", "--state", LINK, "--picture", "omega", "--format", "mp4", "--width", "60", "--seconds", "1"]
    assert main([*words, "--progress", "--out", str(film)]) == 0
    assert capsys.readouterr().err.splitlines() == [f"{i + 1}/25" for i in range(25)]
    assert len(frames_of(film, SIDE)) == 25
    assert main(words) == 2
    assert "MP4 is a binary format: name a file with --out FILE." in capsys.readouterr().err
    assert main(["export", "--state", LINK, "--picture", "omega,sphere", "--format", "html", "--out", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    facts = json.loads(re.search('<script type="application/json" id="facts">(.*)</script>', text)[1])
    assert (facts["link"], facts["pictures"]) == (found.link, ["omega", "sphere"])


def test_what_cannot_be_filmed_is_refused_with_a_sentence(found, monkeypatch):
    for wrong in (0.0, 59.9, 161.0, math.nan):
        with pytest.raises(ModelError, match="60 to 160 mm wide"):
            as_film(found, "webm", wrong)
    for wrong in (0.5, 61.0, math.nan):
        with pytest.raises(ModelError, match="1 to 60 seconds long"):
            as_film(found, "webm", seconds=wrong)
    with pytest.raises(ModelError, match="choose one of webm, mp4, gif"):
        as_film(found, "avi")
    with pytest.raises(ModelError, match="Nothing moves in “"):
        as_film(picture_data("scene=scattering&accuracy=draft", "map"), "webm")
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(ModelError, match=r"pip install 'hess-explorer\[export\]'"):
        as_film(found, "webm")
