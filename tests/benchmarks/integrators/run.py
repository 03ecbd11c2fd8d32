"""The whole benchmark."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numba
import numpy as np

from .explorer import METHOD
from .machine import describe
from .measure import FULL, QUICK, measure
from .method import Method
from .peers import PEERS, load
from .report import BenchmarkReport
from .scaling import scaling
from .works import works

__all__ = ["participants", "run"]


def participants() -> tuple[list[Method], dict[str, str]]:
    """Return this project and the installed peers; and the other peers with the reason."""
    methods, missing = [METHOD], {}
    for name in PEERS:
        try:
            methods.append(load(name))
        except ModuleNotFoundError:
            missing[name] = "not installed"
        except (ImportError, OSError) as error:
            missing[name] = f"installed, but it cannot be imported ({error})"
    return methods, missing


def run(
    names: Sequence[str], targets: Sequence[float], quick: bool, progress: Callable[[str], None]
) -> BenchmarkReport:
    """Do the works of these names with every method, and those that can be shared between threads on two."""
    effort = QUICK if quick else FULL
    methods, missing = participants()
    measured = [measure(works()[name], methods, targets, effort, progress) for name in names]
    versions = {method.name: method.version for method in methods}
    versions |= {"numba": numba.__version__, "numpy": np.__version__}
    return BenchmarkReport(
        describe(), versions, missing, targets, measured, scaling(measured, methods, effort, progress)
    )
