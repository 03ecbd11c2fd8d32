"""Exported data: every digit of the computed values, and the metadata of every file."""

import numpy as np
import pytest

from hess_explorer.export.columns import columns_of
from hess_explorer.export.picture_data import picture_data
from hess_explorer.export.table import as_csv
from hess_mechanics import System, circle_map, level, solve
from hess_mechanics.errors import ModelError
from support.exported import read
from support.mechanics import followed
from support.suslov import HESS_BODY, field
from support.view import STATE


def test_the_graph_of_the_circle_map_is_that_of_the_mechanics_to_the_last_digits():
    facts, table = read(as_csv(picture_data("h=1.2&f=0.3&accuracy=reference", "circle")))
    assert (facts["scene"], facts["picture"], facts["parameters"]["h"]) == ("suslov-hess", "circle", 1.2)
    found = circle_map(a=0.28 / 0.96, h=1.2, f=0.3, accuracy=level("reference"))
    graph = [row for row in table if row["layer"] == "map"]
    x, y = (np.array([float(row[name]) for row in graph]) for name in "xy")
    assert len(x) > 100
    off = np.abs(np.angle(np.exp(1j * (y - found.theta(x)))))
    # A graph is cut where it leaves the frame: there it has no value of its own.
    assert np.sort(off)[:-4].max() < 1e-13


def test_an_orbit_is_that_of_another_integrator_and_its_columns_have_names():
    found = picture_data("I22=0.96&I23=0.28&b3=-1&h=1.5&f=0.6&phi0=0.5&span=10&accuracy=reference", "omega")
    orbit = columns_of(found).layer("orbit")
    y = np.column_stack([orbit[name] for name in STATE])
    exact = followed(lambda _, state: field(HESS_BODY, state), y[0], orbit["t"], rtol=1e-12)
    assert np.max(np.abs(exact - y)) < 1e-8
    assert found.link in as_csv(found)


def test_a_cloud_is_that_of_the_time_in_the_link():
    link = "scene=singular-measures&points=1000&accuracy=draft"
    early, late = (columns_of(picture_data(f"{link}&t={t}", "omega")).layer("omega-cloud") for t in (0.0, 5.0))
    assert len(early) == len(late) > 300
    assert (early["t"] == 0.0).all()
    assert (np.abs(late["t"] - 5.0) < 0.5).all()
    # s tends to 0 on the whole.
    assert late["log_s"].mean() < early["log_s"].mean() - 1.0


def test_what_a_link_has_wrong_is_put_right_and_noted():
    found = picture_data("I22=-5&scene=nowhere", "circle", lenient=True)
    assert found.scene.name == "suslov-hess"
    assert [note.split()[0] for note in found.notes[:2]] == ["Scene", "I₂₂"]
    with pytest.raises(ModelError, match=r"has no picture 'x': choose one of body, omega, sphere"):
        picture_data("", "x")


def test_angles_say_whether_they_count_on():
    found = picture_data("h=1.5&f=0.6&span=40&accuracy=draft", "circle")
    facts, table = read(as_csv(found))
    orbit = [float(row["phi"]) for row in table if row["layer"] == "orbit"]
    assert np.abs(np.diff(orbit)).max() < 1.0
    assert facts["angles"]["orbit.phi"] == "counts on over full turns"
    assert facts["angles"]["map.x"] == facts["angles"]["stable.phi"] == "within one turn"
    assert columns_of(found).facts["angles"] == facts["angles"]
    turning = System("turning", lambda y, p: (y[1], 0 * y[1]), "phase v", angles="phase", example=(0.0, 1.0))
    frame = solve(*turning.example_motion, 10.0).to_pandas()
    assert frame["phase"].iloc[-1] == pytest.approx(10.0)
    assert frame.attrs["angle phase"] == "counts on over full turns"
