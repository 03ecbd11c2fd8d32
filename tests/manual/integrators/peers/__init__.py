"""The other integrators, one file each, used as their documentation tells an expert to.

Each has a `METHOD` and imports its library; a peer whose file cannot be imported is left out.
"""

from importlib import import_module

PEERS = {
    "heyoka": "heyoka_peer",
    "numbalsoda": "numbalsoda_peer",
    "CyRK": "cyrk_peer",
    "diffrax": "diffrax_peer",
    "SciPy": "scipy_peer",
}
"""Name → module, in the order of the table's columns."""


def load(name):
    """The peer of that name.  Raises `ImportError` where it is not installed or does not work."""
    return import_module(f".{PEERS[name]}", __name__).METHOD
