"""Published shell problems, each as a function of the mesh; used by tests and by the table.

A mesh of n means n elements of the given order along a side of the modelled part. Every function
returns the computed value over the exact or published one.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.analysis import build_model
from foldshell.shell.assembly import assemble_stiffness
from foldshell.shell.linear_solver import factorise
from foldshell.shell.mesh import ShellMesh, build_mesh, rotation_dofs, translation_dofs
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.reference import EDGES

NONE = np.empty(0, dtype=int)


@dataclass(frozen=True)
class Solved:
    """Mesh, first-order displacements (N, 3) and the load vector of a problem."""

    mesh: ShellMesh
    displacement: np.ndarray


def grid(columns: int, rows: int) -> tuple[np.ndarray, np.ndarray]:
    """Return parameters (V, 2) in the unit square and triangles (F, 3), diagonals one way."""
    u, v = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1), indexing="ij")
    number = np.arange(u.size).reshape(u.shape)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    first, second = np.stack([a, b, c], -1), np.stack([a, c, d], -1)
    triangles = np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3)])
    return np.column_stack([u.ravel(), v.ravel()]), triangles


def edges_where(mesh: ShellMesh, test) -> np.ndarray:
    """Return element edges both of whose ends satisfy test(points (.., 3)) -> bool."""
    ends = mesh.corners[:, EDGES]
    inside = test(mesh.nodes[ends]).all(axis=2)
    return np.unique(mesh.element_edges[inside])


def nodes_where(mesh: ShellMesh, test) -> np.ndarray:
    """Return nodes that satisfy test(points (N, 3)) -> bool."""
    return np.flatnonzero(test(mesh.nodes))


def solve(mesh, fixed, forces, thickness, modulus, poissons_ratio, solver="cholmod") -> Solved:
    """Solve one first-order load case given by nodal forces (dofs,)."""
    model = build_model(mesh, NONE, poissons_ratio, fixed)
    values = assemble_stiffness(
        model.operators, model.pattern, np.full(len(mesh.elements), thickness), modulus
    )
    dofs = model.pattern.dofs
    displacement = np.zeros(mesh.dof_count)
    factor = factorise(model.pattern, values, solver)
    displacement[dofs] = factor.solve(forces[dofs][:, None])[:, 0]
    return Solved(mesh, displacement[: 3 * len(mesh.nodes)].reshape(-1, 3))


def uniform_load(mesh: ShellMesh, load, poissons_ratio: float) -> np.ndarray:
    """Return nodal forces (dofs,) of a uniform global surface load (3,)."""
    model = build_model(mesh, NONE, poissons_ratio, NONE)
    surface = np.broadcast_to(np.asarray(load, float)[None, :, None], (len(mesh.elements), 3, 1))
    return nodal_forces(model.operators, surface)[:, 0]


def at(plane: int, value: float):
    """Return a test for points on the plane x_i = value."""
    return lambda points: np.isclose(points[..., plane], value, atol=1e-9)


def scordelis_lo(n: int, order: int) -> float:
    """Vertical displacement at the middle of the free edge, over 0.3024 (Macneal & Harder 1985).

    R = 25, L = 50, 40 degrees, t = 0.25, E = 4.32e8, nu = 0, 90 per area; a quarter.
    """
    uv, triangles = grid(n, n)
    angle = np.radians(40) * uv[:, 0]
    points = np.column_stack([25 * np.sin(angle), 25 * uv[:, 1], 25 * np.cos(angle)])
    mesh = build_mesh(points, triangles, order=order, subdivisions=1)
    symmetry_x, symmetry_y, diaphragm = at(0, 0.0), at(1, 0.0), at(1, 25.0)
    fixed = np.concatenate(
        [
            translation_dofs(nodes_where(mesh, symmetry_x), (0,)),
            translation_dofs(nodes_where(mesh, symmetry_y), (1,)),
            translation_dofs(nodes_where(mesh, diaphragm), (0, 2)),
            rotation_dofs(mesh, edges_where(mesh, symmetry_x)),
            rotation_dofs(mesh, edges_where(mesh, symmetry_y)),
        ]
    )
    forces = uniform_load(mesh, (0, 0, -90), 0.0)
    solved = solve(mesh, fixed, forces, 0.25, 4.32e8, 0.0)
    corner = np.flatnonzero((uv == (1.0, 0.0)).all(axis=1))[0]
    return -solved.displacement[corner, 2] / 0.3024


def pinched_cylinder(n: int, order: int) -> float:
    """Displacement under the load, over 1.8248e-5 (Belytschko et al. 1985), rigid diaphragms.

    R = 300, L = 600, t = 3, E = 3e6, nu = 0.3, P = 1; an eighth with P / 4.
    """
    uv, triangles = grid(n, n)
    angle = np.pi / 2 * uv[:, 0]
    points = np.column_stack([300 * np.sin(angle), 300 * uv[:, 1], 300 * np.cos(angle)])
    mesh = build_mesh(points, triangles, order=order, subdivisions=1)
    planes = [at(0, 0.0), at(1, 0.0), at(2, 0.0)]
    parts = [translation_dofs(nodes_where(mesh, test), (axis,)) for axis, test in enumerate(planes)]
    parts += [rotation_dofs(mesh, edges_where(mesh, test)) for test in planes]
    parts.append(translation_dofs(nodes_where(mesh, at(1, 300.0)), (0, 2)))
    forces = np.zeros(mesh.dof_count)
    loaded = np.flatnonzero((uv == (0.0, 0.0)).all(axis=1))[0]
    forces[3 * loaded + 2] = -0.25
    solved = solve(mesh, np.concatenate(parts), forces, 3.0, 3e6, 0.3)
    return -solved.displacement[loaded, 2] / 1.8248e-5


def hemisphere(n: int, order: int) -> float:
    """Radial displacement under the loads, over 0.0940 (Macneal & Harder 1985); 18 degree hole.

    R = 10, t = 0.04, E = 6.825e7, nu = 0.3, alternating loads of 2 at the equator; a quarter.
    """
    uv, triangles = grid(n, n)
    phi, theta = np.pi / 2 * uv[:, 0], np.radians(72) * uv[:, 1]
    points = 10 * np.column_stack(
        [np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), np.sin(theta)]
    )
    mesh = build_mesh(points, triangles, order=order, subdivisions=1)
    along_x = np.flatnonzero((uv == (0.0, 0.0)).all(axis=1))[0]
    along_y = np.flatnonzero((uv == (1.0, 0.0)).all(axis=1))[0]
    planes = [at(0, 0.0), at(1, 0.0)]
    parts = [translation_dofs(nodes_where(mesh, test), (axis,)) for axis, test in enumerate(planes)]
    parts += [rotation_dofs(mesh, edges_where(mesh, test)) for test in planes]
    parts.append(translation_dofs([along_x], (2,)))
    forces = np.zeros(mesh.dof_count)
    forces[3 * along_x], forces[3 * along_y + 1] = 1.0, -1.0
    solved = solve(mesh, np.concatenate(parts), forces, 0.04, 6.825e7, 0.3)
    return solved.displacement[along_x, 0] / 0.0940


def cook(n: int, order: int) -> float:
    """Tip displacement of Cook's membrane, over 23.96 (Cook et al. 1989): shear load of 1."""
    uv, triangles = grid(n, n)
    x = 48 * uv[:, 0]
    low, high = 44 * uv[:, 0], 44 + 16 * uv[:, 0]
    points = np.column_stack([x, low + (high - low) * uv[:, 1], 0 * x])
    mesh = build_mesh(points, triangles, order=order, subdivisions=1)
    nodes = np.arange(len(mesh.nodes))
    fixed = np.concatenate(
        [
            translation_dofs(nodes, (2,)),
            translation_dofs(nodes_where(mesh, at(0, 0.0)), (0, 1)),
            rotation_dofs(mesh, np.arange(mesh.edge_count)),
        ]
    )
    forces = np.zeros(mesh.dof_count)
    forces[1 : 3 * len(nodes) : 3] = edge_traction(mesh, at(0, 48.0)) / 16
    solved = solve(mesh, fixed, forces, 1.0, 1.0, 1 / 3)
    tip = np.linalg.norm(mesh.nodes - (48, 52, 0), axis=1).argmin()
    return solved.displacement[tip, 1] / 23.96


def edge_traction(mesh: ShellMesh, test) -> np.ndarray:
    """Return the nodal forces (N,) of a unit traction per length on straight edges."""
    lattice = np.linspace(0, 1, mesh.order + 1)
    vander = np.linalg.inv(np.vander(lattice, increasing=True))
    weights = vander.T @ (1 / np.arange(1, mesh.order + 2))
    rows = np.flatnonzero(test(mesh.nodes[mesh.pair_nodes]).all(axis=1))
    forces = np.zeros(len(mesh.nodes))
    for row in rows:
        chain = mesh.pair_nodes[row]
        length = np.linalg.norm(mesh.nodes[chain[-1]] - mesh.nodes[chain[0]])
        forces[chain] += weights * length
    return forces


def square_plate(n: int, order: int, clamped: bool = False) -> float:
    """Centre deflection of a uniformly loaded square plate, over Timoshenko's series.

    w = 0.00406235 q a^4 / D supported, 0.00126532 clamped (Taylor & Govindjee 2004); nu = 0.3.
    """
    uv, triangles = grid(n, n)
    points = np.column_stack([uv, 0 * uv[:, 0]])
    mesh = build_mesh(points, triangles, order=order, subdivisions=1)
    border = lambda p: (np.isclose(p[..., :2], 0) | np.isclose(p[..., :2], 1)).any(axis=-1)  # noqa: E731
    nodes = np.arange(len(mesh.nodes))
    parts = [translation_dofs(nodes, (0, 1)), translation_dofs(nodes_where(mesh, border), (2,))]
    if clamped:
        ends = mesh.corners[:, EDGES]
        middle = mesh.nodes[ends].mean(axis=2)
        parts.append(rotation_dofs(mesh, np.unique(mesh.element_edges[border(middle)])))
    forces = uniform_load(mesh, (0, 0, -1), 0.3)
    t, modulus = 0.01, 1e6
    solved = solve(mesh, np.concatenate(parts), forces, t, modulus, 0.3)
    stiffness = modulus * t**3 / 12 / (1 - 0.3**2)
    centre = np.argmin(np.linalg.norm(mesh.nodes - (0.5, 0.5, 0), axis=1))
    exact = (0.00126532 if clamped else 0.00406235) / stiffness
    return -solved.displacement[centre, 2] / exact
