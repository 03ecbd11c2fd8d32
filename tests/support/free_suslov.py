"""The free Suslov problem and its scattering, by the general system."""

from math import cos, hypot, sin

import numpy as np
import pytest

from hess_explorer.scenes import scenes
from hess_mechanics import level, solve, systems

SUSLOV = systems()["suslov"]
FREE, SCATTERING = scenes()["free-suslov"], scenes()["scattering"]
FLOOR = level("reference")
E3 = np.array([0.0, 0.0, 1.0])


def tensor_of(values):
    """I11, I22, I13, I23."""
    I22, I13, I23, k = (values[name] for name in ("I22", "I13", "I23", "k"))
    return I22 + k * abs(k) * (I13**2 + I23**2) / I22, I22, I13, I23


def axes_of(values):
    """J, ξ, η."""
    I13, I23 = values["I13"], values["I23"]
    J = hypot(I13, I23)
    return J, np.array([I23, -I13, 0.0]) / J, np.array([I13, I23, 0.0]) / J


def gamma_at(values, theta, phi):
    _, xi, eta = axes_of(values)
    return cos(theta) * xi + sin(theta) * (cos(phi) * eta + sin(phi) * E3)


def integrate(values, omega, gamma, times):
    """States by the general solver, with the field of gravity 0."""
    return solve(SUSLOV.at((*tensor_of(values), 0.0, 0.0, 0.0)), [*omega, *gamma], times, FLOOR).states


def energy(values):
    I11, I22, *_ = tensor_of(values)
    return 0.5 * (I11 * values["w1"] ** 2 + I22 * values["w2"] ** 2)


def shown(value):
    """Compare to the precision of a caption."""
    return pytest.approx(value, rel=6e-4, abs=6e-5)
