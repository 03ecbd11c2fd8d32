"""What kind of motion this is, and of what kind the dynamics are: conservative, dissipative or mixed.

A motion is told by MEGNO and by its places on a section: chaotic where neighbours part exponentially; else a fixed
point or periodic where the places repeat; else quasi-periodic.  What lies between is undecided.

Dynamics are told by the sets to which one orbit comes forward and backward in time (Gonchenko, Gonchenko, Kazakov
2020): conservative where they are one, dissipative where an attractor and a repeller lie apart, mixed where these have
places in common and are not the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from hess_mechanics.dynamics.megno import CHAOTIC, REGULAR, Megno, megno
from hess_mechanics.dynamics.orbit_diagram import period_of
from hess_mechanics.dynamics.periodic import place_units
from hess_mechanics.dynamics.point_sets import Apart, how_far_apart
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.dynamics.spectrum import volume_sign
from hess_mechanics.errors import InvalidParameter, NoReturn
from hess_mechanics.numerics.accuracy import DRAFT, Level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["Dynamics", "Kind", "Regime", "compared", "dynamics_of", "regime"]

_TOUCHING = 0.01
"""Of the places.  Of 1500 places of sets that touch it was 0.015 to 0.2 from orbit to orbit, of sets apart 0."""


class Kind(IntEnum):
    """Kinds of motions on a section, numbered as in charts."""

    NO_RETURN = 0
    FIXED_POINT = 1
    PERIODIC = 2
    QUASI_PERIODIC = 3
    CHAOTIC = 4
    UNDECIDED = 5

    @property
    def words(self) -> str:
        """For people."""
        return _WORDS[self]


_WORDS = {
    Kind.NO_RETURN: "does not return to the section",
    Kind.FIXED_POINT: "fixed point",
    Kind.PERIODIC: "periodic",
    Kind.QUASI_PERIODIC: "quasi-periodic",
    Kind.CHAOTIC: "chaotic",
    Kind.UNDECIDED: "undecided",
}


@dataclass(frozen=True)
class Regime(Result):
    """The kind of one motion after its transient.

    period : of the places on the section, 0 where they do not repeat; places : (n, d).
    megno : Ȳ after the time t; divergence, divergence_error : the mean of div ẏ, over most of that time.
    """

    kind: Kind
    period: int
    names: tuple[str, ...]
    places: Array
    t: float
    megno: float
    divergence: float
    divergence_error: float
    level: str

    @property
    def volume(self) -> int:
        """−1: phase volume about it shrinks, beyond three times the error; 1: it grows; 0: neither is seen."""
        return int(volume_sign(self.divergence, self.divergence_error))

    @property
    def sentence(self) -> str:
        """For people."""
        kind = f"periodic, period {self.period}" if self.kind is Kind.PERIODIC else self.kind.words
        if self.kind is Kind.NO_RETURN:
            return f"The motion {kind}."
        volume = {-1: "phase volume about it shrinks", 0: "phase volume neither shrinks nor grows, to the error",
                  1: "phase volume about it grows"}[self.volume]
        return f"{kind[0].upper()}{kind[1:]}; {volume}: {self.divergence:.3g} ± {self.divergence_error:.1g}."

    def labels(self) -> Labels:
        """The places, and what was found of them."""
        return Labels({}, {name: (("crossing",), self.places[:, i].copy()) for i, name in enumerate(self.names)},
                      place_units(self.names), {
            "kind": self.kind.words, "period": self.period, "MEGNO": self.megno, "t": self.t,
            "divergence": self.divergence, "divergence error": self.divergence_error, "level": self.level})


def regime(map_: ReturnMap, start: Sequence[float] | Array, transient: int = 300, kept: int = 200, t: float = 200.0
           ) -> Regime:
    """The kind of the motion from a place (d,) of a section, after so many crossings that are left out.

    kept : crossings that are looked at; t : the time of the indicator, after them, in the direction of the map.
    Longer periods than 64, and those of which `kept` has not three, count as quasi-periodic.  Raises as `megno`,
    and `OutsideRegion` where no motion crosses at the place.
    """
    if not (1 <= kept <= 20_000 and 0 <= transient <= 20_000):
        raise InvalidParameter("Up to 20000 crossings are left out, and from 1 to 20000 looked at.")
    orbit = map_.orbit(np.array(start, float), transient + kept)
    if len(orbit) < transient + kept:
        return Regime(Kind.NO_RETURN, 0, map_.names, frozen(orbit), 0.0, 0.0, 0.0, 0.0, map_.level)
    places = orbit[transient:]
    found = _indicated(map_, places[-1], t, map_.accuracy)
    period, settled = period_of(map_.turns, places, map_.promise)
    value = float(found.values[0])
    if value > CHAOTIC:
        kind, period = Kind.CHAOTIC, 0
    elif period:
        kind = Kind.FIXED_POINT if period == 1 else Kind.PERIODIC
    elif value > REGULAR or not settled:
        kind = Kind.UNDECIDED
    else:
        kind = Kind.QUASI_PERIODIC
    return Regime(kind, period, map_.names, frozen(places.copy()), t, value, float(found.divergence[0]),
                  float(found.divergence_error[0]), map_.level)


def _indicated(map_: ReturnMap, place: Array, t: float, level: Level) -> Megno:
    return megno(map_.sheet.system, map_.state_at(place)[None], map_.sheet.parameters, -t if map_.backward else t,
                 level, threads=1)


@dataclass(frozen=True)
class Dynamics(Result):
    """To what one orbit comes forward and backward in time, and how far apart that is.

    attractor, repeller : places (n, d) and (m, d), in the order in which they are passed.
    divergence, divergence_error : the mean of div ẏ on the attractor, over the time t.
    """

    names: tuple[str, ...]
    attractor: Array
    repeller: Array
    apart: Apart
    t: float
    divergence: float
    divergence_error: float
    level: str

    @property
    def verdict(self) -> str:
        """"conservative", "dissipative", "mixed" or "undecided"."""
        volume = int(volume_sign(self.divergence, self.divergence_error))
        if not self.apart.settled:
            return "undecided"
        if self.apart.apart:
            # On sets of no volume, apart: volume must shrink on the one.
            return "dissipative" if volume < 0 else "undecided"
        if self.apart.equal:
            return "conservative" if volume == 0 else "mixed"
        return "mixed" if self.apart.shared >= _TOUCHING and volume < 0 else "undecided"

    def labels(self) -> Labels:
        """The places of both."""
        which = np.repeat(["attractor", "repeller"], [len(self.attractor), len(self.repeller)])
        points = np.concatenate([self.attractor, self.repeller])
        along = ("crossing",)
        return Labels({"set": (along, which)},
                      {name: (along, points[:, i].copy()) for i, name in enumerate(self.names)},
                      place_units(self.names), {
            "verdict": self.verdict, "distance": self.apart.distance, "distance error": self.apart.error,
            "grain": self.apart.grain, "shared": self.apart.shared, "divergence": self.divergence,
            "divergence error": self.divergence_error, "level": self.level})


def dynamics_of(map_: ReturnMap, start: Sequence[float] | Array, transient: int = 500, kept: int = 2000,
                t: float = 1000.0) -> Dynamics:
    """The sets to which the orbit from a place (d,) comes forward and backward in time, and how far apart they are.

    Raises `NoReturn` where it does not come back so often, and as `regime`.
    """
    if not (8 <= kept <= 50_000 and 0 <= transient <= 50_000):
        raise InvalidParameter("Up to 50000 crossings are left out, and from 8 to 50000 looked at.")
    sets = []
    for one in (map_, map_.inverse()):
        orbit = one.orbit(np.array(start, float), transient + kept)
        if len(orbit) < transient + kept:
            way = "backward" if one.backward else "forward"
            raise NoReturn(f"Followed {way} in time, the motion returns {len(orbit)} times only: choose another place.")
        sets.append(frozen(orbit[transient:].copy()))
    return compared(map_, sets[0], sets[1], t)


def compared(map_: ReturnMap, attractor: Array, repeller: Array, t: float) -> Dynamics:
    """The same of two sets of places (n, d) and (m, d) that are known, in the order in which they are passed."""
    found = _indicated(map_, attractor[-1], t, DRAFT)
    return Dynamics(map_.names, attractor, repeller, how_far_apart(map_.turns, attractor, repeller), t,
                    float(found.divergence[0]), float(found.divergence_error[0]), map_.level)
