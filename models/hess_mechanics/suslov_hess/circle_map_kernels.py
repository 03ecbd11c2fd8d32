# mypy: allow-untyped-defs
"""Kernels of `circle_map`: the SU(1,1) matrices of tori, and the map Θ.  Not for users."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from hess_mechanics.numerics.angle_kernels import angle_of
from hess_mechanics.numerics.jit import kernel, part
from hess_mechanics.numerics.step_kernels import step_of
from hess_mechanics.numerics.taylor_kernels import columns_of, expansion, workspace
from hess_mechanics.numerics.tracing import trace
from hess_mechanics.numerics.unrolled import evaluation
from hess_mechanics.suslov_hess import equations
from hess_mechanics.suslov_hess.bifurcation_kernels import period_from_gaps, roots

__all__ = ["field", "matrices_into", "monodromy", "theta_of"]


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of `eq01` at a = 0 and of the linear system of `circle_map`.

    A = a1 + i a2, B = b1 + i b2, p = (a/2, b).
    """
    w1, w2, _, _, _, a1, a2, b1, b2 = y
    half_a, b = p
    return (
        *equations.field(y[:5], (0, b)),
        # conj(W B) = re − i im with W = w2 + i w1; −i(re − i im) = −im − i re.
        -half_a * (w2 * b2 + w1 * b1),
        -half_a * (w2 * b1 - w1 * b2),
        -half_a * (w2 * a2 + w1 * a1),
        -half_a * (w2 * a1 - w1 * a2),
    )


_recursion = trace(field, variables=9, parameters=2)
_columns, _expand = columns_of(_recursion), expansion(_recursion)
_evaluate = evaluation(9)


@part
def monodromy(h, f, a, order, tolerance, max_steps):
    """Return (Re α, Im α, Im β, L, ζ, steps); the first three are times e^{−L}, and ζ is the lift of arg α.

    A and B are rescaled as they grow, so that a and h may be large.  steps = −1 means that the step limit was reached,
    or that a step is not positive.
    """
    _, n1, _, g10, _, g20, w_low, v_low = roots(h, f)
    half_period = 0.5 * period_from_gaps(g10, g20)
    nu = math.sqrt(2.0 * (h + 1.0))
    c, left_factors, right_factors, inverses = workspace(order, 9, _columns)
    increments = np.zeros(9)
    seen = np.zeros((order, 0))
    c[0, 1] = math.sqrt(2.0 * w_low) / nu
    c[0, 3] = math.copysign(math.sqrt(v_low), f)
    c[0, 4] = n1
    c[0, 5] = 1.0
    p = (0.5 * a, 1.0 / (nu * nu))
    left = half_period * nu
    log_scale = 0.0
    arg_A = 0.0
    steps = 0
    while left > 0.0:
        _expand(c, left_factors, right_factors, inverses, p, seen)
        s = step_of(c, 9, tolerance)
        if not s > 0.0 or steps >= max_steps:
            return 0.0, 0.0, 0.0, 0.0, 0.0, -1.0
        s = min(s, left)
        left -= s
        re, im = c[0, 5], c[0, 6]
        _evaluate(c, s, increments)
        for i in range(9):
            c[0, i] += increments[i]
        arg_A += math.atan2(re * c[0, 6] - im * c[0, 5], re * c[0, 5] + im * c[0, 6])
        size = math.hypot(c[0, 5], c[0, 6])
        if size > 16.0:
            for i in range(5, 9):
                c[0, i] /= size
            log_scale += math.log(size)
        steps += 1
    A = complex(c[0, 5], c[0, 6])
    B = complex(c[0, 7], c[0, 8])
    # W starts real and positive and turns by less than π on the way up, so the principal value is right.
    chi = math.atan2(c[0, 0], c[0, 1])
    turn = complex(math.cos(0.5 * chi), math.sin(0.5 * chi))
    A *= turn
    B *= turn
    alpha = A * A - (B * B).conjugate()
    beta = 2.0 * (A * B).imag
    ratio = (B.conjugate() / A) ** 2
    zeta = 2.0 * (arg_A + 0.5 * chi) + math.atan2(-ratio.imag, 1.0 - ratio.real)
    if f == 0.0 and h < 1.0:
        # In the limit f → 0+ Re α vanishes, but its two terms are too large to cancel exactly.
        return 0.0, alpha.imag, beta, 2.0 * log_scale, -0.5 * math.pi, float(steps)
    return alpha.real, alpha.imag, beta, 2.0 * log_scale, zeta, float(steps)


@kernel
def matrices_into(a, h, f, order, tolerance, max_steps, out):
    """Store `monodromy` of each torus (a[i], h[i], f[i]) in out[i]; return False if a torus has steps = −1."""
    complete = True
    for i in range(h.size):
        row = monodromy(h[i], f[i], a[i], order, tolerance, max_steps)
        for j in range(6):
            out[i, j] = row[j]
        complete &= row[5] >= 0.0
    return complete


@kernel
def theta_of(re, im, im_beta, phi, cos, sin, out):
    """Store Θ(φ) = 2 arg(αz + β) − φ, z = e^{iφ} = cos + i sin, in (−π, π], in out."""
    for i in range(phi.size):
        c, s = cos[i], sin[i]
        angle = 2.0 * angle_of(re * s + im * c + im_beta, re * c - im * s) - phi[i]
        angle -= 2.0 * math.pi * np.rint(angle / (2.0 * math.pi))
        out[i] = math.pi if angle <= -math.pi else min(angle, math.pi)
