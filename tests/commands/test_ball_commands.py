"""The commands about the Chaplygin ball: sections, exponents, periods, clouds; and basins of the Suslov problem."""

import numpy as np
import pytest
from pytest import approx

from hess_mechanics import BallBody
from hess_mechanics.chaplygin_ball.phase_cloud import shell
from support.ball import rates, upward_crossings
from support.command_line import replaced, typed

SECTION = typed("section ball --I 1,3,0.2,-0.1 --D 5 --b 0.5,0.2,0.8 --omega 0.6,1.1 --gamma 0.6,0.8,0 --t 30")

CLOUD = typed("cloud --I 2,1,0.5,0.7 --D 1.5 --h 2 --count 200 --t 3")
BASINS = typed("basins --I 1.5,1,0.4,0 --b 0.3,-0.5,1 --E 1.842 --cells 6,4")


# ---- sections and exponents -------------------------------------------------------------------------------------


def test_section_of_the_ball(answer):
    found = answer(*SECTION)
    values = {"I11": 1.0, "I22": 3.0, "I13": 0.2, "I23": -0.1, "D": 5.0, "b1": 0.5, "b2": 0.2, "b3": 0.8}
    times, states = upward_crossings(rates(values), [0.6, 1.1, 0.6, 0.8, 0.0], 30.0)
    assert len(times) >= 3
    assert found["t"] == approx(times.tolist(), abs=1e-8)
    assert np.array(found["y"]) == approx(states, abs=1e-7)


# ---- clouds -----------------------------------------------------------------------------------------------------


def test_the_course_of_a_cloud_is_that_of_its_points(answer):
    course, points = answer(*CLOUD), answer(*CLOUD, "--table", "points")
    starts = shell(BallBody(2.0, 1.0, 0.5, 0.7, 1.5), 2.0, 0.1, 200)
    growth = np.array(points["log_s"]) - np.log(np.abs(starts[:, :2] @ [0.5, 0.7]))
    assert (course["t"][0], course["t"][-1], course["final_time"]) == (0.0, 3.0, 3.0)
    assert course["volume"][0] == approx(1.0, abs=1e-15)
    last = [course[name][-1] for name in ("volume", "growth_mean", "growth_least", "growth_largest")]
    assert last == approx([np.exp(growth).mean(), growth.mean(), growth.min(), growth.max()], rel=1e-9)
    assert (course["status"], course["level"], course["is_body"]) == ("ok", "precise", False)


def test_the_density_of_a_cloud_counts_its_points(answer):
    density, points = answer(*CLOUD, "--table", "density"), answer(*CLOUD, "--table", "points")
    width = density["log_s"][1] - density["log_s"][0]
    for name in ("first", "last", "mean"):
        assert sum(density[name]) * width == approx(1.0, abs=1e-12)
    edges = np.array([density["log_s"][0] - width / 2.0 + i * width for i in range(len(density["log_s"]) + 1)])
    counted, _ = np.histogram(points["log_s"], edges)
    assert density["last"] == approx((counted / (200 * width)).tolist(), abs=1e-12)
    # Backward the cloud goes to the other half of s = 0.
    assert answer(*replaced(CLOUD, "--t", "-3"))["t"][-1] == -3.0
    patch = answer(*CLOUD, "--angle", "0.4", "--table", "points")
    assert np.ptp(patch["γ1"]) < np.ptp(points["γ1"])


# ---- basins -----------------------------------------------------------------------------------------------------


def test_the_attractors_of_the_cells_are_counted(answer):
    found = answer(*BASINS)
    assert found["attractors"] == 2
    assert found["counts"] == np.bincount(found["attractor"]).tolist()
    assert min(found["counts"]) >= 2
    assert found["psi"][:6] == approx([-np.pi + (i + 0.5) * np.pi / 3.0 for i in range(6)])
    assert sorted(set(found["delta"])) == approx([(j + 0.5) * np.pi / 4.0 for j in range(4)])


def test_cells_that_the_energy_forbids_are_empty(answer, as_table):
    words = replaced(BASINS, "--E", "0.3")
    found = answer(*words)
    psi = np.array(found["psi"])
    forbidden = 0.3 * np.cos(psi) - 0.5 * np.sin(psi) >= 0.3
    assert 0 < forbidden.sum() < 24
    assert [value is None for value in found["crossings"]] == [value is None for value in found["attractor"]]
    assert all(found["attractor"][i] is None for i in np.flatnonzero(forbidden))
    assert found["notes"] == []
    _, header, rows = as_table(*words)
    assert header == ["psi", "delta", "attractor", "crossings"]
    assert [row[2:] == ["", ""] for row in rows] == [value is None for value in found["attractor"]]


# ---- all of them ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words, said",
    [
        (replaced(SECTION, "--D", "-1"), "--D: D = -1 is not between 0 and 300"),
        (
            typed("period --I 1,2 --omega 0.6,0.8 --gamma 0.6,0.8,0"),
            "rests on the equator, so it has no period",
        ),
        (replaced(CLOUD, "--I", "2,1,0,0"), "Choose I13 or I23 other than 0"),
        (replaced(BASINS, "--E", "-0.6"), "choose E above -0.583095"),
        (replaced(BASINS, "--cells", "1000,1000"), "a product of at most 100000"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)
