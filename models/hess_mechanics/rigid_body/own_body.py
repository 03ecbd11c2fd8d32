"""A user-defined rigid body: a fixed point, a linear constraint, a gyrostatic momentum, a polynomial potential.

State y = (ω1, ω2, ω3, γ1, γ2, γ3), followed by (cos Ωt, sin Ωt, W) if there is a drive.  With M = Iω + K,

    I ω̇ = M × ω + γ × ∂U/∂γ − K̇ + λ a,   γ̇ = γ × ω,   (a, ω) = 0,

where K = k + d p(cos Ωt, sin Ωt) is the momentum of the rotors, p a polynomial.  The multiplier λ keeps (a, ω) = 0;
without a constraint it is 0.  The drive does the work W, Ẇ = −(K̇, ω), so that E − W is constant, E = (Iω, ω)/2 + U.
For a = e3 and K = 0 these are the equations of the Suslov problem (`Biz01`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from hess_mechanics.dynamics.plane_section import Plane
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, NotPositiveDefinite, WorkLimit
from hess_mechanics.numerics.arguments import as_integer, as_parts
from hess_mechanics.parameters import plain
from hess_mechanics.rigid_body.inertia import BodyCheck, require_finite

__all__ = ["OwnBody", "Polynomial"]

_TERMS, _DEGREE = 20, 6
"""Largest number of terms of a polynomial, and largest degree: the compile time grows with both."""
_FORMS = 300
"""Largest number of forms of the equations that a process compiles: kernels are never freed."""

Vector = tuple[float, float, float]
_NOTHING: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Polynomial:
    """A polynomial in three numbers: γ1, γ2, γ3 of a potential, or cos Ωt, sin Ωt, 0 of a drive.

    Parameters
    ----------
    exponents : tuple of (int, int, int)
        Exponents of the three numbers in each term, ≥ 0, with a sum of at most 6; at most 20 terms.
    coefficients : tuple of float
        Coefficient of each term, any finite number.

    Raises
    ------
    InvalidParameter
        If an argument is not a sequence, there are more than 20 terms or not one coefficient for each, an exponent is
        not an integer from 0 to 6, the degree of a term exceeds 6, or a coefficient is not finite.

    Examples
    --------
    >>> from hess_mechanics import Polynomial
    >>> Polynomial(((1, 0, 0), (0, 0, 2)), (0.5, 1.0))(1.0, 0.0, 2.0)
    4.5
    """

    exponents: tuple[tuple[int, int, int], ...] = ()
    coefficients: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if not np.iterable(self.exponents) or not np.iterable(self.coefficients):
            raise InvalidParameter(
                "The exponents or coefficients are not sequences: write Polynomial(((1, 0, 0), (0, 0, 2)), (0.5, 1.0))."
            )
        if len(self.exponents) != len(self.coefficients) or len(self.exponents) > _TERMS:
            raise InvalidParameter(
                f"There are {len(self.exponents)} terms and {len(self.coefficients)} coefficients: give one "
                f"coefficient for each term, and at most {_TERMS} terms."
            )
        for one in self.exponents:
            if sum(as_integer("An exponent", n, 0, _DEGREE) for n in as_parts("A term", one, 3)) > _DEGREE:
                raise InvalidParameter(
                    f"The degree of the term {one} is more than {_DEGREE}: choose smaller exponents."
                )
        require_finite(**{f"coefficient {i + 1}": one for i, one in enumerate(self.coefficients)})

    def __call__(self, g1: Any, g2: Any, g3: Any) -> Any:
        """Return the value at a point.

        Parameters
        ----------
        g1, g2, g3 : float or ndarray
            The three numbers; arrays broadcast.

        Returns
        -------
        float or ndarray
            The value; 0 if there are no terms.
        """
        return _value(self.exponents, self.coefficients, (g1, g2, g3))


def _value(exponents: Sequence[Sequence[int]], c: Sequence[Any], g: Sequence[Any]) -> Any:
    return sum(
        ck * _power(g[0], i) * _power(g[1], j) * _power(g[2], k) for ck, (i, j, k) in zip(c, exponents, strict=True)
    )


def _power(x: Any, n: int) -> Any:
    """Return xⁿ as products, which all kinds of numbers have; 1 for n = 0."""
    return x * _power(x, n - 1) if n > 1 else x if n else 1


def _slope(exponents: Sequence[Sequence[int]], c: Sequence[Any], g: Sequence[Any], i: int) -> Any:
    """Return the derivative with respect to g[i]."""
    lower = [
        (one[i] * ck, [n - (k == i) for k, n in enumerate(one)]) for ck, one in zip(c, exponents, strict=True) if one[i]
    ]
    return _value([one for _, one in lower], [ck for ck, _ in lower], g)


def _cross(a: Sequence[Any], b: Sequence[Any]) -> tuple[Any, Any, Any]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _rows(I: Sequence[Any]) -> tuple[Sequence[Any], ...]:
    """Return the rows of the symmetric matrix I = (I11, I22, I33, I12, I13, I23)."""
    I11, I22, I33, I12, I13, I23 = I
    return (I11, I12, I13), (I12, I22, I23), (I13, I23, I33)


def _times(rows: Sequence[Sequence[Any]], x: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(_dot(row, x) for row in rows)


def _inverse(rows: Sequence[Sequence[Any]]) -> tuple[Sequence[Any], ...]:
    """Return the rows of the inverse of a symmetric matrix."""
    first, second, third = rows
    cofactors = _cross(second, third), _cross(third, first), _cross(first, second)
    determinant = _dot(first, cofactors[0])
    return tuple(tuple(one / determinant for one in row) for row in cofactors)


Exponents = tuple[tuple[int, int, int], ...]


@cache
def _system(exponents: Exponents, is_constrained: bool, drive: Exponents) -> System:
    """Return the equations of all bodies whose potential and drive have these terms; an empty `drive` means none."""
    is_driven = bool(drive)
    names = [*("I11", "I22", "I33", "I12", "I13", "I23"), *("k1", "k2", "k3")]
    names += ["a1", "a2", "a3"] if is_constrained else []
    names += ["d1", "d2", "d3", "Omega", *(f"p{i + 1}" for i in range(len(drive)))] if is_driven else []
    last = len(names)

    def split(p: Sequence[Any]) -> tuple[Sequence[Any], ...]:
        """Return the rows of I, then k, a (0 if free), (d, Ω, coefficients of p) and the coefficients of U."""
        first = 12 if is_constrained else 9
        return _rows(p[:6]), p[6:9], p[9:12] if is_constrained else _NOTHING, p[first:last], p[last:]

    def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
        I, k, a, driven, c = split(p)
        omega, gamma = y[:3], y[3:6]
        K: Sequence[Any] = k
        change: Sequence[Any] = _NOTHING
        moved: tuple[Any, ...] = ()
        if is_driven:
            (*d, Omega), shape, phase = driven[:4], driven[4:], (y[6], y[7], 0)
            K = [ki + di * _value(drive, shape, phase) for ki, di in zip(k, d, strict=True)]
            along, across = (_slope(drive, shape, phase, i) for i in (0, 1))
            rate = Omega * (across * y[6] - along * y[7])
            change = [di * rate for di in d]
            moved = -Omega * y[7], Omega * y[6], -_dot(change, omega)
        M = [one + other for one, other in zip(_times(I, omega), K, strict=True)]
        forces = _cross(gamma, [_slope(exponents, c, gamma, i) for i in range(3)])
        torque = [one + other - rate for one, other, rate in zip(_cross(M, omega), forces, change, strict=True)]
        inverse = _inverse(I)
        rates = _times(inverse, torque)
        if is_constrained:
            reaction = _times(inverse, a)
            multiplier = _dot(a, rates) * (1 / _dot(a, reaction))
            rates = tuple(rate - multiplier * one for rate, one in zip(rates, reaction, strict=True))
        return (*rates, *_cross(gamma, omega), *moved)

    def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
        I, k, a, _, c = split(p)
        omega, gamma = y[:3], y[3:6]
        E = _dot(_times(I, omega), omega) / 2 + _value(exponents, c, gamma)
        values = {"E − W": E - y[8]} if is_driven else {"E": E}
        values["γ²"] = _dot(gamma, gamma)
        if is_constrained:
            values["(a, ω)"] = _dot(a, omega)
        elif not is_driven:
            values["(M, γ)"] = _dot([one + other for one, other in zip(_times(I, omega), k, strict=True)], gamma)
        return values

    state = (0.5, 0.4, 0.0, 0.6, 0.0, 0.8, *((1.0, 0.0, 0.0) if is_driven else ()))
    values = [2.0, 1.5, 1.0, 0.0, 0.1, 0.2, 0.0, 0.0, 0.3]
    values += [0.0, 0.0, 1.0] if is_constrained else []
    values += [0.0, 0.0, 0.5, 1.0, *([1.0] * len(drive))] if is_driven else []
    form, shape = ("_".join("".join(map(str, one)) for one in terms) for terms in (exponents, drive))
    return System(
        f"own_body_{int(is_constrained)}_{shape}_{form}",
        field,
        ("ω1", "ω2", "ω3", "γ1", "γ2", "γ3", *(("cosΩt", "sinΩt", "W") if is_driven else ())),
        (*names, *(f"c{i + 1}" for i in range(len(exponents)))),
        (state, (*values, *([0.5] * len(exponents)))),
        title="Your own body",
        integrals=integrals,
    )


@dataclass(frozen=True)
class OwnBody:
    """A body with a fixed point in a polynomial potential, optionally with a linear constraint and with rotors.

    Parameters
    ----------
    inertia : tuple of float, shape (6,)
        I11, I22, I33, I12, I13, I23, positive definite; their unit is the unit I.
    potential : Polynomial, optional
        The potential U(γ), in units I/T².  By default 0.
    constraint : (float, float, float), optional
        The vector a of the constraint (a, ω) = 0, nonzero; None for a free body.
    momentum : (float, float, float), optional
        Constant part k of the gyrostatic momentum, in units I/T.  By default 0.
    drive : (float, float, float), optional
        Amplitude d of its periodic part d p(cos Ωt, sin Ωt), in units I/T.  By default 0, which means no drive.
    frequency : float, default 1.0
        Frequency Ω of the drive, any finite number, in rad/T.
    shape : Polynomial, optional
        The polynomial p.  By default p = cos Ωt.

    Raises
    ------
    InvalidParameter
        If a number is not finite, an argument has the wrong number of components, or a = 0.
    NotPositiveDefinite
        If the inertia tensor is not positive definite.

    References
    ----------
    `Biz01`.

    Examples
    --------
    >>> from hess_mechanics import OwnBody, solve
    >>> top = OwnBody((3.0, 2.0, 1.0, 0.0, 0.0, 0.0))
    >>> str(solve(top, top.start((0.1, 1.0, 0.1), (0.0, 0.0, 1.0)), [1.0], "precise").status)
    'ok'
    """

    inertia: tuple[float, float, float, float, float, float]
    potential: Polynomial = Polynomial()
    constraint: Vector | None = None
    momentum: Vector = _NOTHING
    drive: Vector = _NOTHING
    frequency: float = 1.0
    shape: Polynomial = Polynomial(((1, 0, 0),), (1.0,))

    def __post_init__(self) -> None:
        for name, count in (("inertia", 6), ("momentum", 3), ("drive", 3)):
            as_parts(name, getattr(self, name), count)
        constraint = () if self.constraint is None else as_parts("constraint", self.constraint, 3)
        numbers = (*self.inertia, *constraint, *self.momentum, *self.drive, self.frequency)
        require_finite(
            **{
                f"number {i + 1} of inertia, constraint, momentum, drive, frequency": value
                for i, value in enumerate(numbers)
            }
        )
        if not self._moments[0] > 0.0:
            raise NotPositiveDefinite(
                "The inertia tensor is not positive definite: choose larger moments I11, I22, I33, or smaller products "
                "I12, I13, I23."
            )
        if self.constraint is not None and not any(self.constraint):
            raise InvalidParameter("The vector a of the constraint is 0: choose a nonzero one, or no constraint.")

    @property
    def _moments(self) -> Any:
        """The principal moments of inertia (3,), in increasing order."""
        return np.linalg.eigvalsh(_rows(self.inertia))

    @property
    def check(self) -> BodyCheck:
        """The check of the triangle inequality for the principal moments; a flat body satisfies it with equality."""
        small, middle, large = self._moments
        is_body = bool(small + middle >= large * (1.0 - 1e-12))
        inequality = f"{plain(small, 4)} + {plain(middle, 4)} {'≥' if is_body else '<'} {plain(large, 4)}"
        words = "A rigid body" if is_body else "Not a rigid body, yet the equations are shown"
        return BodyCheck(is_body, None, f"{words}: the principal moments satisfy {inequality}.")

    @property
    def is_driven(self) -> bool:
        """True if the equations contain the drive: d is nonzero and p has terms."""
        return any(self.drive) and bool(self.shape.exponents)

    @property
    def surface(self) -> Plane:
        """The plane of the section: γ3 = 0, upward crossings; with a drive and Ω ≠ 0, Ωt = 2πn, once per period."""
        is_periodic = self.is_driven and self.frequency != 0.0
        variable = "sinΩt" if is_periodic else "γ3"
        normal = tuple(float(name == variable) for name in self.system.variables)
        return Plane(normal, sense=-1 if is_periodic and self.frequency < 0.0 else 1)

    @property
    def system(self) -> System:
        """The equations of motion, shared by all bodies with the same terms of potential and drive.

        Raises
        ------
        WorkLimit
            If 300 forms of equations, that is, sets of terms, have been compiled in this process.
        """
        if _system.cache_info().currsize >= _FORMS:
            raise WorkLimit(f"{_FORMS} forms of equations have been compiled here: restart the program.")
        drive = self.shape.exponents if self.is_driven else ()
        return _system(self.potential.exponents, self.constraint is not None, drive)

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters: inertia, k, a if constrained, d, Ω and coefficients of p if driven, coefficients of U."""
        drive = (*self.drive, self.frequency, *self.shape.coefficients) if self.is_driven else ()
        return (*self.inertia, *self.momentum, *(self.constraint or ()), *drive, *self.potential.coefficients)

    def start(self, omega: Sequence[float], gamma: Sequence[float]) -> tuple[float, ...]:
        """Return the initial state for an angular velocity and a vertical.

        Parameters
        ----------
        omega : sequence of float, shape (3,)
            Angular velocity, in rad/T; its component along a is removed if there is a constraint.
        gamma : sequence of float, shape (3,)
            Direction of the vertical; it is normalised.

        Returns
        -------
        tuple of float, shape (6,) or (9,)
            State (ω, γ), with a drive (ω, γ, 1, 0, 0).

        Raises
        ------
        InvalidParameter
            If the vertical is 0 or contains NaN.
        """
        w, g = np.array(omega, float), np.array(gamma, float)
        length = float(np.linalg.norm(g))
        if not length > 0.0:
            raise InvalidParameter("The vertical γ is 0 or not a number: give a nonzero vector.")
        if self.constraint is not None:
            a = np.array(self.constraint) / np.linalg.norm(self.constraint)
            w = w - (a @ w) * a
        return (*w.tolist(), *(g / length).tolist(), *((1.0, 0.0, 0.0) if self.is_driven else ()))
