"""Symmetries and reversors: changes of sign S of the states with S f = ±f∘S.

With the upper sign, S maps motions to motions; with the lower one, to motions backward in time: S is a reversor.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.system import System
from hess_mechanics.numerics.results import Array

__all__ = ["Mirror", "sign_symmetries"]

_TRIED = 6


@dataclass(frozen=True)
class Mirror:
    """A symmetry or a reversor that changes signs of variables.

    Attributes
    ----------
    name : str
        Name, such as "ω1, ω2, t → −".
    signs : ndarray, shape (d,)
        Factor of each variable, 1 or −1.
    reverses : bool
        True for a reversor, False for a symmetry.
    """

    name: str
    signs: Array
    reverses: bool

    def image(self, state: Array) -> Array:
        """Return the mirror image of a state.

        Parameters
        ----------
        state : ndarray, shape (d,)
            The state.

        Returns
        -------
        ndarray, shape (d,)
            Its image.
        """
        return self.signs * state


def sign_symmetries(system: System, parameters: Sequence[float]) -> tuple[Mirror, ...]:
    """Return all sign changes of variables that map motions to motions, forward or backward in time.

    Every combination of signs but the identity is tested at six states in general position, to round-off.

    Parameters
    ----------
    system : System
        The equations of motion.
    parameters : sequence of float, shape (q,)
        Values of the parameters.

    Returns
    -------
    tuple of Mirror
        Symmetries and reversors.

    Examples
    --------
    >>> from hess_mechanics import systems
    >>> from hess_mechanics.dynamics.symmetry import sign_symmetries
    >>> suslov = systems()["suslov"]
    >>> [one.name for one in sign_symmetries(suslov, suslov.example[1])]
    ['ω1, ω2, t → −']
    """
    d = len(system.variables)
    states = np.cos(1.0 + np.arange(d * _TRIED).reshape(d, _TRIED) ** 2).T
    # A field may be defined only in a part of the space.
    with np.errstate(all="ignore"):
        rates = system.rates(states, parameters)
    size = float(np.abs(rates).max()) or 1.0
    mirrors = []
    for choice in itertools.product((1.0, -1.0), repeat=d):
        signs = np.array(choice)
        if np.all(signs > 0.0):
            continue
        with np.errstate(all="ignore"):
            there, here = system.rates(signs * states, parameters), signs * rates
        for reverses, image in ((False, here), (True, -here)):
            if float(np.abs(there - image).max()) < 1e-13 * size:
                changed = [name for name, sign in zip(system.variables, choice, strict=True) if sign < 0.0]
                mirrors.append(Mirror(f"{', '.join([*changed, *(['t'] if reverses else [])])} → −", signs, reverses))
    return tuple(mirrors)
