"""Proofs as certificates: plain data with everything that an independent check of them needs.

Numbers are texts: decimals, or rationals p/q; a pair of them encloses a number.  `tests/check_certificate.py` checks
certificates with intervals of mpmath and shares no code with the prover.
"""

from __future__ import annotations

import platform
from collections.abc import Iterable
from fractions import Fraction
from importlib import metadata
from typing import Any

from hess_mechanics.numerics.balls import Enclosure, flint
from hess_mechanics.suslov_hess.edge import TWO_EQUILIBRIA, EdgeProof
from hess_mechanics.suslov_hess.proof import NO_CYCLE, TWO_CYCLES, Proof

__all__ = ["EDGE_FORMAT", "FORMAT", "certificate", "claim"]

FORMAT = "Suslov–Hess torus, 1"
EDGE_FORMAT = "Suslov–Hess edge, 1"


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


def claim(proof: Proof | EdgeProof) -> str:
    """Return what is proved, in words.

    Parameters
    ----------
    proof : of a torus, or of a circle on the edge.
    """
    place = f"h = {_short(proof.h)}, f = {_short(proof.f)}"
    if isinstance(proof, EdgeProof):
        moves = (
            "has exactly two equilibria, one attracts and one repels the other motions on it; at both the body "
            "turns steadily about the vertical"
            if proof.statement == TWO_EQUILIBRIA
            else "is one periodic orbit"
        )
        return (
            f"Proved: {place} lies on the edge of the possible (h, f), so there is no torus and no limit cycle, "
            f"and n3 = {_short(proof.n)} stays. For a = {_short(proof.a)} the circle of these states {moves}."
        )
    of = f"the torus {place} for a = {_short(proof.a)}"
    if proof.statement == TWO_CYCLES:
        return f"Proved: {of} has exactly two limit cycles, one attracts and one repels."
    if proof.statement == NO_CYCLE:
        return f"Proved: {of} has no limit cycle."
    return f"Undecided at {proof.bits} bits: whether {of} has limit cycles; |trace| is too close to 2."


def certificate(proof: Proof | EdgeProof) -> dict[str, Any]:
    """Return the proof as plain data, for JSON.

    Parameters
    ----------
    proof : of a torus, or of a circle on the edge.

    Returns
    -------
    dict
        Of a torus: trace, two decimals that enclose |t|, also as doubles unless the statement needs more digits;
        trace_ball, the same with all digits; roots, half and steps, see `suslov_hess.proof`, where each step has its
        exact start, radius and bound, its number of terms, and what encloses its matrix.  Of the edge: the fields of
        `EdgeProof`.

    >>> from hess_mechanics import certificate, prove
    >>> certificate(prove("0.5", "0.5", "0.3"))["statement"]
    'no cycle'
    """
    library = flint()
    given = {
        "a": str(proof.a),
        "h": str(proof.h),
        "f": str(proof.f),
        "statement": proof.statement,
        "fixed_points": _pairs(proof.fixed_points),
    }
    versions = {
        "versions": {
            "hess-explorer": _version(),
            "python-flint": library.__version__,
            "flint": library.__FLINT_VERSION__,
            "python": platform.python_version(),
        }
    }
    if isinstance(proof, EdgeProof):
        return {
            "format": EDGE_FORMAT,
            **given,
            "n": str(proof.n),
            "rates": _pairs(proof.rates),
            "period": None if proof.period is None else _pair(proof.period),
            **versions,
        }
    return {
        "format": FORMAT,
        **given,
        "trace": list(proof.trace_decimals),
        "trace_ball": _pair(proof.trace),
        "rotation_number": None if proof.rotation_number is None else _pair(proof.rotation_number),
        "multipliers": _pairs(proof.multipliers),
        "roots": _pairs(proof.roots),
        "half": _pairs(proof.half),
        "steps": [
            {
                "start": str(step.start),
                "radius": str(step.radius),
                "bound": str(step.bound),
                "terms": step.terms,
                "matrix": _pairs(step.matrix),
            }
            for step in proof.steps
        ],
        "bits": proof.bits,
        "seconds": round(proof.seconds, 4),
        **versions,
    }


def _version() -> str:
    try:
        return metadata.version("hess-explorer")
    except metadata.PackageNotFoundError:
        return "run from its source folder, not installed"
