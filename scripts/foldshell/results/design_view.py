"""What pictures, pages and exports of a design share: its final state, creases, limits."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from foldshell.results.creases import Creases, find_creases
from foldshell.results.fields import choose_strength, membrane_force_coefficients
from foldshell.results.principal_stress_lines import (
    PrincipalStressLine,
    make_force_field,
    trace_principal_stress_lines,
)
from foldshell.results.state import DesignState


@dataclass(frozen=True)
class Limits:
    """What a design is judged by: utilization (-), span over displacement (-)."""

    utilization_max: float = 1.0
    displacement_limit_span_over: float = 240.0


@dataclass(frozen=True)
class Elasticity:
    """Young's modulus kPa and Poisson's ratio."""

    youngs_modulus: float
    poissons_ratio: float


@dataclass(frozen=True)
class DesignView:
    """What all pictures of a design share; `span` m."""

    state: DesignState
    creases: Creases
    span: float
    limits: Limits
    elasticity: Elasticity

    @property
    def size(self) -> float:
        """Length of the diagonal of the sheet's box, m."""
        return float(np.linalg.norm(np.ptp(self.state.cells.nodes, axis=0)))

    @cached_property
    def principal_stress_lines(self) -> tuple[str, list[PrincipalStressLine]]:
        """The combination that governs most, and both families of lines under it."""
        state, spacing, step = self.state, self.size / 60, self.size / 150
        name = choose_strength(state)
        stiffness = (self.elasticity.youngs_modulus, self.elasticity.poissons_ratio)
        coefficients, geometry = membrane_force_coefficients(state, name, *stiffness)
        field = make_force_field(state.mesh, geometry, coefficients)
        return name, trace_principal_stress_lines(field, (0, 1), spacing, step)


def make_design_view(
    state: DesignState,
    span: float,
    limits: Limits,
    elasticity: Elasticity,
    folded: bool = True,
) -> DesignView:
    """Find the creases of a state; those of a smooth shell (`folded` False) are panel borders."""
    creases = find_creases(state.cells, state.folded, folded)
    return DesignView(state, creases, span, limits, elasticity)


def read_limits(settings: Mapping[str, Any]) -> Limits:
    """Return the limits in the plain settings of stage `size`."""
    sizing = settings["sizing"]
    return Limits(sizing["utilization_max"], sizing["displacement_limit_span_over"])


def view_design(
    state: DesignState, settings: Mapping[str, Any], span: float, pattern: str
) -> DesignView:
    """Return the view of a design with the plain settings of stage `size`; span m."""
    material = settings["material"]
    elasticity = Elasticity(material["youngs_modulus"], material["poissons_ratio"])
    return make_design_view(state, span, read_limits(settings), elasticity, pattern != "smooth")


def count_analyses(report: Mapping[str, Any]) -> str:
    """Return the count of analyses in words."""
    count = report.get("iteration", 0) + 1
    return f"{count} {'analysis' if count == 1 else 'analyses'}"
