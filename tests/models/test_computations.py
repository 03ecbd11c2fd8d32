"""Computations from a body and keywords: points on their section, names and units, messages for invalid input."""

from math import atan2, cos, pi, sin, sqrt

import holoviews as hv
import numpy as np
from pytest import approx, raises

import hess_mechanics as hm
from hess_mechanics.errors import InvalidParameter

SUSLOV = hm.SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0)
STATE = (0.8, -0.4, 0.6, 0.0, 0.8)


def test_a_heavy_body_is_the_same_from_moments_and_from_their_inverses():
    angle = atan2(sqrt(1 / 1.5 - 1 / 2.0), sqrt(1.0 - 1 / 1.5)) + 0.1
    given = hm.HeavyBody((1.0, 1.0 / 1.5, 0.5), (cos(angle), 0.0, sin(angle)), 1.3)
    assert hm.HeavyBody.hess((1.0, 1.5, 2.0), 1.3, 0.1).parameters == approx(given.parameters, rel=1e-15)


def test_an_orbit_has_names_and_units():
    found = hm.solve(SUSLOV, STATE, times=5.0, accuracy="reference", samples=40)
    whole = found.to_xarray()
    assert np.array_equal([whole[name] for name in ("ω1", "ω2", "γ1", "γ2", "γ3")], found.states.T)
    assert (whole["ω1"].attrs["units"], whole["t"].attrs["units"]) == ("rad/T", "T")
    assert whole.attrs["error_estimate"] == found.error_estimate
    assert list(found.to_pandas()) == ["t", *found.variables]
    assert "ω1" in found._repr_html_()
    panels = found.plot()
    assert len(panels) == 5
    assert np.array_equal(panels.traverse(lambda one: one, [hv.Path])[0].dimension_values("ω1"), found.states[:, 0])


def test_basins_clouds_and_maps_have_coordinates():
    basins = hm.basins(hm.return_map(SUSLOV, E=1.842, accuracy="draft"), cells=(6, 4)).to_xarray()
    assert basins["attractor"].dims == ("δ", "ψ")
    assert float(basins["ψ"][0]) == approx(-pi + pi / 6.0)
    cloud = hm.cloud(hm.BallBody(2.0, 1.0, 0.5, 0.7, 0.0), 2.0, 2.0, count=5, accuracy="draft")
    frame = cloud.to_pandas()
    assert list(frame) == ["point", "t", "ω1", "ω2", "γ1", "γ2", "γ3", "ln|s|"]
    assert len(frame) == 5 * cloud.times.size
    assert frame["ω2"][cloud.times.size] == cloud.omega[1, 0, 1]


def test_without_pandas_a_sentence_names_the_extra(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    with raises(InvalidParameter, match=r"pip install 'hess-explorer\[data\]'"):
        hm.solve(SUSLOV, STATE, 1.0).to_pandas()
