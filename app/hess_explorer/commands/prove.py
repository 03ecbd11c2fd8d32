"""`hess-explorer prove`: proves that a Suslov–Hess torus has two limit cycles, or none, with a certificate."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arguments import integer
from .output import computing, show, write_file

if TYPE_CHECKING:
    from hess_mechanics import EdgeProof, Proof

__all__ = ["add"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "prove", help="proves that a Suslov–Hess torus has two limit cycles, or none",
        description="Proves by ball arithmetic that the torus (h, f), units b = 1, has exactly two limit cycles "
                    "(|trace| > 2 of its circle map) or none (|trace| < 2): for the equations with exactly these "
                    "numbers, if the balls of the library Arb enclose what they say.  Where |trace| is too close to "
                    "2 it says “undecided”.  On the edge |f| = f_max(h), where there is no torus but a circle of "
                    "states, it proves that this has exactly two equilibria or is one periodic orbit.  Multipliers, "
                    "fixed points and rotation number are enclosed.  The JSON is a certificate: every Taylor step with "
                    "what bounds its remainder, for an independent check such as tests/check_certificate.py.  "
                    "Needs the extra: pip install 'hess-explorer[prove]'.",
        epilog="Example: hess-explorer prove --a 0.5 --h 1.5 --f 0.6 --format json")
    numbers = {"a": "inertia parameter a = I23/I22", "h": "energy, h > -1", "f": "area integral, |f| ≤ f_max(h)"}
    for name, text in numbers.items():
        parser.add_argument(f"--{name}", required=True, metavar="NUMBER", help=f"{text}; exact: 0.1, -2e-3 or 1/3")
    parser.add_argument("--bits", type=integer(64, 4096), default=512, metavar="N",
                        help="the precision doubles from 64 bits to at most this (default: 512)")
    parser.add_argument("--format", choices=("text", "json"), default="text",
                        help="text (default): what is proved, in words; json: the whole certificate")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write to this file instead of standard output")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    with computing():
        from hess_mechanics import certificate, prove

        proof = prove(options.a, options.h, options.f, options.bits)
        found = certificate(proof)
    if options.format == "json":
        text = json.dumps(found, ensure_ascii=False, allow_nan=False, indent=1)
    else:
        text = "\n".join(_words(proof, found))
    data = f"{text}\n".encode()
    if options.out is not None:
        write_file(options.out, data)
    else:
        show(data)


def _words(proof: Proof | EdgeProof, found: dict[str, Any]) -> Iterator[str]:
    from hess_mechanics import EdgeProof
    from hess_mechanics.suslov_hess.certificate import claim

    yield claim(proof)
    if isinstance(proof, EdgeProof):
        yield from _edge_words(found)
    else:
        yield from _torus_words(found)
    versions = found["versions"]
    effort = "" if isinstance(proof, EdgeProof) else (
        f"{len(proof.steps)} Taylor steps, {proof.bits} bits, {proof.seconds:.2f} s; ")
    yield f"{effort}python-flint {versions['python-flint']}, FLINT {versions['flint']}"
    yield ("This holds for the equations with exactly these numbers, if the library's balls are right; --format json "
           "gives the certificate.")


def _torus_words(found: dict[str, Any]) -> Iterator[str]:
    yield f"|trace| {_interval(found['trace'])}"
    if found["rotation_number"] is not None:
        yield f"rotation number {_interval(found['rotation_number'])}"
    for name, phi, multiplier in zip(("attracting", "repelling"), found["fixed_points"], found["multipliers"],
                                     strict=False):
        yield f"{name} cycle: φ {_interval(phi)}, multiplier {_interval(multiplier)}"


def _edge_words(found: dict[str, Any]) -> Iterator[str]:
    if found["period"] is not None:
        yield f"period {_interval(found['period'])}"
    for name, phi, rate in zip(("attracting", "repelling"), found["fixed_points"], found["rates"], strict=False):
        yield f"{name} equilibrium: φ {_interval(phi)}, rate {_interval(rate)}"


def _interval(pair: list[str]) -> str:
    return f"= {pair[0]}" if pair[0] == pair[1] else f"in [{pair[0]}, {pair[1]}]"
