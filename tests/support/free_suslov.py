"""The free Suslov problem and its scattering, by closed forms and by the general system."""

from math import acos, cos, cosh, hypot, log, pi, sin, sqrt

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


def rate_of(values, h):
    """ω0 as in the paper."""
    I11, I22, I13, I23 = tensor_of(values)
    return sqrt(2.0 * (I22 * I13**2 + I11 * I23**2) * h) / (I11 * I22)


def energy(values, omega):
    I11, I22, *_ = tensor_of(values)
    return 0.5 * (I11 * omega[0] ** 2 + I22 * omega[1] ** 2)


def start_of(values):
    """ω, γ and the elapsed time of a state on the orbit from which a double reaches both ends: not next to the line."""
    omega = (values["w1"], values["w2"])
    gamma = gamma_at(values, acos(values["Gamma"]), values["phi"])
    if abs(values["w2"]) > 1e-290:
        return omega, gamma, 0.0
    # There ω2 grows as e^t and γ turns about e1 with ω1 = 2, until ω2 = 1e-7: γ2 + iγ3 → e^{−2it}(γ2 + iγ3).
    assert (values["I13"], omega[0], values["I23"] * 2.0 / values["I22"]) == (0.0, 2.0, 1.0)
    t = log(1e-7) - log(values["w2"])
    turned = complex(gamma[1], gamma[2]) * np.exp(-2j * t)
    return (2.0, 1e-7), np.array([gamma[0], turned.real, turned.imag]), t


def ends(values, omega, gamma):
    """Return states long before and long after the passage, when ω has settled to 1e-11 of its energy."""
    reach = 30.0 / rate_of(values, energy(values, omega))
    return integrate(values, omega, gamma, [-reach])[0], integrate(values, omega, gamma, [reach])[0]


def shown(value):
    """Compare to the precision of a caption."""
    return pytest.approx(value, rel=6e-4, abs=6e-5)


def start_at(values, delta, h):
    """ω with energy h whose part along η is δ times the angular velocity at the unstable point; σ = +1."""
    I11, I22, I13, I23 = tensor_of(values)
    J, xi, eta = axes_of(values)
    across = delta * J * sqrt(2.0 * h / (I11 * I23**2 + I22 * I13**2))
    a, b, c = (I11 * x[0] * y[0] + I22 * x[1] * y[1] for x, y in ((xi, xi), (xi, eta), (eta, eta)))
    # ½(a x² + 2b x across + c across²) = h, the root next to the unstable point.
    along = (-b * across + sqrt((b * across) ** 2 - a * (c * across**2 - 2.0 * h))) / a
    return along * xi[:2] + across * eta[:2]


def circle_joined(values, theta, phi, delta, h=0.7):
    """cos θ⁺ by the general solver."""
    omega = start_at(values, delta, h)
    span = (2.0 * log(1.0 / delta) + 30.0) / rate_of(values, h)
    end = integrate(values, omega, gamma_at(values, theta, phi), [span])[0]
    return float(end[2:] @ axes_of(values)[1])


def cos_chi_on_an_axis(values):
    """The closed form for I13 = 0."""
    I11, I22, I13, I23 = tensor_of(values)
    assert I13 == 0.0
    k2 = I22 * (I11 - I22) / I23**2
    half = 0.5 * pi * sqrt(abs(k2))
    cosine = cos(half) if k2 >= 0.0 else cosh(half)
    return 2.0 * cosine**2 / cosh(0.5 * pi * I22 / I23) ** 2 - 1.0
