"""The folded sheets as plain finite-element models for other codes: nodes, elements, supports.

Flat facets are divided n x n; peers get nodal forces of the same surface loads, lumped by the
shape functions of their elements where these are linear, consistent where they are quadratic.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.loads.cases import make_load_cases, surface_loads
from foldshell.settings.loads import Loads
from foldshell.shell.mesh import build_mesh, edge_polyline_nodes
from foldshell.shell.supports import find_support, supported_pairs
from verification.folded_cases import CONCRETE, FoldedCase, load_sheet

COMBINATION = np.array([1.2, 1.2, 1.6, 0.5, 0.0])
"""Factors of SW, SDL, LL, WX, WY in the combination of the six folded cases."""


@dataclass(frozen=True)
class PeerModel:
    """Nodes (N, 3) m, elements (E, k), supported nodes, forces (N, 3, cases) kN, thickness m."""

    nodes: np.ndarray
    elements: np.ndarray
    supported: np.ndarray
    forces: np.ndarray
    thickness: float


def peer_model(case: FoldedCase, subdivisions: int, shape: str) -> PeerModel:
    """Return the sheet in elements of a shape: "T3", "T6", "Q4" or "Q8" (three a triangle)."""
    sheet = load_sheet(case.sheet)
    order = {"T3": 1, "T6": 2, "Q4": 2, "Q8": 4}[shape]
    linear = build_mesh(sheet["vertices"], sheet["facets"], None, 1, order=subdivisions)
    pieces = _pieces(linear)
    mesh = build_mesh(linear.nodes, pieces, order=order, subdivisions=1)
    pairs = supported_pairs(
        linear.node_pairs, sheet["zigzag"], sheet["strip"], find_support(case.support)
    )
    held = edge_polyline_nodes(linear, pairs)
    ends = np.isin(mesh.node_pairs, held).all(axis=1)
    along = _on_supported_edge(linear, pairs, mesh.node_pairs[ends])
    supported = np.unique(mesh.pair_nodes[ends][along])
    nodes, elements = _elements(mesh, shape)
    forces = _forces(mesh, nodes, elements, case.thickness, shape)
    used, compact = np.unique(elements, return_inverse=True)
    number = np.full(len(nodes), -1)
    number[used] = np.arange(len(used))
    return PeerModel(nodes[used], compact.reshape(elements.shape), number[supported],
                     forces[used], case.thickness)  # fmt: skip


def _pieces(linear) -> np.ndarray:
    """Return the small triangles of all facets, counter-clockwise."""
    from foldshell.shell.mesh_files import cell_triangles

    return cell_triangles(linear)


def _on_supported_edge(linear, pairs, ends) -> np.ndarray:
    """Tell which short edges (K, 2) are pieces of a supported facet edge."""
    rows = np.isin(linear.node_pairs[:, 0] * len(linear.nodes) + linear.node_pairs[:, 1],
                   np.sort(pairs, axis=1) @ [len(linear.nodes), 1])  # fmt: skip
    chains = linear.pair_nodes[rows]
    short = np.sort(np.stack([chains[:, :-1], chains[:, 1:]], axis=2).reshape(-1, 2), axis=1)
    keys = np.sort(ends, axis=1) @ [len(linear.nodes), 1]
    return np.isin(keys, short @ [len(linear.nodes), 1])


def _elements(mesh, shape):
    """Return nodes and elements of the wanted shape from lattices of order 1, 2 or 4."""
    lattice = mesh.elements
    if shape == "T3":
        return mesh.nodes, lattice
    if shape == "T6":
        return mesh.nodes, lattice[:, [0, 2, 5, 1, 4, 3]]
    corner = mesh.nodes[mesh.corners]
    centre = corner.mean(axis=1)
    count, start = len(lattice), len(mesh.nodes)
    middle = start + np.arange(count)
    if shape == "Q4":
        a, ab, b, ca, bc, c = lattice.T
        quads = [(a, ab, middle, ca), (b, bc, middle, ab), (c, ca, middle, bc)]
        return np.vstack([mesh.nodes, centre]), np.stack(quads).transpose(2, 0, 1).reshape(-1, 4)
    # order 4: rows of 5, 4, 3, 2, 1 nodes; corners 0, 4, 14, edge middles 2, 11, 9
    spoke = [start + count * (1 + k) + np.arange(count) for k in range(3)]
    half = [(centre + mesh.nodes[lattice[:, k]]) / 2 for k in (2, 11, 9)]
    at = lattice.T
    quads = [
        (at[0], at[2], middle, at[9], at[1], spoke[0], spoke[2], at[5]),
        (at[4], at[11], middle, at[2], at[8], spoke[1], spoke[0], at[3]),
        (at[14], at[9], middle, at[11], at[12], spoke[2], spoke[1], at[13]),
    ]
    return np.vstack([mesh.nodes, centre, *half]), np.stack(quads).transpose(2, 0, 1).reshape(-1, 8)


def _forces(mesh, nodes, elements, thickness, shape) -> np.ndarray:
    """Return nodal forces (N, 3, 7): the five load cases, and self-weight along x and along y."""
    corner = nodes[elements[:, :3]]
    if shape in ("Q4", "Q8"):
        corner = nodes[elements[:, :4]]
        cross = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
    else:
        cross = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    area = np.linalg.norm(cross, axis=1) / 2
    normal = cross / (2 * area[:, None])
    weight = CONCRETE.unit_weight
    surface = surface_loads(normal, np.full(len(area), thickness), make_load_cases(Loads(), weight))
    sideways = np.zeros((len(area), 3, 2))
    sideways[:, 0, 0] = sideways[:, 1, 1] = weight * thickness
    surface = np.concatenate([surface, sideways], axis=2)
    # quadratic triangles carry a uniform load at their middle nodes alone; the eight-node quads
    # are taken as parallelograms: -1/12 at corners, 1/3 at middles
    share = {"T3": [1 / 3] * 3, "Q4": [1 / 4] * 4, "T6": [0] * 3 + [1 / 3] * 3,
             "Q8": [-1 / 12] * 4 + [1 / 3] * 4}[shape]  # fmt: skip
    forces = np.zeros((len(nodes), 3, 7))
    for position, part in enumerate(share):
        if part:
            np.add.at(forces, elements[:, position], part * area[:, None, None] * surface)
    return forces
