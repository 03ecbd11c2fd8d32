"""The whole benchmark."""

import numba
import numpy as np

from .explorer import METHOD
from .machine import describe
from .measure import FULL, QUICK, measure
from .peers import PEERS, load
from .report import BenchmarkReport
from .scaling import scaling
from .works import works


def participants():
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


def run(names, targets, quick, progress):
    """Do the works of these names with every method, and those that can be shared between threads on two."""
    effort = QUICK if quick else FULL
    methods, missing = participants()
    measured = [measure(works()[name], methods, targets, effort, progress) for name in names]
    versions = {method.name: method.version for method in methods}
    versions |= {"numba": numba.__version__, "numpy": np.__version__}
    return BenchmarkReport(
        describe(), versions, missing, targets, measured, scaling(measured, methods, effort, progress)
    )
