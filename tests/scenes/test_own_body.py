"""*Your own body*: the change of its energy is the work of its drive."""

import numpy as np
from pytest import approx

import hess_explorer as hess
from hess_explorer.scenes import scenes
from hess_mechanics import solve

DRIVEN = {"U": "", "d1": 0.4, "d3": 1.0, "frequency": 1.3, "p": "cos(W*t) + 0.5*sin(2*W*t)", "w1": 1.0}


def test_the_energy_of_a_driven_body_changes_by_the_work_of_its_drive():
    state, scene = hess.state("own-body", **DRIVEN), scenes()["own-body"]
    own = scene.of({**scene.defaults(), **DRIVEN})
    change, work = (state.data("energy").layer(name) for name in ("change", "work"))
    assert np.asarray(change["y"]) == approx(np.asarray(work["y"]), abs=1e-5)
    inertia = np.array([[2.0, 0.0, 0.3], [0.0, 1.5, 0.2], [0.3, 0.2, 1.2]])
    omega = solve(own.body, own.start, [own.lasts], "precise").states[0, :3]
    assert abs(np.asarray(work["y"])[-1]) > 1e-3
    energies = [w @ inertia @ w / 2 for w in (np.array(own.start[:3]), omega)]
    assert np.asarray(change["y"])[-1] == approx(energies[1] - energies[0], abs=1e-5)


def test_parameters_without_effect_are_named():
    scene = scenes()["own-body"]

    def idle(**changes):
        return dict(scene.idle_values({**scene.defaults(), **changes}))

    assert idle() == {"frequency": scene.defaults()["frequency"]}
    assert idle(d2=0.1) == {}
    assert idle(constraint="none", d3=1.0) == {"a1": 0.0, "a2": 0.0, "a3": 0.0}
