"""Small shells for tests: skewed, rotated and renumbered pieces of plates and folds."""

import numpy as np

from foldshell.shell.mesh import ShellMesh, build_mesh


def random_rotation(seed: int) -> np.ndarray:
    """Return a proper rotation matrix (3, 3)."""
    q, r = np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))
    q *= np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def skewed_patch(seed: int, order: int, subdivisions: int = 1) -> tuple[ShellMesh, np.ndarray]:
    """Return a flat patch of ten skewed triangles, rotated and renumbered in space, and its frame.

    Rows of the frame are the patch's own x, y and normal.
    """
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(np.linspace(0, 3, 4), np.linspace(0, 2, 3), indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel()])
    points[[4, 7]] += rng.uniform(-0.3, 0.3, (2, 2))
    points = points @ np.array([[1.0, 0.2], [0.6, 0.9]])
    number = np.arange(12).reshape(4, 3)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    triangles = np.concatenate(
        [np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)]
    )
    turns = rng.integers(0, 3, 12)
    triangles = np.array([np.roll(t, k) for t, k in zip(triangles, turns, strict=True)])
    renumber = rng.permutation(12)
    shuffled = np.empty((12, 3))
    frame = random_rotation(seed)
    shuffled[renumber] = np.column_stack([points, 0 * points[:, 0]]) @ frame + rng.uniform(-9, 9, 3)
    mesh = build_mesh(shuffled, renumber[triangles], order=order, subdivisions=subdivisions)
    return mesh, frame


def folded_strip(seed: int, subdivisions: int = 2) -> ShellMesh:
    """Return four facets over two folds at odd angles, rotated in space."""
    points = np.array(
        [[0, 0, 0], [2, 0.3, 0], [0.4, 1.5, 0.9], [2.2, 1.7, 1.1], [0.1, 3.0, 0.1], [2.1, 3.3, 0.0]]
    )
    triangles = np.array([[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]])
    return build_mesh(points @ random_rotation(seed), triangles, subdivisions=subdivisions)


def dense_stiffness(operators, thickness: float, modulus: float = 1.0) -> np.ndarray:
    """Return K (dofs, dofs) of all freedoms, assembled without the sparse code."""
    size = operators.mesh.dof_count
    width = operators.dofs.shape[1]
    i, j = np.tril_indices(width)
    packed = modulus * thickness**3 * operators.bending
    packed[:, : operators.membrane.shape[1]] += modulus * thickness * operators.membrane
    total = np.zeros((size, size))
    for dofs, values in zip(operators.dofs, packed, strict=True):
        element = np.zeros((width, width))
        element[i, j] = values
        element[j, i] = values
        total[np.ix_(dofs, dofs)] += element
    return total


def edge_rotations(mesh: ShellMesh, rotation_vector) -> np.ndarray:
    """Return the rotation coefficients (edges, p) of a rotation field w(x): (.., 3) -> (.., 3)."""
    from foldshell.shell.reference import EDGES, edge_basis, edge_quadrature

    xi, weights = edge_quadrature(2 * mesh.order)
    legendre = edge_basis(mesh.order, xi)
    result = np.zeros((mesh.edge_count, mesh.order))
    ends = np.sort(mesh.corners[:, EDGES], axis=2).reshape(-1, 2)
    for edge, (a, b) in zip(mesh.element_edges.ravel(), ends, strict=True):
        start, stop = mesh.nodes[a], mesh.nodes[b]
        along = (stop - start) / np.linalg.norm(stop - start)
        points = start + xi[:, None] * (stop - start)
        values = rotation_vector(points) @ along
        result[edge] = (legendre * (weights * values)[:, None]).sum(0) * (
            2 * np.arange(mesh.order) + 1
        )
    return result
