"""Mechanics of the Suslov problem, its Hess case, the Chaplygin ball and the Euler–Poisson equations.

The most used names can be imported from this package.  Each subject has a module of its own, such as `suslov.quartic`;
models/README.md lists them with the paper's equations.  `hess-explorer docs` opens the documentation of all of them.
Functions that are imported from this package check their arguments against their annotations.

Examples
--------
>>> from hess_mechanics import circle_map, level
>>> circle_map(a=0.5, h=1.5, f=0.6, level=level("reference")).kind
'hyperbolic'
"""

from types import FunctionType
from typing import Any

import lazy_loader

# The names of the stub beside this file; each module is imported when one of its names is used first.
_found, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> Any:
    """Return a name of the package; its functions check their arguments against their annotations."""
    found = _found(name)
    if isinstance(found, FunctionType):
        from hess_mechanics.numerics.arguments import typed

        found = typed(found)
        found.__module__ = __name__
    globals()[name] = found
    return found
