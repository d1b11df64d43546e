"""design.vtu: the final fields of a design on its result cells, for ParaView and the like.

Cell fields: panel, thickness [m], thickness_class where classes were made, utilization [-],
utilization_panel_mean [-], governing_combination (1 for the first strength combination),
nx, ny, nxy [kN/m] in the facet's axes (axis_x; normal upward), principal forces n1 >= n2 [kN/m]
with their unit directions, and principal_1, principal_2: direction times force. Point fields:
displacement [m], supported. Membrane forces and displacement belong to the combinations whose
numbers stand in force_combination and displacement_combination, counted on from the strength
combinations. What an unstable design lacks is left out.
"""

from pathlib import Path

import numpy as np

from foldshell.figures.fields import (
    cell_thickness,
    choose_deflection,
    choose_strength,
    membrane_force_cells,
    principal_forces,
)
from foldshell.figures.state import DesignState
from foldshell.shell.mesh import edge_polyline_nodes
from foldshell.study.files import atomic_path


def cell_fields(
    state: DesignState, youngs_modulus: float, poissons_ratio: float
) -> dict[str, np.ndarray]:
    """Return the cell fields (C,) or (C, 3) that the state allows, by name."""
    fields: dict[str, np.ndarray] = {
        "panel": state.cell_panel.astype(np.int32),
        "thickness": cell_thickness(state),
    }
    if "thickness_class" in state.final:
        fields["thickness_class"] = state.final["thickness_class"][state.cell_panel]
    if state.utilization is not None:
        fields["utilization"] = state.utilization
        fields["utilization_panel_mean"] = state.final["utilization_panel_mean"][state.cell_panel]
        governing = state.final["governing_combination"].ravel() + 1
        fields["governing_combination"] = governing.astype(np.int32)
    if state.usable:
        fields |= force_fields(state, youngs_modulus, poissons_ratio)
    return fields


def force_fields(
    state: DesignState, youngs_modulus: float, poissons_ratio: float
) -> dict[str, np.ndarray]:
    """Return membrane forces and principal forces of the combination that governs most."""
    name = choose_strength(state)
    force, axes = membrane_force_cells(state, name, youngs_modulus, poissons_ratio)
    value, direction = principal_forces(force, axes)
    fields = {"nx": force[:, 0], "ny": force[:, 1], "nxy": force[:, 2], "axis_x": axes[:, 0]}
    for k in (0, 1):
        fields[f"n{k + 1}"] = value[:, k]
        fields[f"direction_{k + 1}"] = direction[:, k]
        fields[f"principal_{k + 1}"] = value[:, [k]] * direction[:, k]
    number = state.combinations.index(name) + 1
    return {**fields, "force_combination": np.full(len(force), number, dtype=np.int32)}


def point_fields(state: DesignState) -> dict[str, np.ndarray]:
    """Return the point fields (N,) or (N, 3) by name."""
    supported = np.zeros(len(state.cells.nodes), dtype=np.int32)
    supported[edge_polyline_nodes(state.cells, state.shell["support_pairs"])] = 1
    fields = {"supported": supported}
    if state.usable:
        name = choose_deflection(state)
        number = np.int32(state.combinations.index(name) + 1)
        fields["displacement"] = state.displacement_at_nodes(name)
        fields["displacement_combination"] = np.full(len(supported), number)
    return fields


def write_design_vtu(
    path: str | Path, state: DesignState, youngs_modulus: float, poissons_ratio: float
) -> None:
    """Write design.vtu: result cells as triangles, nodes in m."""
    import meshio

    fields = cell_fields(state, youngs_modulus, poissons_ratio)
    grid = meshio.Mesh(
        state.cells.nodes,
        [("triangle", state.triangles)],
        point_data=point_fields(state),
        cell_data={name: [values] for name, values in fields.items()},
    )
    with atomic_path(path) as temporary:
        grid.write(temporary, file_format="vtu")
