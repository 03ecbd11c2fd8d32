"""Exported data: every digit of the computed values, and the metadata of every file."""

import numpy as np
import pytest

from hess_explorer.export.columns import columns_of
from hess_explorer.export.picture_data import picture_data
from hess_explorer.export.table import as_csv
from hess_mechanics import System, solve
from support.exported import read


def test_a_cloud_is_that_of_the_time_in_the_link():
    link = "scene=singular-measures&points=1000&accuracy=draft"
    early, late = (columns_of(picture_data(f"{link}&t={t}", "omega")).layer("omega-cloud") for t in (0.0, 5.0))
    assert len(early) == len(late) > 300
    assert (early["t"] == 0.0).all()
    assert (np.abs(late["t"] - 5.0) < 0.5).all()
    # s tends to 0 on the whole.
    assert late["log_s"].mean() < early["log_s"].mean() - 1.0


def test_angles_say_whether_they_count_on():
    found = picture_data("h=1.5&f=0.6&span=40&accuracy=draft", "circle")
    facts, table = read(as_csv(found))
    orbit = [float(row["phi"]) for row in table if row["layer"] == "orbit"]
    assert np.abs(np.diff(orbit)).max() < 1.0
    assert facts["angles"]["orbit.phi"] == "counts on over full turns"
    assert facts["angles"]["map.x"] == "within one turn"
    turning = System("turning", lambda y, p: (y[1], 0 * y[1]), "phase v", angles="phase", example=(0.0, 1.0))
    frame = solve(*turning.example_motion, 10.0).to_pandas()
    assert frame["phase"].iloc[-1] == pytest.approx(10.0)
    assert frame.attrs["angle phase"] == "counts on over full turns"
