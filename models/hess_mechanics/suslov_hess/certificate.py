"""Proofs as certificates: plain data with all that someone else needs to check them, who shares no code with us.

Numbers are texts: decimals, or rationals p/q; two of them enclose what they are of.  `tests/check_certificate.py` is
such a check, with intervals of mpmath.
"""

from __future__ import annotations

import platform
from collections.abc import Iterable
from fractions import Fraction
from importlib import metadata
from typing import Any

from hess_mechanics.numerics.balls import Enclosure, flint
from hess_mechanics.suslov_hess.proof import NO_CYCLE, TWO_CYCLES, Proof

__all__ = ["FORMAT", "certificate", "claim"]

FORMAT = "Suslov–Hess torus, 1"


def _pair(found: Enclosure) -> list[str]:
    """Exact where both ends are one."""
    return [str(found.low)] * 2 if found.low == found.high else list(found.decimals())


def _pairs(found: Iterable[Enclosure] | None) -> list[list[str]] | None:
    return None if found is None else [_pair(one) for one in found]


def _short(number: Fraction) -> str:
    """A decimal where it ends, as the user wrote it; else p/q."""
    rest = number.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    exact = Enclosure(number, number).decimals(100)
    return exact[0] if rest == 1 and exact[0] == exact[1] else str(number)


def claim(proof: Proof) -> str:
    """What is proved, in a sentence."""
    of = f"the torus h = {_short(proof.h)}, f = {_short(proof.f)} for a = {_short(proof.a)}"
    if proof.statement == TWO_CYCLES:
        return f"Proved: {of} has exactly two limit cycles, one attracts and one repels."
    if proof.statement == NO_CYCLE:
        return f"Proved: {of} has no limit cycle."
    return f"Undecided at {proof.bits} bits: whether {of} has limit cycles; |trace| is too close to 2."


def certificate(proof: Proof) -> dict[str, Any]:
    """The proof as plain data, for JSON.

    trace : of |t|, two decimals, which also enclose it as doubles unless the statement needs more digits;
    trace_ball : the same with all digits; roots, half, steps : see `suslov_hess.proof`; each step has start, radius
    and bound, exact, its number of terms, and what encloses its matrix.

    >>> from hess_mechanics import certificate, prove
    >>> certificate(prove("0.5", "0.5", "0.3"))["statement"]
    'no cycle'
    """
    library = flint()
    return {
        "format": FORMAT,
        "a": str(proof.a), "h": str(proof.h), "f": str(proof.f),
        "statement": proof.statement,
        "trace": list(proof.trace_decimals),
        "trace_ball": _pair(proof.trace),
        "rotation_number": None if proof.rotation_number is None else _pair(proof.rotation_number),
        "fixed_points": _pairs(proof.fixed_points),
        "multipliers": _pairs(proof.multipliers),
        "roots": _pairs(proof.roots),
        "half": _pairs(proof.half),
        "steps": [{"start": str(step.start), "radius": str(step.radius), "bound": str(step.bound),
                   "terms": step.terms, "matrix": _pairs(step.matrix)} for step in proof.steps],
        "bits": proof.bits,
        "seconds": round(proof.seconds, 4),
        "versions": {"hess-explorer": _version(), "python-flint": library.__version__,
                     "flint": library.__FLINT_VERSION__, "python": platform.python_version()},
    }


def _version() -> str:
    try:
        return metadata.version("hess-explorer")
    except metadata.PackageNotFoundError:
        return "run from its source folder, not installed"
