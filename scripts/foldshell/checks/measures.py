"""Measures: from a state of stress to one utilization per panel, which the loop sizes by.

A measure is a function of a `StressState`; what is added to `MEASURES` under a name that the
setting `sizing.measure` knows is computed, written and held against the limit as the others are.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldshell.checks.concrete.model import ConcreteModel
from foldshell.checks.concrete.use import PanelUse, find_panel_use
from foldshell.checks.strips import Strips, largest_of_panels, utilization_of_strips
from foldshell.checks.utilization import Utilization, panel_utilization
from foldshell.settings.material import Material
from foldshell.shell.analysis import ShellModel
from foldshell.shell.stress import StressResultants, stress_resultants


@dataclass(frozen=True)
class StressState:
    """Displacements (dofs, c) m and rad of the strength combinations, thickness (E,) m, the
    utilization at points, the strips of the model, None where no measure asks for them, imposed
    strains (E, 2, c or more) and what reinforcement is designed with, None for none."""

    model: ShellModel
    displacement: np.ndarray
    thickness: np.ndarray
    material: Material
    utilization: Utilization
    strips: Strips | None = None
    imposed: np.ndarray | None = None
    concrete: ConcreteModel | None = None

    @cached_property
    def resultants(self) -> StressResultants:
        """Membrane forces and moments of all elements."""
        modulus, columns = self.material.youngs_modulus, self.displacement.shape[1]
        imposed = None if self.imposed is None else self.imposed[..., :columns]
        found = self.displacement, self.thickness, modulus, imposed
        return stress_resultants(self.model.operators, *found)

    @cached_property
    def strip_utilization(self) -> np.ndarray:
        """Utilization of each strip and facet in each combination, (S, c). Without unit."""
        found = self.resultants, self.thickness, self.material
        return utilization_of_strips(self.strips, *found)

    @cached_property
    def reinforced(self) -> PanelUse:
        """Shares of what steel and concrete allow, of the sized panels."""
        panels = self.concrete.panels
        first = np.unique(self.model.mesh.panel, return_index=True)[1][:panels]
        names = tuple(self.concrete.asked.sizing_checks)
        return find_panel_use(self.concrete, self.resultants, self.thickness[first], names)


@dataclass(frozen=True)
class Measure:
    """`panels` gives the utilization of all panels (P,), `combinations` that of one panel in each
    strength combination (c,), which tells what governs it."""

    panels: Callable[[StressState], np.ndarray]
    combinations: Callable[[StressState, int], np.ndarray]


def _mean(state: StressState) -> np.ndarray:
    return panel_utilization(state.model, state.utilization.cell, "panel_mean")


def _mean_of(state: StressState, panel: int) -> np.ndarray:
    own = np.flatnonzero(state.model.mesh.panel == panel)
    cells = state.utilization.combination[:, own].mean(axis=3)
    return cells.mean(axis=2) @ state.model.operators.geometry.area[own]


def _largest(state: StressState) -> np.ndarray:
    return panel_utilization(state.model, state.utilization.cell, "element_max")


def _largest_of(state: StressState, panel: int) -> np.ndarray:
    own = np.flatnonzero(state.model.mesh.panel == panel)
    return state.utilization.combination[:, own].mean(axis=3).max(axis=(1, 2))


def _strip(state: StressState) -> np.ndarray:
    return largest_of_panels(state.strips, state.strip_utilization.max(axis=1))


def _strip_of(state: StressState, panel: int) -> np.ndarray:
    return state.strip_utilization[state.strips.panel == panel].max(axis=0)


def _reinforced(state: StressState) -> np.ndarray:
    """The panels of an edge beam carry nothing but their own weight: they count as unused."""
    beam = np.zeros(len(state.model.fixed_thickness))
    return np.concatenate([state.reinforced.largest, beam])


def _reinforced_of(state: StressState, panel: int) -> np.ndarray:
    """Only the combination that governs has a share: those of others are not kept."""
    shares = np.zeros(state.displacement.shape[1])
    shares[state.reinforced.governing[panel]] = state.reinforced.largest[panel]
    return shares


MEASURES = {
    "panel_mean": Measure(_mean, _mean_of),
    "element_max": Measure(_largest, _largest_of),
    "strip": Measure(_strip, _strip_of),
    "reinforced": Measure(_reinforced, _reinforced_of),
}
"""The area mean over the cells of a panel, its largest cell, the largest of facet means and means
over strips along its folds and borders, and the largest share of what steel and concrete allow."""

ALWAYS = ("panel_mean", "element_max")
"""Measures that every analysis says, whatever it sizes by."""

NEED_STRIPS = ("strip",)
"""Measures that are taken from strips."""
