"""What pictures, pages and exports of a design share: its final state, creases, limits."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foldshell.loads.cases import SurfaceLoad, make_load_cases
from foldshell.records.analysis import AnalysisRecord
from foldshell.results.creases import Creases, find_creases
from foldshell.results.fields import choose_strength, membrane_force_coefficients
from foldshell.results.principal_stress_lines import (
    PrincipalStressLine,
    make_force_field,
    trace_principal_stress_lines,
)
from foldshell.results.state import DesignState
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from foldshell.settings.stage import StageSettings
from foldshell.shell.stiffness import ShellOperators, build_operators


@dataclass(frozen=True)
class DesignView:
    """What all pictures of a design share; `span` m, `sizing` with the limits to judge by,
    `loads` of the design's set."""

    state: DesignState
    creases: Creases
    span: float
    sizing: Sizing
    material: Material
    loads: tuple[SurfaceLoad, ...] = ()

    @property
    def size(self) -> float:
        """Length of the diagonal of the sheet's box, m."""
        return float(np.linalg.norm(np.ptp(self.state.cells.nodes, axis=0)))

    @cached_property
    def operators(self) -> ShellOperators:
        """Strain operators of the mesh, which several results share."""
        return build_operators(self.state.mesh, self.material.poissons_ratio)

    @cached_property
    def principal_stress_lines(self) -> tuple[str, list[PrincipalStressLine]]:
        """The combination that governs most, and both families of lines under it."""
        state, spacing, step = self.state, self.size / 75, self.size / 150
        name = choose_strength(state)
        stiffness = (self.material.youngs_modulus, self.material.poissons_ratio)
        coefficients, geometry = membrane_force_coefficients(state, name, *stiffness)
        field = make_force_field(state.mesh, geometry, coefficients)
        return name, trace_principal_stress_lines(field, (0, 1), spacing, step)


def make_design_view(
    state: DesignState,
    span: float,
    sizing: Sizing,
    material: Material,
    folded: bool = True,
) -> DesignView:
    """Find the creases of a state; those of a smooth shell (`folded` False) are panel borders."""
    creases = find_creases(state.cells, state.folded, folded)
    return DesignView(state, creases, span, sizing, material)


def view_design(
    state: DesignState, settings: StageSettings, span: float, pattern: str
) -> DesignView:
    """Return the view of a design with the settings of stage `size`; span m."""
    view = make_design_view(state, span, settings.sizing, settings.material, pattern != "smooth")
    return replace(view, loads=make_load_cases(settings.loads, settings.material.unit_weight))


def count_analyses(report: AnalysisRecord) -> str:
    """Return the count of analyses in words."""
    count = report.iteration + 1
    return f"{count} {'analysis' if count == 1 else 'analyses'}"
