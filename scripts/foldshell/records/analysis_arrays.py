"""analysis.npz, final.npz, iterations.npz, classes.npz and memory.npz: arrays of the loop.

Axes: P sized panels, B panels of an edge beam, E elements, K result cells of an element, C
combinations (strength first), N nodes, D unknowns of the shell model, F those that are free, M
linearised constraints.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.records.arrays import array


@dataclass(frozen=True, kw_only=True)
class AnalysisArrays:
    """The arrays of analysis.npz; those that only some analyses have are None elsewhere."""

    thickness: np.ndarray = array("P", "m", "thickness that was analysed", required=True)
    buckling_modes: np.ndarray | None = array(
        "F, C", "m and rad", "buckling mode of each combination, of any size"
    )
    utilization_panel_mean: np.ndarray | None = array("P", "-", "area mean over a panel")
    utilization_element_max: np.ndarray | None = array("P", "-", "largest result cell of a panel")
    utilization_strip: np.ndarray | None = array(
        "P", "-", "largest facet or strip mean of a panel, where the loop sizes by it"
    )
    utilization_reinforced: np.ndarray | None = array(
        "P", "-", "largest share of what steel and concrete allow, where the loop sizes by it"
    )
    edge_beam_utilization_panel_mean: np.ndarray | None = array(
        "B", "-", "area mean over a panel of the edge beam"
    )
    edge_beam_utilization_element_max: np.ndarray | None = array(
        "B", "-", "largest result cell of a panel of the edge beam"
    )
    edge_beam_utilization_strip: np.ndarray | None = array(
        "B", "-", "largest facet or strip mean of a panel of the edge beam"
    )
    edge_beam_utilization_reinforced: np.ndarray | None = array(
        "B", "-", "nothing: an edge beam carries its own weight alone"
    )
    edge_beam_panel: np.ndarray | None = array("B", "", "panel of the sheet that holds each")
    panel_fixed: np.ndarray | None = array(
        "P", "", "whether a panel keeps its thickness; this and the next three where a person asked"
    )
    panel_least: np.ndarray | None = array("P", "m", "least thickness of its own, nan for none")
    panel_largest: np.ndarray | None = array("P", "m", "largest thickness of its own, nan for none")
    panel_group: np.ndarray | None = array(
        "P", "", "panels of one number from 1 on take one thickness, 0 for none"
    )
    displacement: np.ndarray | None = array(
        "D, C", "m and rad", "unknowns of the last state of a loop"
    )
    imposed_strain: np.ndarray | None = array(
        "E, 2, C", "- and 1/m", "strain and curvature by temperature, where there is any"
    )
    utilization_cell: np.ndarray | None = array(
        "E, K", "-", "utilization of result cells, last state of a loop"
    )
    governing_combination: np.ndarray | None = array(
        "E, K", "", "number of the strength combination that governs a cell, from 0"
    )
    translations: np.ndarray | None = array(
        "N, 3, C", "m", "displacements of nodes, last state of a loop"
    )
    constraint_value: np.ndarray | None = array(
        "M", "-", "values g of the linearised constraints, g <= 1 is due"
    )
    constraint_gradient: np.ndarray | None = array("M, P", "1/m", "their gradients by thickness")
    thinning_steps: np.ndarray | None = array(
        "P", "", "steps by which a panel may thin under those limits: 0, 1 or 2"
    )
    panel_area: np.ndarray | None = array("P", "m2", "areas of panels, where there are gradients")

    def utilization(self, measure: str) -> np.ndarray | None:
        """Return the utilization (P,) of panels by a measure, None where there is none.

        Without unit.
        """
        return getattr(self, f"utilization_{measure}")

    def edge_beam_utilization(self, measure: str) -> np.ndarray | None:
        """Return that of the panels of the edge beam (B,), None where there is none.

        Without unit.
        """
        return getattr(self, f"edge_beam_utilization_{measure}")


@dataclass(frozen=True, kw_only=True)
class IterationsArrays:
    """The arrays of iterations.npz: I iterations of a loop, one after the other."""

    thickness: np.ndarray = array("I, P", "m", "thickness in each iteration", required=True)
    utilization_panel_mean: np.ndarray = array(
        "I, P", "-", "area mean over a panel in each iteration; nan without an answer",
        required=True,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class ClassesArrays:
    """The arrays of classes.npz."""

    utilization_panel_mean: np.ndarray | None = array("P", "-", "area mean over a panel")
    thickness: np.ndarray | None = array("P", "m", "thickness of each panel's class")
    panel_class: np.ndarray | None = array("P", "", "class of each panel, from 1")


@dataclass(frozen=True, kw_only=True)
class StepMemory:
    """The arrays of memory.npz: what a step leaves to the one after it."""

    step: np.ndarray = array("P", "-", "relative step of each panel", required=True)
    direction: np.ndarray = array("P", "", "its last change: -1, 0, 1", required=True)
    sign_changes: np.ndarray = array("P", "", "how often that changed sign", required=True)
    stable: np.ndarray = array("Q", "m", "last stable thickness, empty for none", required=True)
    failures: np.ndarray = array("", "", "analyses in a row without a stable state", required=True)
