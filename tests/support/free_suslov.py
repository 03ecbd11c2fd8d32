"""The free Suslov problem and its scattering: tensor, vertical and energy of a state."""

from math import cos, hypot, sin

import numpy as np
import pytest

from hess_explorer.scenes import scenes

FREE, SCATTERING = scenes()["free-suslov"], scenes()["scattering"]


def tensor_of(values):
    """I11, I22, I13, I23."""
    I22, I13, I23, k = (values[name] for name in ("I22", "I13", "I23", "k"))
    return I22 + k * abs(k) * (I13**2 + I23**2) / I22, I22, I13, I23


def gamma_at(values, theta, phi):
    I13, I23 = values["I13"], values["I23"]
    xi, eta = np.array([[I23, -I13, 0.0], [I13, I23, 0.0]]) / hypot(I13, I23)
    return cos(theta) * xi + sin(theta) * (cos(phi) * eta + sin(phi) * np.array([0.0, 0.0, 1.0]))


def energy(values):
    I11, I22, *_ = tensor_of(values)
    return 0.5 * (I11 * values["w1"] ** 2 + I22 * values["w2"] ** 2)


def shown(value):
    """Compare to the precision of a caption."""
    return pytest.approx(value, rel=6e-4, abs=6e-5)
