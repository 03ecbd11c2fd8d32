"""Number types in ball arithmetic on which a vector field can be evaluated: Taylor models and dual numbers.

A Taylor model is a polynomial with a bound on its error.  `tube` uses both types; they have only the operations that
fields use.
"""

from __future__ import annotations

from typing import Any

from hess_mechanics.numerics.balls import ArbBall

__all__ = ["Slope", "TaylorModel"]


class _Number:
    """Base class: differences and reflected operations, derived from sums and products."""

    __slots__ = ()

    def __radd__(self: Any, other: Any) -> Any:
        return self + other

    def __sub__(self: Any, other: Any) -> Any:
        return self + -other

    def __rsub__(self: Any, other: Any) -> Any:
        return -self + other

    def __rmul__(self: Any, other: Any) -> Any:
        return self * other


class TaylorModel(_Number):
    """A Taylor model: a function of s in [0, δ] as a polynomial and an upper bound on its error there.

    The polynomial of a product has at most 2 × `terms` coefficients; higher terms are added to the bound.

    Parameters
    ----------
    polynomial : arb_poly
        The polynomial.
    delta : arb
        Length δ of the interval.
    terms : int
        Number of terms of a series.
    rest : arb, optional
        Upper bound on the error.  By default the polynomial is exact.
    """

    __slots__ = ("_bound", "delta", "polynomial", "rest", "terms")

    def __init__(self, polynomial: ArbBall, delta: ArbBall, terms: int, rest: ArbBall | None = None) -> None:
        self.polynomial, self.delta, self.terms, self.rest = polynomial, delta, terms, rest
        self._bound: ArbBall | None = None

    @classmethod
    def number(cls, value: Any, delta: ArbBall, terms: int) -> TaylorModel:
        """Return a constant as a Taylor model.

        Parameters
        ----------
        value : object
            The constant, a number or a ball.
        delta : arb
            Length δ of the interval.
        terms : int
            Number of terms of a series.

        Returns
        -------
        TaylorModel
            The constant.
        """
        from flint import arb_poly

        return cls(arb_poly([value]), delta, terms)

    def _with(self, polynomial: ArbBall, rest: ArbBall | None) -> TaylorModel:
        if len(polynomial) > 2 * self.terms:
            from flint import arb_poly

            coefficients = polynomial.coeffs()
            beyond = _size(coefficients[2 * self.terms :], self.delta) * self.delta ** (2 * self.terms)
            rest = beyond if rest is None else rest + beyond
            polynomial = arb_poly(coefficients[: 2 * self.terms])
        return TaylorModel(polynomial, self.delta, self.terms, rest)

    @property
    def bound(self) -> ArbBall:
        """Upper bound on |polynomial| on [0, δ]."""
        if self._bound is None:
            self._bound = _size(self.polynomial.coeffs(), self.delta)
        return self._bound

    def distance(self, other: ArbBall) -> ArbBall:
        """Return an upper bound on the distance of the function from a polynomial on [0, δ].

        Parameters
        ----------
        other : arb_poly
            The polynomial.

        Returns
        -------
        arb
            The bound.
        """
        bound = _size((self.polynomial - other).coeffs(), self.delta)
        return bound if self.rest is None else bound + self.rest

    def __neg__(self) -> TaylorModel:
        return TaylorModel(-self.polynomial, self.delta, self.terms, self.rest)

    def __add__(self, other: Any) -> TaylorModel:
        if not isinstance(other, TaylorModel):
            return TaylorModel(self.polynomial + other, self.delta, self.terms, self.rest)
        rest = self.rest if other.rest is None else other.rest if self.rest is None else self.rest + other.rest
        return TaylorModel(self.polynomial + other.polynomial, self.delta, self.terms, rest)

    def __mul__(self, other: Any) -> TaylorModel:
        if not isinstance(other, TaylorModel):
            return TaylorModel(
                self.polynomial * other,
                self.delta,
                self.terms,
                None if self.rest is None else self.rest * abs(other + 0 * self.delta),
            )
        rest = None
        for one, two in ((self, other), (other, self)):
            if one.rest is not None:
                off = one.rest * two.bound
                rest = off if rest is None else rest + off
        if self.rest is not None and other.rest is not None:
            rest = rest + self.rest * other.rest
        return self._with(self.polynomial * other.polynomial, rest)

    def __pow__(self, exponent: int) -> TaylorModel:
        product = TaylorModel.number(1, self.delta, self.terms)
        factor = self if exponent >= 0 else self.inverse()
        for _ in range(abs(exponent)):
            product = product * factor
        return product

    def inverse(self) -> TaylorModel:
        """Return the inverse 1/b of this function b.

        With the truncated series q of 1/b and η = 1 − qb, |η| < 1, it is q/(1 − η).

        Returns
        -------
        TaylorModel
            The inverse.

        Raises
        ------
        ZeroDivisionError
            If b may vanish on the interval.
        """
        from flint import arb, arb_poly, arb_series, ctx

        before, ctx.cap = ctx.cap, self.terms
        try:
            q = arb_poly([c.mid() for c in (1 / arb_series(self.polynomial.coeffs()[: self.terms])).coeffs()])
        except ValueError:
            # The first coefficient may be zero or not finite.
            raise ZeroDivisionError("a divisor that may vanish where a step begins") from None
        finally:
            ctx.cap = before
        truncation = TaylorModel(q, self.delta, self.terms)
        off = (truncation * self).distance(arb_poly([1]))
        if not off < 1:
            raise ZeroDivisionError("a divisor that may vanish along a step")
        return TaylorModel(q, self.delta, self.terms, (truncation.bound * off / (1 - off)).abs_upper() + arb(0))

    def __truediv__(self, other: Any) -> TaylorModel:
        return self * (other.inverse() if isinstance(other, TaylorModel) else 1 / (other + 0 * self.delta))

    def __rtruediv__(self, other: Any) -> TaylorModel:
        return self.inverse().__mul__(other)


def _size(coefficients: list[ArbBall], delta: ArbBall) -> ArbBall:
    """Return an upper bound on Σ|c_k| δ^k."""
    from flint import arb_poly

    return arb_poly([abs(c) for c in coefficients])(delta).abs_upper()


class Slope(_Number):
    """A dual number: a value and its partial derivatives.

    Parameters
    ----------
    value : arb
        The value.
    slopes : list of arb
        Its partial derivatives, one for each variable.
    """

    __slots__ = ("slopes", "value")

    def __init__(self, value: ArbBall, slopes: list[ArbBall]) -> None:
        self.value, self.slopes = value, slopes

    @classmethod
    def of(cls, value: ArbBall, i: int, count: int) -> Slope:
        """Return one of several variables as a dual number.

        Parameters
        ----------
        value : arb
            Value of the variable.
        i : int
            Index of the variable.
        count : int
            Number of variables.

        Returns
        -------
        Slope
            The dual number.
        """
        return cls(value, [value * 0 + (1 if i == j else 0) for j in range(count)])

    def __neg__(self) -> Slope:
        return Slope(-self.value, [-x for x in self.slopes])

    def __add__(self, other: Any) -> Slope:
        if not isinstance(other, Slope):
            return Slope(self.value + other, self.slopes)
        return Slope(self.value + other.value, [x + y for x, y in zip(self.slopes, other.slopes, strict=True)])

    def __mul__(self, other: Any) -> Slope:
        if not isinstance(other, Slope):
            return Slope(self.value * other, [x * other for x in self.slopes])
        return Slope(
            self.value * other.value,
            [x * other.value + self.value * y for x, y in zip(self.slopes, other.slopes, strict=True)],
        )

    def __pow__(self, exponent: int) -> Slope:
        slope = exponent * self.value ** (exponent - 1) if exponent else 0 * self.value
        return Slope(self.value**exponent, [slope * x for x in self.slopes])

    def __truediv__(self, other: Any) -> Slope:
        if isinstance(other, Slope):
            return self * (1 / other)
        return Slope(self.value / other, [x / other for x in self.slopes])

    def __rtruediv__(self, other: Any) -> Slope:
        if self.value.contains(0):
            raise ZeroDivisionError("a divisor that may vanish in a box")
        inverse = 1 / self.value
        slope = -other * inverse * inverse
        return Slope(other * inverse, [slope * x for x in self.slopes])
