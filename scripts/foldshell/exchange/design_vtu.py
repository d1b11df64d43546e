"""design.vtu: the final fields of a design on its result cells, for ParaView and the like.

What each field is, and its unit, is said in the file's FieldData (`legend`), beside title, verdict,
combinations and buckling factors. Fields of every combination carry its name (n_S1, m_S1, v_S1,
utilization_S1, displacement_S1, buckling_mode_S1 ...), in single precision; envelopes over the
strength and the deflection combinations end in _max and _min. What an unstable design lacks is
left out.
"""

from pathlib import Path

import numpy as np

from foldshell.exchange.vtu import write_vtu
from foldshell.exchange.vtu_legend import describe_fields, known_factors
from foldshell.records.arrays import list_arrays
from foldshell.results.combination_fields import CombinationFields, evaluate_combinations
from foldshell.results.design_view import DesignView
from foldshell.results.fields import (
    cell_thickness,
    choose_deflection,
    choose_strength,
    principal_forces,
)
from foldshell.results.isolines import utilization_isolines
from foldshell.results.line_spacing import split_lines
from foldshell.results.state import DesignState
from foldshell.settings.field import Factors
from foldshell.settings.material import Material
from foldshell.shell.held_supports import list_supported_vertices
from foldshell.shell.mesh import edge_polyline_nodes
from foldshell.shell.stiffness import ShellOperators


def cell_fields(state: DesignState) -> dict[str, np.ndarray]:
    """Return the cell fields (C,) or (C, 3) that the state allows, by name.

    Units stand in the file's legend.

    Each has the unit that the file's legend states.
    """
    fields: dict[str, np.ndarray] = {
        "panel": state.cell_panel.astype(np.int32),
        "thickness": cell_thickness(state),
    }
    if state.classes is not None:
        edge_beam = state.edge_beam_thickness
        number = np.append(state.classes.panel_class, np.zeros(len(edge_beam), dtype=int))
        thickness = np.append(state.classes.thickness, edge_beam)
        fields["thickness_class"] = number[state.cell_panel].astype(np.int32)
        fields["class_thickness"] = thickness[state.cell_panel]
    if state.utilization is not None:
        fields["utilization"] = state.utilization
        fields["utilization_panel_mean"] = state.panel_utilization[state.cell_panel]
        governing = state.final.governing_combination.ravel() + 1
        fields["governing_combination"] = governing.astype(np.int32)
    return fields


def force_fields(state: DesignState, found: CombinationFields) -> dict[str, np.ndarray]:
    """Return membrane forces and principal forces of the combination that governs most.

    Each is (C,) or (C, 3) over the cells, forces in kN/m, directions without unit.
    """
    name = choose_strength(state)
    number = state.combinations.index(name)
    force, axes = found.force[number], found.axes
    value, direction = principal_forces(force, axes)
    fields = {"nx": force[:, 0], "ny": force[:, 1], "nxy": force[:, 2], "axis_x": axes[:, 0]}
    for k in (0, 1):
        fields[f"n{k + 1}"] = value[:, k]
        fields[f"direction_{k + 1}"] = direction[:, k]
        fields[f"principal_{k + 1}"] = value[:, [k]] * direction[:, k]
    return {**fields, "force_combination": np.full(len(force), number + 1, dtype=np.int32)}


def combination_cell_fields(state: DesignState, found: CombinationFields) -> dict[str, np.ndarray]:
    """Return n, m, v, principal forces and utilization of each combination, and envelopes.

    Each is (C,) to (C, 3) over the cells: n, v in kN/m, m in kNm/m, utilization without unit.
    """
    fields = {}
    for k, name in enumerate(state.combinations):
        value, direction = principal_forces(found.force[k], found.axes)
        fields[f"n_{name}"], fields[f"m_{name}"] = found.force[k], found.moment[k]
        fields[f"v_{name}"] = found.shear[k]
        fields[f"n12_{name}"], fields[f"direction_1_{name}"] = value, direction[:, 0]
    for name, value in zip(state.strength, found.utilization, strict=False):
        fields[f"utilization_{name}"] = value
    strength = len(state.strength)
    for group, own in (("strength", slice(strength)), ("deflection", slice(strength, None))):
        for letter in ("force", "moment", "shear"):
            values = getattr(found, letter)[own]
            name = {"force": "n", "moment": "m", "shear": "v"}[letter]
            fields[f"{name}_{group}_max"] = values.max(axis=0)
            fields[f"{name}_{group}_min"] = values.min(axis=0)
    return {name: values.astype(np.float32) for name, values in fields.items()}


def point_fields(state: DesignState) -> dict[str, np.ndarray]:
    """Return the point fields (N,) or (N, 3) by name. Units stand in the file's legend.

    Each has the unit that the file's legend states.
    """
    supported = np.zeros(len(state.cells.nodes), dtype=np.int32)
    supported[edge_polyline_nodes(state.cells, state.shell.support_pairs)] = 1
    supported[list_supported_vertices(list_arrays(state.shell))] = 1
    fields = {"supported": supported}
    if not state.usable:
        return fields
    name = choose_deflection(state)
    number = np.int32(state.combinations.index(name) + 1)
    fields["displacement"] = state.displacement_at_nodes(name)
    fields["displacement_combination"] = np.full(len(supported), number)
    for name in state.combinations:
        moved = state.displacement_at_nodes(name)
        fields[f"displacement_{name}"] = moved.astype(np.float32)
    for name in known_factors(state):
        fields[f"buckling_mode_{name}"] = state.buckling_mode(name).astype(np.float32)
    return fields


def write_design_vtu(
    path: str | Path,
    state: DesignState,
    material: Material,
    combinations: Factors | None = None,
    operators: ShellOperators | None = None,
) -> None:
    """Write design.vtu: result cells as triangles, nodes in m.

    `material` gives the utilization of every strength combination, `combinations` the factors of
    load cases by name, which the legend then says, `operators` are those of the mesh if at hand.
    Numbers are not compressed: digits of forces are no pattern, and a sixth less of the file is not
    worth half the time of writing it.
    """
    fields = cell_fields(state)
    if state.usable:
        found = evaluate_combinations(state, material, operators)
        fields |= force_fields(state, found) | combination_cell_fields(state, found)
    points = point_fields(state)
    words = describe_fields(state, [*points, *fields], combinations or {})
    write_vtu(path, state.cells.nodes, state.triangles, points, fields, words, packed=False)


def write_lines_vtu(path: str | Path, view: DesignView) -> None:
    """Write design_lines.vtu: principal stress lines and utilization isolines as two-point cells.

    Cell fields: kind (1 and 2: trajectories of n1 and n2; 3: isoline), force [kN/m] (tension
    positive, nan on isolines), utilization [-] (nan on principal stress lines).
    """
    parts = [*_force_parts(view), *_isoline_parts(view)]
    segments = np.concatenate([np.empty((0, 2, 3)), *(part[0] for part in parts)])
    kind, force, level = np.concatenate([np.empty((3, 0)), *(part[1] for part in parts)], axis=1)
    data = {"kind": kind.astype(np.int32), "force": force, "utilization": level}
    cells = np.arange(2 * len(segments)).reshape(-1, 2)
    write_vtu(path, segments.reshape(-1, 3), cells, {}, data)


def _force_parts(view: DesignView) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return segments (S, 2, 3) and rows kind, force, utilization (3, S) of each family."""
    parts = []
    for family in (0, 1) if view.state.usable else ():
        lines = [line for line in view.principal_stress_lines[1] if line.family == family]
        segments, force = split_lines(lines)
        kind = np.full(len(force), family + 1.0)
        parts.append((segments, np.stack([kind, force, np.full(len(force), np.nan)])))
    return parts


def _isoline_parts(view: DesignView) -> list[tuple[np.ndarray, np.ndarray]]:
    if view.state.utilization is None:
        return []
    return [
        (segments, np.repeat([[3.0], [np.nan], [level]], len(segments), axis=1))
        for level, segments in utilization_isolines(view)
    ]
