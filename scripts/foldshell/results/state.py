"""The final state of a design, read once for all its pictures and for design.vtu."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays, ClassesArrays
from foldshell.records.arrays import list_arrays, read_typed_arrays
from foldshell.records.iteration import read_iteration
from foldshell.records.sheet_arrays import FoldedArrays, MeshArrays
from foldshell.settings.loads import Combinations
from foldshell.shell.held_supports import list_fixed
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.mesh_files import (
    cell_triangles,
    interpolate_to_cells,
    read_mesh,
    result_mesh,
)


@dataclass(frozen=True)
class DesignState:
    """Geometry and results of a design.

    `mesh` is the shell mesh, `cells` the linear mesh of its result cells and `triangles`
    (C, 3) those cells; `shell`, `folded` hold the arrays of mesh.npz, folded.npz. `strength` and
    `deflection` name the combinations in the order of the displacement columns. `classes` is None
    where there are none. Values of panels (P,) go before those of the edge beam (B,), which have
    panels of their own.
    """

    name: str
    mesh: ShellMesh
    cells: ShellMesh
    triangles: np.ndarray
    shell: MeshArrays
    folded: FoldedArrays
    final: AnalysisArrays
    report: AnalysisRecord
    strength: tuple[str, ...]
    deflection: tuple[str, ...]
    classes: ClassesArrays | None = None

    @property
    def combinations(self) -> tuple[str, ...]:
        """All combinations, strength first."""
        return self.strength + self.deflection

    @property
    def edge_beam_thickness(self) -> np.ndarray:
        """Thickness of the edge beam's panels, (B,) m; empty where there is none."""
        fixed = self.shell.fixed_thickness
        return np.empty(0) if fixed is None else fixed

    @property
    def panel_thickness(self) -> np.ndarray:
        """Thickness of sized panels and edge-beam panels, (P + B,) m."""
        return np.concatenate([self.final.thickness, self.edge_beam_thickness])

    @property
    def panel_utilization(self) -> np.ndarray:
        """Mean utilization of sized panels and edge-beam panels, (P + B,). Without unit."""
        edge_beam = self.final.edge_beam_utilization_panel_mean
        own = self.final.utilization_panel_mean
        return own if edge_beam is None else np.concatenate([own, edge_beam])

    @property
    def cell_panel(self) -> np.ndarray:
        """Panel of each cell, (C,). As numbers."""
        return np.repeat(self.mesh.panel, self.cells.order**2)

    @property
    def usable(self) -> bool:
        """Whether there are finite displacements."""
        moved = self.final.displacement
        return moved is not None and bool(np.isfinite(moved).all())

    @property
    def utilization(self) -> np.ndarray | None:
        """Utilization of each cell (C,), None where the analysis gave none. Without unit."""
        values = self.final.utilization_cell
        return None if values is None else values.ravel()

    def displacement_at_nodes(self, combination: str) -> np.ndarray:
        """Return the displacements (N, 3) m of the result mesh's nodes."""
        column = self.combinations.index(combination)
        return self._at_cells(self.final.displacement[:, column])

    def all_displacements(self) -> np.ndarray:
        """Return those of all combinations at once, (c, N, 3) m."""
        count = len(self.combinations)
        moved = self.final.displacement[: 3 * len(self.mesh.nodes), :count]
        found = interpolate_to_cells(self.mesh, self.cells, moved.reshape(-1, 3 * count))
        return np.moveaxis(found.reshape(-1, 3, count), 2, 0)

    def buckling_mode(self, combination: str) -> np.ndarray:
        """Return a mode (N, 3), scaled to a largest translation of 1. Without unit."""
        column = self.combinations.index(combination)
        free = np.ones(self.mesh.dof_count, dtype=bool)
        free[list_fixed(self.mesh, list_arrays(self.shell))] = False
        mode = np.zeros(self.mesh.dof_count)
        mode[free] = self.final.buckling_modes[:, column]
        mode = self._at_cells(mode)
        largest = np.linalg.norm(mode, axis=1).max()
        return mode / largest if largest > 0 else mode

    def _at_cells(self, dofs: np.ndarray) -> np.ndarray:
        moved = dofs[: 3 * len(self.mesh.nodes)].reshape(-1, 3)
        return interpolate_to_cells(self.mesh, self.cells, moved)


def read_state(
    name: str,
    mesh_path: str | Path,
    folded_path: str | Path,
    final_path: str | Path,
    report_path: str | Path,
    combinations: Combinations,
    classes_path: str | Path | None = None,
) -> DesignState:
    """Read mesh.npz, folded.npz, final.npz, final.json and, if given, classes.npz of a design.

    `combinations` are those of the settings: strength and deflection, by name.

    Raises
    ------
    InputError
        if the final thicknesses are not one for each panel.
    """
    mesh, shell = read_mesh(mesh_path)
    report, final = read_iteration(report_path, final_path)
    classes = read_typed_arrays(classes_path, ClassesArrays) if classes_path else None
    fixed = 0 if shell.fixed_thickness is None else len(shell.fixed_thickness)
    panels = int(mesh.panel.max()) + 1 - fixed
    if final.thickness.shape != (panels,):
        raise InputError(
            f"{final_path}: thickness: {final.thickness.shape}: one for each of {panels} panels"
        )
    cells = result_mesh(mesh, shell.vertices, shell.facets)
    return DesignState(
        name=name,
        mesh=mesh,
        cells=cells,
        triangles=cell_triangles(cells),
        shell=shell,
        folded=read_typed_arrays(folded_path, FoldedArrays),
        final=final,
        report=report,
        strength=tuple(combinations.strength),
        deflection=tuple(combinations.deflection),
        classes=None if classes is None or classes.panel_class is None else classes,
    )
