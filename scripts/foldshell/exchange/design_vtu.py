"""design.vtu: the final fields of a design on its result cells, for ParaView and the like.

Cell fields: panel, thickness [m], thickness_class (1, 2, ... in rising order) and class_thickness
[m] of the design in classes (sizing/classes.npz), utilization [-], utilization_panel_mean [-],
governing_combination (1 for the first strength combination), nx, ny, nxy [kN/m] in the facet's
axes (axis_x; normal upward), principal forces n1 >= n2 [kN/m] with their unit directions, and
principal_1, principal_2: direction times force. Point fields: displacement [m], supported.
Membrane forces and displacement belong to the combinations whose numbers stand in
force_combination and displacement_combination, counted on from the strength combinations. What an
unstable design lacks is left out.
"""

from pathlib import Path

import numpy as np

from foldshell.exchange.vtu import write_vtu
from foldshell.results.design_view import DesignView, Elasticity
from foldshell.results.fields import (
    cell_thickness,
    choose_deflection,
    choose_strength,
    membrane_force_cells,
    membrane_force_coefficients,
    principal_forces,
)
from foldshell.results.isolines import utilization_isolines
from foldshell.results.principal_stress_lines import split_lines
from foldshell.results.state import DesignState
from foldshell.shell.mesh import edge_polyline_nodes


def cell_fields(state: DesignState, elasticity: Elasticity) -> dict[str, np.ndarray]:
    """Return the cell fields (C,) or (C, 3) that the state allows, by name."""
    fields: dict[str, np.ndarray] = {
        "panel": state.cell_panel.astype(np.int32),
        "thickness": cell_thickness(state),
    }
    if state.classes:
        edge_beam = state.edge_beam_thickness
        number = np.append(state.classes["panel_class"], np.zeros(len(edge_beam), dtype=int))
        thickness = np.append(state.classes["thickness"], edge_beam)
        fields["thickness_class"] = number[state.cell_panel].astype(np.int32)
        fields["class_thickness"] = thickness[state.cell_panel]
    if state.utilization is not None:
        fields["utilization"] = state.utilization
        fields["utilization_panel_mean"] = state.panel_utilization[state.cell_panel]
        governing = state.final["governing_combination"].ravel() + 1
        fields["governing_combination"] = governing.astype(np.int32)
    if state.usable:
        fields |= force_fields(state, elasticity)
    return fields


def force_fields(state: DesignState, elasticity: Elasticity) -> dict[str, np.ndarray]:
    """Return membrane forces and principal forces of the combination that governs most."""
    name = choose_strength(state)
    stiffness = (elasticity.youngs_modulus, elasticity.poissons_ratio)
    found = membrane_force_coefficients(state, name, *stiffness)
    force, axes = membrane_force_cells(*found, state.mesh)
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


def write_design_vtu(path: str | Path, state: DesignState, elasticity: Elasticity) -> None:
    """Write design.vtu: result cells as triangles, nodes in m."""
    fields = cell_fields(state, elasticity)
    write_vtu(path, state.cells.nodes, state.triangles, point_fields(state), fields)


def write_lines_vtu(path: str | Path, subject: DesignView) -> None:
    """Write design_lines.vtu: principal stress lines and utilization isolines as two-point cells.

    Cell fields: kind (1 and 2: trajectories of n1 and n2; 3: isoline), force [kN/m] (tension
    positive, nan on isolines), utilization [-] (nan on principal stress lines).
    """
    parts = [*_force_parts(subject), *_isoline_parts(subject)]
    segments = np.concatenate([np.empty((0, 2, 3)), *(part[0] for part in parts)])
    kind, force, level = np.concatenate([np.empty((3, 0)), *(part[1] for part in parts)], axis=1)
    data = {"kind": kind.astype(np.int32), "force": force, "utilization": level}
    cells = np.arange(2 * len(segments)).reshape(-1, 2)
    write_vtu(path, segments.reshape(-1, 3), cells, {}, data)


def _force_parts(subject: DesignView) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return segments (S, 2, 3) and rows kind, force, utilization (3, S) of each family."""
    parts = []
    for family in (0, 1) if subject.state.usable else ():
        lines = [line for line in subject.principal_stress_lines[1] if line.family == family]
        segments, force = split_lines(lines)
        kind = np.full(len(force), family + 1.0)
        parts.append((segments, np.stack([kind, force, np.full(len(force), np.nan)])))
    return parts


def _isoline_parts(subject: DesignView) -> list[tuple[np.ndarray, np.ndarray]]:
    if subject.state.utilization is None:
        return []
    return [
        (segments, np.repeat([[3.0], [np.nan], [level]], len(segments), axis=1))
        for level, segments in utilization_isolines(subject)
    ]
