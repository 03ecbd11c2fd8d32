"""Mechanics of the Suslov problem, its Hess case, the Chaplygin ball and the Euler–Poisson equations.

The most used names can be imported from this package.  Each subject has a module of its own, such as `suslov.quartic`;
models/README.md lists them with the paper's equations.  `hess-explorer docs` opens the documentation of all of them.
Functions that are imported from this package check their arguments against their annotations.

Examples
--------
>>> from hess_mechanics import circle_map, level
>>> circle_map(a=0.5, h=1.5, f=0.6, accuracy=level("reference")).kind
'hyperbolic'
"""

from importlib.util import find_spec
from types import FunctionType
from typing import Any

import lazy_loader

# Each module is imported when one of the names in the stub file is first used.
_found, _stub_names, _ = lazy_loader.attach_stub(__name__, __file__)


def _computations() -> dict[str, FunctionType]:
    """Return the public functions of the catalogue by name."""
    from hess_mechanics.catalogue import catalogue

    return {one.function.__name__: one.function for one in catalogue().values()}


def __dir__() -> list[str]:
    """Return the names of the stub and of the catalogue's functions."""
    return sorted({*_stub_names(), *_computations()})


def __getattr__(name: str) -> Any:
    """Return a public object by name; functions check their arguments.  Raises `AttributeError` for other names."""
    if name == "__all__":
        return __dir__()
    try:
        value = _found(name)
    except AttributeError:
        # The import system looks a submodule up here before it imports the module: raise AttributeError then.
        if name.startswith("_") or find_spec(f"{__name__}.{name}") or name not in _computations():
            raise
        value = _computations()[name]
    if isinstance(value, FunctionType):
        from hess_mechanics.numerics.arguments import check_arguments

        value = check_arguments(value)
        value.__module__ = __name__
    globals()[name] = value
    return value
