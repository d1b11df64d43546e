"""The shell mesh in files: arrays for the rules that follow, and a VTU to look at."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.records.arrays import (
    list_arrays,
    make_typed_arrays,
    read_typed_arrays,
    write_typed_arrays,
)
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.settings.support_row import Holding
from foldshell.shell.border import Border
from foldshell.shell.boundary import join_holds, list_nodes, refuse_rigid_motion
from foldshell.shell.curved_panels import PARTS, divide_subdivisions, is_curved, refine_panels
from foldshell.shell.edge_beams import EdgeBeam, facet_edges, free_edges, hang_edge_beam_panels
from foldshell.shell.mesh import ShellMesh, build_mesh, edge_polyline_nodes
from foldshell.shell.reference import lagrange_basis, lattice_points
from foldshell.shell.select import HeldSheet
from foldshell.shell.support_rows import HeldRows, resolve_rows
from foldshell.shell.supports import (
    WHOLE_BORDER,
    find_borders,
    find_support,
    supported_pairs,
)

LABELS = ("zigzag", "strip")


def mesh_folded_sheet(
    folded: Mapping[str, np.ndarray],
    support: Holding,
    subdivisions: int,
    order: int | None = None,
    edge_beam: EdgeBeam | None = None,
    panel_parts: int = PARTS,
) -> dict[str, np.ndarray]:
    """Return the arrays of `mesh.npz`: the mesh, the sheet it covers, and its supports.

    See `build_mesh` for subdivisions and order; a panel of a smooth shell is covered by
    `panel_parts` x `panel_parts` quads on the surface, of half the subdivisions each. `support` is
    one of the words for pinned borders, or the rows of a set of supports.

    Besides the fields of `ShellMesh` these are vertices (V, 3) m, facets (F, 3), facet_panel (F,),
    support_pairs (K, 2) as vertices, support_border (K,) the border of each (`supports.BORDERS`),
    and supported_nodes (S,). With an edge beam its
    vertices, facets and panels stand after those of the sheet, and fixed_thickness (B,) m holds
    the thickness of the last B panels, the edge beam's, which are not sized. Raises `ValueError`
    for supports that hold nothing, or leave the whole free to move.
    """
    if is_curved(folded):
        folded = refine_panels(folded, panel_parts)
        subdivisions = divide_subdivisions(subdivisions)
    vertices, facets = folded["vertices"], folded["facets"]
    rows = None if isinstance(support, str) else resolve_rows(_held_sheet(folded), support)
    pairs = _pin_borders(folded, support) if rows is None else rows.to_arrays()["support_pairs"]
    facet_panel = _list_facet_panels(folded)
    fixed = {}
    if edge_beam is not None:
        edges = free_edges(facets, pairs)
        vertices, facets = hang_edge_beam_panels(vertices, facets, edges, edge_beam.depth)
        fixed["fixed_thickness"] = np.full(len(edges), edge_beam.thickness)
        beams = facet_panel.max() + 1 + np.arange(2 * len(edges)) // 2
        facet_panel = np.concatenate([facet_panel, beams])
    mesh = build_mesh(vertices, facets, facet_panel, subdivisions, order)
    held = _list_borders(mesh, folded, pairs) if rows is None else _list_rows(mesh, rows)
    return {
        **{field.name: np.asarray(getattr(mesh, field.name)) for field in fields(mesh)},
        "vertices": vertices,
        "facets": facets,
        "facet_panel": facet_panel,
        **held,
        **fixed,
    }


def _held_sheet(folded: Mapping[str, np.ndarray]) -> HeldSheet:
    facets = folded["facets"]
    labels = {name: folded[name] for name in LABELS if name in folded}
    panels = _list_facet_panels(folded)
    return HeldSheet(folded["vertices"], facets, panels, labels, folded.get("outline"))


def _list_facet_panels(folded: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the panel (F,) of each facet: of a grid two facets are one."""
    return folded.get("facet_panel", np.arange(len(folded["facets"])) // 2)


def _pin_borders(folded: Mapping[str, np.ndarray], support: str) -> np.ndarray:
    """Return supported facet edges (K, 2) by a word of the table.

    A sheet without zig-zags and strips has one border: all edges of one facet.
    """
    facets, chosen = folded["facets"], find_support(support)
    if "zigzag" in folded:
        return supported_pairs(facet_edges(facets), folded["zigzag"], folded["strip"], chosen)
    if len(chosen.where) < 2:
        raise ValueError(
            f"support {support}: the sheet has no zig-zags and strips: all, or a set of supports, "
            "is allowed"
        )
    if "cut_vertices" in folded:  # openings are no edge that a word could mean
        outer = Border(folded["vertices"], facets, _list_facet_panels(folded)).outer
        return np.sort(np.column_stack([outer, np.roll(outer, -1)]), axis=1)
    return np.sort(free_edges(facets, np.empty((0, 2), dtype=np.int64)), axis=1)


def _list_borders(
    mesh: ShellMesh, folded: Mapping[str, np.ndarray], pairs: np.ndarray
) -> dict[str, np.ndarray]:
    """Return what mesh.npz holds of pinned borders."""
    border = np.full(len(pairs), WHOLE_BORDER)
    if "zigzag" in folded:
        border = find_borders(pairs, folded["zigzag"], folded["strip"])
    return {
        "support_pairs": pairs,
        "support_border": border,
        "supported_nodes": edge_polyline_nodes(mesh, pairs),
    }


def _list_rows(mesh: ShellMesh, rows: HeldRows) -> dict[str, np.ndarray]:
    """Return what mesh.npz holds of a set of supports; refuse one that leaves all free to move."""
    boundary = join_holds(mesh, list(rows.holds))
    refuse_rigid_motion(mesh, boundary.fixed, boundary.springs)
    nodes = np.unique(np.concatenate([list_nodes(mesh, hold) for hold in rows.holds]))
    return {**rows.to_arrays(), "supported_nodes": nodes}


def write_mesh(path: str | Path, arrays: Mapping[str, np.ndarray]) -> None:
    """Write the arrays of `mesh.npz`, as `mesh_folded_sheet` makes them."""
    write_typed_arrays(path, make_typed_arrays(MeshArrays, arrays))


def read_mesh(path: str | Path) -> tuple[ShellMesh, MeshArrays]:
    """Return the mesh and all arrays of `mesh.npz`; raises `InputError` for a damaged file."""
    arrays = read_typed_arrays(path, MeshArrays)
    return mesh_from_arrays(list_arrays(arrays)), arrays


def mesh_from_arrays(arrays: Mapping[str, np.ndarray]) -> ShellMesh:
    """Return the mesh that is part of the arrays of `mesh.npz`."""
    values = {field.name: arrays[field.name] for field in fields(ShellMesh)}
    scalars = {name: int(value) for name, value in values.items() if value.ndim == 0}
    return ShellMesh(**(values | scalars))


def result_mesh(mesh: ShellMesh, vertices: np.ndarray, facets: np.ndarray) -> ShellMesh:
    """Return the linear mesh of result cells: as many along a facet edge as there are subdivisions.

    Its elements are those of `mesh`, in the same order, with the corners of the cells as nodes.

    vertices (V, 3) m, facets (F, 3).
    """
    return build_mesh(vertices, facets, None, mesh.subdivisions, order=mesh.cells)


def cell_triangles(cells: ShellMesh) -> np.ndarray:
    """Return the cells of a result mesh as triangles (E cells^2, 3), in the order of
    `stress.cell_points`.

    They are numbers of the result mesh's nodes.
    """
    size = cells.order
    row = [sum(size + 1 - k for k in range(s)) for s in range(size + 2)]
    upward = [
        (row[s] + r, row[s] + r + 1, row[s + 1] + r) for s in range(size) for r in range(size - s)
    ]
    downward = [
        (row[s] + r + 1, row[s + 1] + r + 1, row[s + 1] + r)
        for s in range(size - 1)
        for r in range(size - 1 - s)
    ]
    return cells.elements[:, np.array(upward + downward)].reshape(-1, 3)


def interpolate_to_cells(mesh: ShellMesh, cells: ShellMesh, translation: np.ndarray) -> np.ndarray:
    """Return node values (N, k) of `mesh` at the nodes of the result mesh.

    `translation` (N', k) is at the nodes of `mesh`; both in m, or in any unit.
    """
    at_corners = lagrange_basis(mesh.order, lattice_points(cells.order))[0]
    values = np.empty((len(cells.nodes), translation.shape[1]))
    values[cells.elements] = np.einsum("qn,enk->eqk", at_corners, translation[mesh.elements])
    return values


def write_mesh_vtu(path: str | Path, mesh: ShellMesh, arrays: Mapping[str, np.ndarray]) -> None:
    """Write the result cells with panel, facet and supported nodes as a VTU (m).

    `arrays` are those of mesh.npz.
    """
    import meshio

    cells = result_mesh(mesh, arrays["vertices"], arrays["facets"])
    per_element = cells.order**2
    supported = np.zeros(len(cells.nodes), dtype=np.int32)
    supported[edge_polyline_nodes(cells, arrays["support_pairs"])] = 1
    if arrays.get("support_vertices") is not None:
        supported[arrays["support_vertices"]] = 1  # vertices are the first nodes
    grid = meshio.Mesh(
        cells.nodes,
        [("triangle", cell_triangles(cells))],
        point_data={"supported": supported},
        cell_data={
            "panel": [np.repeat(mesh.panel, per_element)],
            "facet": [np.repeat(mesh.facet, per_element)],
        },
    )
    with atomic_path(path) as temporary:
        grid.write(temporary, file_format="vtu")
