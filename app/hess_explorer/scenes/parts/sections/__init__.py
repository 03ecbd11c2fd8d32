"""Sections: their orbits, and results about them."""

from hess_explorer.scenes.parts.sections.branch import (
    SectionBranch,
    branch_picture,
    coordinate_of_branch,
    end_of_branch,
    parameter_of_branch,
)
from hess_explorer.scenes.parts.sections.clicks import Clicks, filled_section, orbits_spread, points_of_each
from hess_explorer.scenes.parts.sections.indicator import MEGNO, Indicator, colouring
from hess_explorer.scenes.parts.sections.orbit import BodyOrbit, orbit_picture
from hess_explorer.scenes.parts.sections.periodic_orbit import (
    SectionPeriodicOrbit,
    choice_of_orbit,
    length_of_manifolds,
    periodic_layers,
)
from hess_explorer.scenes.parts.sections.pictures import filled_picture, section_layers, section_picture, section_trials
from hess_explorer.scenes.parts.sections.section import (
    Section,
    crossings_of_each,
    first_point,
    start_on,
)
from hess_explorer.scenes.parts.sections.workbench import PLAIN, FilledState, SectionState

__all__ = [
    "MEGNO",
    "PLAIN",
    "BodyOrbit",
    "Clicks",
    "FilledState",
    "Indicator",
    "Section",
    "SectionBranch",
    "SectionPeriodicOrbit",
    "SectionState",
    "branch_picture",
    "choice_of_orbit",
    "colouring",
    "coordinate_of_branch",
    "crossings_of_each",
    "end_of_branch",
    "filled_picture",
    "filled_section",
    "first_point",
    "length_of_manifolds",
    "orbit_picture",
    "orbits_spread",
    "parameter_of_branch",
    "periodic_layers",
    "points_of_each",
    "section_layers",
    "section_picture",
    "section_trials",
    "start_on",
]
