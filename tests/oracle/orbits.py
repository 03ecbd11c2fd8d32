"""Taylor series of a system's plain `field`, in the arithmetic of the given numbers."""

import decimal
import math
import re
from decimal import Decimal
from functools import reduce
from operator import mul

import numpy as np

from hess_mechanics.numerics.expressions import FUNCTIONS
from hess_mechanics.numerics.taylor_kernels import columns_of, convolution_source, expansion_source
from oracle.kept import kept


class Series:
    """Power series in time, for many orbits at once; coefficients are computed on demand.

    `rule(k)` is coefficient k, from coefficients that are known by then: one number for each orbit in an array of this
    shape (order + 1, orbits); with the shape (order + 1,) one number, which saves decimals the work of arrays.
    """

    __array_ufunc__ = None  # an array on the left of an operator leaves the work to the series

    def __init__(self, rule, shape, dtype):
        self.rule, self.shape, self.dtype, self.known = rule, shape, dtype, 0
        self.c = np.empty(shape, dtype) if len(shape) == 2 else [None] * shape[0]

    def upto(self, k):
        """All coefficients, filled up to order k."""
        while self.known <= k:
            self.c[self.known] = self.rule(self.known)
            self.known += 1
        return self.c

    def like(self, rule):
        return Series(rule, self.shape, self.dtype)

    def lifted(self, other):
        """`other` as a series: a number is one whose higher coefficients vanish."""
        if isinstance(other, Series):
            return other
        return self.like(lambda k: self.upto(0)[0] * 0 + (other if k == 0 else 0))

    def __neg__(self):
        return self.like(lambda k: -self.upto(k)[k])

    def __add__(self, other):
        other = self.lifted(other)
        return self.like(lambda k: self.upto(k)[k] + other.upto(k)[k])

    __radd__ = __add__

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        if isinstance(other, Series):
            return self.like(lambda k: folded(self.upto(k)[: k + 1], other.upto(k)[: k + 1]))
        return self.like(lambda k: self.upto(k)[k] * other)

    __rmul__ = __mul__

    def __truediv__(self, other):
        if not isinstance(other, Series):
            return self.like(lambda k: self.upto(k)[k] / other)

        def rule(k):
            known = folded(other.upto(k)[1:], quotient.c[:k]) if k else 0
            return (self.upto(k)[k] - known) / other.upto(0)[0]

        quotient = self.like(rule)
        return quotient

    def __rtruediv__(self, other):
        return self.lifted(other) / self

    def __pow__(self, exponent):
        return reduce(mul, [self] * exponent)


def folded(left, right):
    """Σ left[m] right[k−m], over the k+1 coefficients that `right` has."""
    left = left[: len(right)]
    if isinstance(left, list):
        return sum(map(mul, left, reversed(right)))
    if left.dtype == object:
        return (left * right[::-1]).sum(axis=0)
    return np.einsum("kl,kl->l", left, right[::-1])


def coefficients(field, y, p, order):
    """Taylor coefficients of ẏ = field(y, p), shape (d, order + 1, orbits), for y (d, orbits) and p (q, orbits)."""
    dtype = y.dtype
    rates, shape = [], (order + 1, y.shape[1])
    if y.dtype == object and y.shape[1] == 1:
        y, p, shape = y[:, 0].tolist(), p[:, 0].tolist(), (order + 1,)

    def variable(i):
        return Series(lambda k: y[i] if k == 0 else rates[i].upto(k - 1)[k - 1] / k, shape, dtype)

    variables = [variable(i) for i in range(len(y))]
    rates.extend(variables[0].lifted(rate) for rate in field(variables, list(p)))
    return np.array([series.upto(order) for series in variables], dtype).reshape(len(y), order + 1, -1)


def taylor(field, y, p, times, order, tolerance):
    """States (n, d, orbits) at times (n, orbits), from y (d, orbits) at t = 0, in the arithmetic of these arrays.

    Every orbit has steps of its own: so long that the last two terms equal the tolerance (relative to a component
    where that exceeds 1).  Nothing is interpolated: steps end at the times.
    """
    number = Decimal if y.dtype == object else y.dtype.type
    y, t, out = y.copy(), times[0] * 0, []
    for target in times:
        while (moving := np.flatnonzero(t != target)).size:
            c = coefficients(field, y[:, moving], p[:, moving], order)
            size = np.maximum(np.abs(c[:, 0]).astype(float), 1.0)
            step = np.full(moving.size, np.inf)
            for k in (order - 1, order):
                last = (np.abs(c[:, k]).astype(np.longdouble) / size).max(axis=0)
                assert np.all(last < np.inf), "a coefficient beyond range: measure time in other units"
                step = np.minimum(step, (tolerance / np.maximum(last, 1e-300)) ** (1 / k))
            left = target[moving] - t[moving]
            h = np.array(
                [
                    x if abs(x) <= s else number(math.copysign(s, x))
                    for x, s in zip(left, step.astype(float), strict=True)
                ]
            )
            total = c[:, order]
            for k in range(order - 1, -1, -1):
                total = total * h + c[:, k]
            y[:, moving] = total
            t[moving] = np.where(h == left, target[moving], t[moving] + h)
        out.append(y.copy())
    return np.array(out)


def uncompiled(recursion, number=None):
    """`taylor_kernels.expansion` and all it calls as plain functions, by name, which take numbers of any kind.

    number : makes one of these from the text of a constant, where a float would not do.
    """
    functions = {"number": number, **FUNCTIONS}
    for source in (recursion.source, convolution_source(columns_of(recursion)), expansion_source(recursion)):
        exec(re.sub(r"\b\d+\.\d+(e[-+]?\d+)?", r"number('\g<0>')", source) if number else source, functions)
    return functions


def as_decimals(values):
    """The same numbers, exactly, as decimals."""
    return np.vectorize(Decimal, otypes=[object])(np.asarray(values, dtype=object))


def as_long_doubles(texts):
    """Convert texts to long doubles directly, without rounding to double first."""
    return np.vectorize(np.longdouble, otypes=[np.longdouble])(np.array(texts))


@kept(as_long_doubles)
def orbits_in_long_double(system, states, parameters, times):
    """Many orbits at once: states (orbits, d), parameters (orbits, q), times (orbits, n) → (orbits, n, d)."""
    y, p, t = (as_long_doubles(values).T for values in (states, parameters, times))
    return np.moveaxis(taylor(system.field, y, p, t, order=28, tolerance=1e-22), -1, 0)


@kept(as_decimals)
def orbit_in_decimals(system, state, parameters, times, digits):
    """Return one orbit (n, d) with this many digits in each step; an unstable motion loses some of them."""
    with decimal.localcontext(prec=digits):
        y, p = (as_decimals(np.reshape(values, (-1, 1)).tolist()) for values in (state, parameters))
        t = as_decimals(np.reshape(times, (-1, 1)).tolist())
        return taylor(system.field, y, p, t, order=round(1.15 * digits), tolerance=10.0**-digits)[:, :, 0]


def distances(computed, exact):
    """Return |computed − exact| as doubles, without rounding the exact values first."""
    computed = as_decimals(np.asarray(computed).tolist()) if exact.dtype == object else computed.astype(exact.dtype)
    return np.abs(computed - exact).astype(float)


def derivative_of_flow(system, state, parameters, time):
    """∂y(time)/∂y(0) by differences of the fourth order of orbits in long double."""
    size, step = len(state), np.longdouble(1e-4)
    shifts = step * np.kron(np.eye(size), np.array([[-2], [-1], [1], [2]]))
    starts = np.array(state, np.longdouble) + shifts
    p = np.repeat(np.array(parameters, np.longdouble)[:, None], len(starts), axis=1)
    ends = taylor(system.field, starts.T, p, np.full((1, len(starts)), time, np.longdouble), 28, 1e-22)[0]
    weights = np.array([1, -8, 8, -1], np.longdouble) / (12 * step)
    return (ends.reshape(size, size, 4) @ weights).astype(float)
