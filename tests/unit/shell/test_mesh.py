"""The shell mesh: counts, shared nodes, cells and edge polylines."""

import numpy as np
import pytest

from foldshell.shell.mesh import build_mesh, edge_polyline_nodes, split_subdivisions
from foldshell.shell.mesh_files import cell_triangles, interpolate_to_cells, result_mesh
from foldshell.shell.stress import cell_points
from foldshell.shell.supports import (
    BORDERS,
    find_borders,
    find_support,
    share_supported_nodes,
    supported_pairs,
)
from shell_cases import folded_strip, random_rotation, skewed_patch

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]])


@pytest.mark.parametrize(
    ("subdivisions", "expected"),
    [(1, (1, 2)), (2, (1, 3)), (3, (1, 4)), (4, (1, 5)), (5, (5, 2)), (8, (2, 5)), (16, (4, 5))],
)
def test_subdivisions_become_elements_and_order(subdivisions, expected):
    assert split_subdivisions(subdivisions) == expected


@pytest.mark.parametrize("subdivisions", [1, 2, 4, 8])
def test_counts_obey_euler(subdivisions):
    """Nodes of a lattice with L parts: V + E (L-1) + F (L-1)(L-2)/2; edges of k^2 elements."""
    k, p = split_subdivisions(subdivisions)
    mesh = build_mesh(SQUARE, TWO, subdivisions=subdivisions)
    size = k * p
    assert len(mesh.nodes) == 4 + 5 * (size - 1) + 2 * (size - 1) * (size - 2) // 2
    assert len(mesh.elements) == 2 * k * k
    vertices = len(np.unique(mesh.corners))
    assert vertices - mesh.edge_count + len(mesh.elements) == 1
    assert len(np.unique(mesh.nodes.round(12), axis=0)) == len(mesh.nodes)


@pytest.mark.parametrize("seed", range(4))
def test_elements_keep_the_orientation_of_their_facet(seed):
    mesh, frame = skewed_patch(seed, order=2, subdivisions=2)
    corner = mesh.nodes[mesh.corners]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    assert (normal @ frame[2] > 0).all()


def test_neighbours_run_along_their_edge_in_opposite_directions():
    mesh = build_mesh(SQUARE, TWO, subdivisions=8)
    total = np.bincount(mesh.element_edges.ravel(), mesh.edge_signs.ravel())
    count = np.bincount(mesh.element_edges.ravel())
    assert (total[count == 2] == 0).all()
    assert (np.abs(total[count == 1]) == 1).all()


def test_polyline_holds_every_node_on_it_in_a_renumbered_mesh():
    mesh, _ = skewed_patch(3, order=3, subdivisions=2)
    pair = mesh.node_pairs[4]
    nodes = edge_polyline_nodes(mesh, pair[None, ::-1])
    start, stop = mesh.nodes[pair[0]], mesh.nodes[pair[1]]
    across = np.cross(mesh.nodes - start, stop - start)
    along = (mesh.nodes - start) @ (stop - start) / ((stop - start) @ (stop - start))
    near = np.linalg.norm(across, axis=1) < 1e-9
    expected = np.flatnonzero(near & (along > -1e-9) & (along < 1 + 1e-9))
    assert nodes.tolist() == expected.tolist()


def test_a_pair_that_is_no_edge_is_refused():
    mesh = build_mesh(SQUARE, TWO)
    with pytest.raises(ValueError, match=r"\[1, 3\] is no edge"):
        edge_polyline_nodes(mesh, np.array([[0, 1], [1, 3]]))


def test_supports_are_the_border_polylines():
    zigzag, strip = np.divmod(np.arange(12), 4)
    pairs = np.array([[0, 1], [4, 5], [8, 9], [0, 4], [3, 7], [1, 5]])
    found = {
        name: [pair for pair in supported_pairs(pairs, zigzag, strip, find_support(name)).tolist()]
        for name in ("zigzag", "strip", "all")
    }
    assert found["zigzag"] == [[0, 1], [8, 9]]
    assert found["strip"] == [[0, 4], [3, 7]]
    assert found["all"] == [[0, 1], [8, 9], [0, 4], [3, 7]]
    with pytest.raises(ValueError, match="support 'edges'"):
        find_support("edges")


def test_borders_and_the_half_of_a_corner():
    """Zig-zag lines 0, 1, 2 along y, strips 0, 1 along x: one corner of two held borders."""
    vertices = np.array([[x, y, 0.0] for y in range(3) for x in range(2)])
    facets = np.array([[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]])
    zigzag, strip = np.divmod(np.arange(6), 2)
    pairs = np.array([[0, 1], [4, 5], [0, 2], [3, 5], [2, 3], [0, 3]])
    border = find_borders(pairs, zigzag, strip)
    assert [BORDERS[k] if k >= 0 else None for k in border] == [*BORDERS[:4], None, None]
    mesh = build_mesh(vertices, facets, subdivisions=2)
    held = np.array([[0, 1], [0, 2]])
    nodes = edge_polyline_nodes(mesh, held)
    shares = share_supported_nodes(mesh, held, np.array([0, 2]), nodes)
    assert list(shares) == ["first zig-zag edge", "first strip edge"]
    places = mesh.nodes[nodes]
    on_zigzag, on_strip = places[:, 1] == 0, places[:, 0] == 0
    assert np.array_equal(shares["first zig-zag edge"], on_zigzag / (1 + (on_zigzag & on_strip)))
    assert np.array_equal(sum(shares.values()), np.ones(len(nodes)))


@pytest.mark.parametrize("subdivisions", [2, 4, 8])
def test_result_cells_tile_the_mesh_in_the_order_of_their_values(subdivisions):
    mesh = folded_strip(5, subdivisions)
    facets = np.array([[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]])
    cells = result_mesh(mesh, mesh.nodes[:6], facets)
    triangles = cell_triangles(cells)
    assert len(triangles) == len(facets) * subdivisions**2
    centroid = cells.nodes[triangles].mean(axis=1)
    corner = mesh.nodes[mesh.corners]
    r, s = cell_points(mesh.cells).T
    weights = np.column_stack([1 - r - s, r, s])
    assert centroid == pytest.approx((weights @ corner).reshape(-1, 3), abs=1e-12)


def test_interpolation_to_cells_is_exact_for_the_element_order():
    mesh = folded_strip(1, 4)
    facets = np.array([[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]])
    cells = result_mesh(mesh, mesh.nodes[:6], facets)
    field = lambda x: (x @ np.array([[1.0], [2.0], [-0.5]])) ** 5  # noqa: E731
    found = interpolate_to_cells(mesh, cells, field(mesh.nodes))
    assert found == pytest.approx(field(cells.nodes), rel=1e-9, abs=1e-9)


def test_rotation_of_the_vertices_rotates_the_mesh():
    turn = random_rotation(8)
    plain, turned = build_mesh(SQUARE, TWO), build_mesh(SQUARE @ turn, TWO)
    assert turned.nodes == pytest.approx(plain.nodes @ turn, abs=1e-14)
    assert (turned.elements == plain.elements).all()
