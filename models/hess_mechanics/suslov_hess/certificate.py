"""Certificates of proofs: plain data with everything that an independent check needs.

Numbers are strings, decimals or rationals p/q; a pair of strings is an interval that encloses a number.
`tests/manual/check_certificate.py` checks certificates with the intervals of mpmath and shares no code with the prover.
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

__all__ = ["EDGE_FORMAT", "FORMAT", "certificate", "statement_text"]

FORMAT = "Suslov–Hess torus, 1"
EDGE_FORMAT = "Suslov–Hess edge, 1"


def _pair(interval: Enclosure) -> list[str]:
    """Return both ends as strings: rationals if they are equal, otherwise decimals."""
    return [str(interval.low)] * 2 if interval.low == interval.high else list(interval.decimals())


def _pairs(intervals: Iterable[Enclosure] | None) -> list[list[str]] | None:
    return None if intervals is None else [_pair(one) for one in intervals]


def _short(number: Fraction) -> str:
    """Return a decimal if it terminates within 100 digits, otherwise p/q."""
    rest = number.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    exact = Enclosure(number, number).decimals(100)
    return exact[0] if rest == 1 and exact[0] == exact[1] else str(number)


def statement_text(proof: Proof | EdgeProof) -> str:
    """Return the result of a proof in words: the proved statement, or that it is undecided.

    Parameters
    ----------
    proof : Proof or EdgeProof
        Proof of a torus, or of a circle on the edge of the region.

    Returns
    -------
    str
        One or two sentences.
    """
    place = f"h = {_short(proof.h)}, f = {_short(proof.f)}"
    if isinstance(proof, EdgeProof):
        moves = (
            "has exactly two equilibria: one attracts, one repels the other motions on it, and at both the body "
            "turns steadily about the vertical"
            if proof.statement == TWO_EQUILIBRIA
            else "is one periodic orbit"
        )
        return (
            f"Proved: {place} lies on the edge of the possible (h, f), so there is no torus and no limit cycle, "
            f"and n3 = {_short(proof.n)} at all times. For a = {_short(proof.a)} the circle of these states {moves}."
        )
    of = f"the torus {place} for a = {_short(proof.a)}"
    if proof.statement == TWO_CYCLES:
        return f"Proved: {of} has exactly two limit cycles: one attracts and one repels."
    if proof.statement == NO_CYCLE:
        return f"Proved: {of} has no limit cycle."
    return f"Undecided at {proof.bits} bits: the intervals do not tell whether {of} has limit cycles."


def certificate(proof: Proof | EdgeProof) -> dict[str, Any]:
    """Return a proof as plain data, for JSON.

    Parameters
    ----------
    proof : Proof or EdgeProof
        Proof of a torus, or of a circle on the edge of the region.

    Returns
    -------
    dict
        The format, the statement, the exact numbers as strings, the enclosures as pairs of strings, and the versions of
        the libraries.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.

    Notes
    -----
    The data of a torus contain `trace`, two decimals that enclose |t|, also after conversion to doubles unless the
    statement needs more digits; `trace_ball`, the same with all digits; `roots`, `half` (the matrix of the half map)
    and `steps`, see `suslov_hess.proof`.  Each step has its exact start, radius and bound, its number of terms, and
    enclosures of its matrix.  The data of a circle on the edge are the attributes of `EdgeProof`.

    Examples
    --------
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
        "half": _pairs(proof.half_turn),
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
