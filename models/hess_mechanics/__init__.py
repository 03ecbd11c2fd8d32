"""Mechanics of the Suslov problem, its Hess case, the Chaplygin ball and the Euler–Poisson equations.

The most used names can be imported from this package.  Each subject has a module of its own, such as `suslov.quartic`;
models/README.md lists them with the paper's equations.  `hess-explorer docs` opens the documentation of all of them.

Examples
--------
>>> from hess_mechanics import circle_map, level
>>> circle_map(a=0.5, h=1.5, f=0.6, level=level("reference")).kind
'hyperbolic'
"""

import lazy_loader

# The names of the stub beside this file; each module is imported when one of its names is used first.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
