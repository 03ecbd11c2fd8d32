"""The commands about the Chaplygin ball: sections, exponents, periods, clouds; and basins of the Suslov problem."""

from math import log, pi, sqrt

import numpy as np
import pytest
from pytest import approx

from hess_mechanics import BallBody, SuslovBody, section
from hess_mechanics.chaplygin_ball.phase_cloud import shell
from hess_mechanics.numerics.accuracy import REFERENCE
from hess_mechanics.suslov.section import SuslovSection
from support.ball import integrate, rates, upward_crossings
from support.command_line import replaced, typed

SECTION = typed("section ball --I 1,3,0.2,-0.1 --D 5 --b 0.5,0.2,0.8 --omega 0.6,1.1 --gamma 0.6,0.8,0 --t 30")
LYAPUNOV = typed("lyapunov ball --I 1,4,0.3,0.2 --D 2 --b 0,0,1 --omega 0,0 --gamma 0,0,1 --t 40")
PERIOD = typed("period --I 1.3,0.8 --b 0.5,-0.2 --omega 1,-0.5 --gamma 0,0.6,0.8")
CLOUD = typed("cloud --I 2,1,0.5,0.7 --D 1.5 --h 2 --count 200 --t 3")
BASINS = typed("basins --I 1.5,1,0.4,0 --b 0.3,-0.5,1 --E 1.842 --cells 6,4 --crossings 240")


def followed(values, start, end):
    return integrate(values, start, [end])[-1]


# ---- sections and exponents -------------------------------------------------------------------------------------


def test_section_of_the_ball(answer):
    found = answer(*SECTION)
    values = {"I11": 1.0, "I22": 3.0, "I13": 0.2, "I23": -0.1, "D": 5.0, "b1": 0.5, "b2": 0.2, "b3": 0.8}
    times, states = upward_crossings(rates(values), [0.6, 1.1, 0.6, 0.8, 0.0], 30.0)
    assert len(found["t"]) >= 3
    assert found["t"] == approx(times.tolist(), abs=1e-8)
    assert np.array(found["y"]) == approx(states, abs=1e-7)
    assert found["variables"] == ["ω1", "ω2", "γ1", "γ2", "γ3"]
    assert max(found["drift"].values()) < 1e-9
    assert found["notes"] == [f"There are only {len(found['t'])} of 100 crossings up to t = 30."]
    # Another plane: no longer the equator.
    other = answer(*replaced(SECTION, "--t", "40"), "--plane", "0,0,0,1,0", "--sense", "0")
    assert np.array(other["y"])[:, 3] == approx(0.0, abs=1e-12)
    assert np.max(np.abs(np.array(other["y"])[:, 4])) > 0.05


def test_the_exponent_of_the_upright_ball_is_a_closed_form(answer):
    # At rest with γ = b/|b| = e3, Î = diag(I11 + 𝒟, I22 + 𝒟): ω1 and γ2 grow as exp(√(b3/(I11 + 𝒟)) t), the fastest.
    found = answer(*LYAPUNOV)
    t = np.array(found["t"])
    late = t > 24.0
    growth = t * np.array(found["average"])
    assert late.sum() > 3
    assert np.polyfit(t[late], growth[late], 1)[0] == approx(1.0 / sqrt(3.0), abs=1e-4)


def test_without_an_inner_ball_the_exponent_is_that_of_the_suslov_problem(answer):
    rest = typed("--I 1.5,3,0.4,0.4 --b=-0.5,-0.5,0.7 --omega 0.4,0.6 --gamma 0.6,0,0.8 --t 20")
    ball, suslov = answer("lyapunov", "ball", "--D", "0", *rest), answer("lyapunov", "suslov", *rest)
    assert ball["exponent"] == approx(suslov["exponent"], abs=1e-6)


# ---- the period -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("D", ["0", "4"])
def test_after_the_period_scipy_is_where_it_began(answer, D):
    found = answer(*PERIOD, "--D", D)
    values = {"I11": 1.3, "I22": 0.8, "I13": 0.0, "I23": 0.0, "D": float(D), "b1": 0.5, "b2": -0.2}
    start = [1.0, -0.5, 0.0, 0.6, 0.8]
    half, end = integrate(values, start, [0.5 * found["period"], found["period"]])
    assert end == approx(np.array(start), abs=1e-8)
    assert np.max(np.abs(half - start)) > 0.1
    for t in found["crossing"]:
        assert followed(values, start, t)[4] == approx(0.0, abs=1e-9)
    assert found["period"] == approx(2.0 * (found["crossing"][1] - found["crossing"][0]), rel=1e-15)
    assert (found["status"], found["level"], found["start"]) == ("ok", "precise", start)
    assert found["error_estimate"] < 1e-8


def test_the_closed_form_is_given_for_kharlamovas_case(answer):
    found = answer(*PERIOD, "--accuracy", "reference")
    assert found["period"] == approx(found["period_closed_form"], abs=1e-12)
    assert answer(*PERIOD, "--D", "4")["period_closed_form"] is None


# ---- clouds -----------------------------------------------------------------------------------------------------


def test_the_points_of_a_cloud_are_those_that_scipy_carries(answer):
    found = answer(*CLOUD, "--table", "points")
    values = {"I11": 2.0, "I22": 1.0, "I13": 0.5, "I23": 0.7, "D": 1.5}
    starts = shell(BallBody(*values.values()), 2.0, 0.1, 200)
    assert len(found["ω1"]) == found["count"] == 200
    for i in range(0, 200, 40):
        end = followed(values, starts[i], 3.0)
        columns = [found[name][i] for name in ("ω1", "ω2", "γ1", "γ2", "γ3")]
        assert columns == approx(end.tolist(), abs=1e-7)
        assert found["log_s"][i] == approx(log(abs(0.5 * end[0] + 0.7 * end[1])), abs=1e-7)


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


def test_where_orbits_end_is_where_they_are_at_reference(answer):
    found = answer(*BASINS)
    assert found["cells"] == [6, 4]
    assert found["psi"][:6] == approx([-pi + (i + 0.5) * pi / 3.0 for i in range(6)])
    assert sorted(set(found["delta"])) == approx([(j + 0.5) * pi / 4.0 for j in range(4)])
    assert found["counts"] == [found["group"].count(0), found["group"].count(1)]
    assert min(found["counts"]) >= 2
    assert sum(found["counts"]) == 24
    body = SuslovBody(1.5, 1.0, 0.4, 0.0, 0.3, -0.5, 1.0)
    means = {}
    for i in (0, 5, 9, 14, 20):
        start = SuslovSection(body, 1.842, 3).state_at(found["psi"][i], found["delta"][i])
        exact = section(body, start, SuslovSection(body, 0.0, 3).surface, 5000.0, REFERENCE, 600).states
        means.setdefault(found["group"][i], []).append(float(exact[400:, 0].mean()))
        # Attractors are met again, however long the orbit.
        assert found["mean"][i] == approx(means[found["group"][i]][-1], abs=0.1)
    low, high = (
        np.array([mean for mean, group in zip(found["mean"], found["group"], strict=True) if group == one])
        for one in (0, 1)
    )
    assert high.min() - low.max() > 0.1 * (high.max() - low.min())


def test_cells_that_the_energy_forbids_are_empty(answer, as_table):
    words = replaced(replaced(BASINS, "--E", "0.3"), "--crossings", "100")
    found = answer(*words)
    psi = np.array(found["psi"])
    forbidden = 0.3 * np.cos(psi) - 0.5 * np.sin(psi) >= 0.3
    assert 0 < forbidden.sum() < 24
    assert [value is None for value in found["mean"]] == [value is None for value in found["group"]]
    assert all(found["mean"][i] is None for i in np.flatnonzero(forbidden))
    assert found["notes"] == []
    _, header, rows = as_table(*words)
    assert header == ["psi", "delta", "mean", "group"]
    assert [row[2:] == ["", ""] for row in rows] == [value is None for value in found["mean"]]


def test_on_a_principal_axis_it_is_said_that_nothing_attracts(answer):
    words = replaced(replaced(replaced(BASINS, "--I", "1.5,1,0,0"), "--cells", "2,2"), "--crossings", "100")
    assert answer(*words)["notes"] == ["With I13 = I23 = 0 phase volume is conserved: there are no attractors."]


# ---- all of them ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words, said",
    [
        (replaced(SECTION, "--D", "-1"), "--D: D = -1 is not between 0 and 300"),
        (
            typed("period --I 1,2 --omega 0.6,0.8 --gamma 0.6,0.8,0"),
            "rests on the equator, so it has no period",
        ),
        (typed("period --I 1,1 --D 1 --omega 0,0 --gamma 0.6,0,0.8"), "choose another start"),
        (replaced(CLOUD, "--I", "2,1,0,0"), "Choose I13 or I23 other than 0"),
        (replaced(CLOUD, "--t", "0"), "choose --t other than 0"),
        ([*CLOUD, "--spread", "1"], "choose it between 0 and 1"),
        (replaced(BASINS, "--E", "-0.6"), "choose E above -0.583095"),
        (replaced(BASINS, "--cells", "0,4"), "write them like 40,30"),
        (replaced(BASINS, "--cells", "1000,1000"), "a product of at most 100000"),
        ([*BASINS, "--window", "1,0,0,1"], "The window needs ψ0 < ψ1"),
    ],
)
def test_what_is_wrong_is_one_sentence(refusal, words, said):
    assert said in refusal(*words)
