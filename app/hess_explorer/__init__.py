"""Python interface of the explorer: the data and pictures of any state, without the page.

>>> import hess_explorer as hess
>>> state = hess.state("suslov-hess", h=1.2, f=0.3, accuracy="draft")
>>> state.data("circle").layer("stable")["phi"].round(3)
array([-2.283])

The package `hess_mechanics` holds the mechanics, `hess_explorer.sweep` the parameter sweeps.  `hess-explorer docs`
builds and opens the documentation.
"""

import lazy_loader

# The names of the stub file are imported on first use, so that computations load no plotting library.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
