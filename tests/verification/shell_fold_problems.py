"""Skewed plates and folded sections with published answers; see `shell_problems`."""

import numpy as np
from shell_problems import (
    at,
    edge_traction,
    edges_where,
    grid,
    nodes_where,
    solve,
    uniform_load,
)

from foldshell.shell.analysis import build_model
from foldshell.shell.mesh import build_mesh, rotation_dofs, translation_dofs
from foldshell.shell.stress import evaluate, membrane_forces


def razzaque_skew_plate(n: int, order: int) -> float:
    """Centre deflection of a 60 degree rhombic plate under uniform load, over 7.945e-3 q a^4 / D.

    Two opposite edges simply supported, two free; nu = 0.31 (Razzaque 1973, Int. J. Numer.
    Methods Eng. 6:333).
    """
    uv, triangles = grid(n, n)
    angle = np.radians(60)
    points = np.column_stack(
        [uv[:, 0] + np.cos(angle) * uv[:, 1], np.sin(angle) * uv[:, 1], 0 * uv[:, 0]]
    )
    mesh = build_mesh(points, triangles, order=order, subdivisions=1)
    top = np.sin(angle)
    held = lambda p: np.isclose(p[..., 1], 0) | np.isclose(p[..., 1], top)  # noqa: E731
    nodes = np.arange(len(mesh.nodes))
    fixed = np.concatenate(
        [translation_dofs(nodes, (0, 1)), translation_dofs(nodes_where(mesh, held), (2,))]
    )
    thickness, modulus, nu = 0.01, 1085.0, 0.31
    solved = solve(mesh, fixed, uniform_load(mesh, (0, 0, -1), nu), thickness, modulus, nu)
    centre = np.linalg.norm(mesh.nodes - points.mean(axis=0), axis=1).argmin()
    stiffness = modulus * thickness**3 / 12 / (1 - nu**2)
    return -solved.displacement[centre, 2] * stiffness / 7.945e-3


def _extruded(profile: np.ndarray, across: int, length: float, along: int, order: int):
    """Return a mesh of a folded profile (K, 2) of y, z extruded along x; `across` a wall."""
    walls = len(profile) - 1
    uv, triangles = grid(along, walls * across)
    wall = np.minimum((uv[:, 1] * walls).astype(int), walls - 1)
    part = (uv[:, 1] * walls - wall)[:, None]
    section = (1 - part) * profile[wall] + part * profile[wall + 1]
    return build_mesh(np.column_stack([length * uv[:, 0], section]), triangles, order=order,
                      subdivisions=1)  # fmt: skip


def z_section_in_torsion(n: int, order: int) -> float:
    """Axial stress at the flange tip 2.5 m from the clamp, over 108 MPa (NAFEMS LE5, 1990).

    A cantilever 10 m long, web 2 m, flanges 1 m, t = 0.1 m, E = 210 GPa, nu = 0.3; a torque of
    1.2 MNm as two shears of 0.6 MN along the flanges. 4n elements along, n across each wall.
    """
    profile = np.array([[-1.0, -1.0], [0.0, -1.0], [0.0, 1.0], [1.0, 1.0]])
    mesh = _extruded(profile, n, 10.0, 4 * n, order)
    clamp, end = at(0, 0.0), at(0, 10.0)
    fixed = np.concatenate(
        [translation_dofs(nodes_where(mesh, clamp)), rotation_dofs(mesh, edges_where(mesh, clamp))]
    )
    forces = np.zeros(mesh.dof_count)
    for level, shear in ((1.0, 0.6e3), (-1.0, -0.6e3)):
        flange = lambda p, level=level: end(p) & np.isclose(p[..., 2], level)  # noqa: E731
        forces[1 : 3 * len(mesh.nodes) : 3] += shear * edge_traction(mesh, flange)
    modulus = 210e6
    solved = solve(mesh, fixed, forces, 0.1, modulus, 0.3)
    return _axial_stress(mesh, solved, (2.5, 1.0, 1.0), modulus) / -108e3


def _axial_stress(mesh, solved, point, modulus) -> float:
    """Return the mean membrane stress along x of the elements that have `point` as a corner."""
    operators = build_model(mesh, np.empty(0, int), 0.3, np.empty(0, int)).operators
    displacement = np.zeros((mesh.dof_count, 1))
    displacement[: 3 * len(mesh.nodes), 0] = solved.displacement.ravel()
    force = membrane_forces(operators, displacement, np.ones(len(mesh.elements)), modulus)
    corner = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    stress = evaluate(operators, force, corner)[:, :, 0]
    axes = operators.geometry.frame[:, :2, 0]
    x, y = axes[:, None, 0], axes[:, None, 1]
    along = x**2 * stress[..., 0] + y**2 * stress[..., 1] + 2 * x * y * stress[..., 2]
    there = np.isclose(mesh.nodes[mesh.corners], point).all(axis=2)
    return float(along[there].mean())


def folded_strip_in_bending(n: int, order: int) -> float:
    """Tip deflection of a cantilevered symmetric V-fold, over beam theory without shear, nu = 0.

    Two walls 0.2 m wide at 45 degrees, t = 5 mm, 10 m long: each wall bends in its own plane, and
    the fold keeps them together. I = b^3 t sin^2 / 6, and P L^3 / 3 E I with the shear term
    P L / (5/6 G A sin^2).
    """
    width, t, length, modulus = 0.2, 0.005, 10.0, 210e6
    side = width / np.sqrt(2)
    profile = np.array([[-side, 0.0], [0.0, side], [side, 0.0]])
    mesh = _extruded(profile, n, length, 8 * n, order)
    clamp, end = at(0, 0.0), at(0, length)
    fixed = np.concatenate(
        [translation_dofs(nodes_where(mesh, clamp)), rotation_dofs(mesh, edges_where(mesh, clamp))]
    )
    forces = np.zeros(mesh.dof_count)
    forces[2 : 3 * len(mesh.nodes) : 3] = -edge_traction(mesh, end) / (2 * width)
    solved = solve(mesh, fixed, forces, t, modulus, 0.0)
    inertia = width**3 * t * 0.5 / 6
    shear_area = 5 / 6 * 2 * width * t * 0.5
    exact = length**3 / (3 * modulus * inertia) + length / (modulus / 2 * shear_area)
    return -solved.displacement[nodes_where(mesh, end), 2].mean() / exact
