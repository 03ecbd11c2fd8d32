"""Closed forms of orbits, with many digits."""

import math

import mpmath
import numpy as np


def pendulum(a, h, phi, times, digits=40):
    """The orbit of `eq01` with b = 1, f = 0: a loxodromic pendulum; doubles (n, 5).

    θ̈ = −sin θ with θ(0) = 0 and θ̇(0) > 0; φ slides by tan(φ/2 + π/4) ∝ e^{−aθ} from `phi` at time 0;
    w = θ̇ (sin φ, cos φ) and n = (−sin θ cos φ, sin θ sin φ, cos θ).  As φ, the double next to ±π/2 stands for ±π/2:
    a great circle.
    """
    with mpmath.workdps(digits):
        k = mpmath.sqrt((mpmath.mpf(h) + 1) / 2)
        m = k * k if k < 1 else 1 / (k * k)

        def swing(t):
            """θ and θ̇ at the time t after θ = 0."""
            if k == 1:
                return 2 * mpmath.asin(mpmath.tanh(t)), 2 / mpmath.cosh(t)
            if k < 1:
                return 2 * mpmath.asin(k * mpmath.ellipfun("sn", t, m=m)), 2 * k * mpmath.ellipfun("cn", t, m=m)
            turn = 2 * mpmath.ellipk(m) / k
            turns = mpmath.nint(t / turn)
            within = k * (t - turns * turn)
            theta = 2 * (mpmath.asin(mpmath.ellipfun("sn", within, m=m)) + mpmath.pi * turns)
            return theta, 2 * k * mpmath.ellipfun("dn", within, m=m)

        slides = abs(phi) != math.pi / 2
        phi = mpmath.mpf(phi) if slides else mpmath.sign(phi) * mpmath.pi / 2
        slope = mpmath.tan(phi / 2 + mpmath.pi / 4)
        rows = []
        for t in times:
            theta, speed = swing(mpmath.mpf(t))
            now = 2 * mpmath.atan(slope * mpmath.exp(-a * theta)) - mpmath.pi / 2 if slides else phi
            s, c = mpmath.sin(now), mpmath.cos(now)
            rows.append([speed * s, speed * c, -mpmath.sin(theta) * c, mpmath.sin(theta) * s, mpmath.cos(theta)])
        return np.array(rows, dtype=float)


def cos_chi(I11, I22, I13, I23, digits=40):
    """cos χ of the free Suslov problem for any inertia tensor, from a monodromy (`proofs.md`)."""
    with mpmath.workdps(digits):
        I11, I22, I13, I23 = map(mpmath.mpf, (I11, I22, I13, I23))
        J = mpmath.hypot(I13, I23)
        w = (I22 * I13**2 + I11 * I23**2) / J**2
        K, kappa = I11 * I22 / (w * J), mpmath.sqrt(I11 * I22) / J
        c = kappa * I13 * I23 * (I22 - I11) / (J**2 * w)
        C = mpmath.cos(mpmath.pi / 2 * mpmath.sqrt(kappa**2 - mpmath.mpc(K, c) ** 2))
        half = mpmath.pi / 2 * K
        return float(2 * ((C.real / mpmath.cosh(half)) ** 2 + (C.imag / mpmath.sinh(half)) ** 2) - 1)
