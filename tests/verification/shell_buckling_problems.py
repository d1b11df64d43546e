"""Buckling and second order with classical answers; see `shell_problems`.

Membrane forces are prescribed where the classical answer assumes them; the beam-column's come
from its own analysis.
"""

import numpy as np
from shell_problems import at, edge_traction, edges_where, grid, nodes_where

from foldshell.shell.analysis import build_model
from foldshell.shell.assembly import assemble_stiffness
from foldshell.shell.buckling import find_buckling_factors
from foldshell.shell.effort import Effort
from foldshell.shell.geometric import apply_geometric
from foldshell.shell.linear_solver import factorise
from foldshell.shell.mesh import build_mesh, rotation_dofs, translation_dofs
from foldshell.shell.nodal_loads import nodal_forces
from foldshell.shell.reference import EDGES
from foldshell.shell.second_order import solve_second_order
from foldshell.shell.stress import membrane_forces

NONE = np.empty(0, dtype=int)


def buckling_factor(mesh, fixed, force, thickness, modulus, poissons_ratio) -> float:
    """Return the least factor on prescribed forces (E, 3): xx, yy, xy in the frames."""
    model = build_model(mesh, NONE, poissons_ratio, fixed)
    values = assemble_stiffness(
        model.operators, model.pattern, np.full(len(mesh.elements), thickness), modulus
    )
    dofs = model.pattern.dofs

    def apply(vectors):
        full = np.zeros((mesh.dof_count, vectors.shape[1]))
        full[dofs] = vectors
        functions = mesh.order * (mesh.order + 1) // 2
        constant = np.zeros((len(mesh.elements), 3, functions, vectors.shape[1]))
        constant[:, :, 0] = force[:, :, None]
        return apply_geometric(model.operators, constant, full)[dofs][None]

    factor = factorise(model.pattern, values)
    found = find_buckling_factors(
        factor.solve,
        apply,
        np.ones((1, 1)),
        len(dofs),
        effort=Effort(near_tolerance=1e-4),
        iterations_max=200,
    )
    return float(found.factors[0])


def force_in_frames(mesh, tensor) -> np.ndarray:
    """Return a constant or per-element global tensor (.., 3, 3) as components (E, 3)."""
    frame = build_model(mesh, NONE, 0.0, NONE).operators.geometry.frame[:, :2]
    local = frame @ np.broadcast_to(tensor, (len(mesh.elements), 3, 3)) @ frame.transpose(0, 2, 1)
    return np.stack([local[:, 0, 0], local[:, 1, 1], local[:, 0, 1]], axis=1)


def plate_buckling(n: int, order: int, clamped: bool, shear: bool) -> float:
    """Buckling coefficient k = N b^2 / (pi^2 D) of a square plate, over the classical one.

    Supported: compression 4, shear 9.325; clamped: 10.074 and 14.64 (Timoshenko & Gere 1961;
    Budiansky & Connor 1948 for clamped shear).
    """
    uv, triangles = grid(n, n)
    mesh = build_mesh(np.column_stack([uv, 0 * uv[:, 0]]), triangles, order=order, subdivisions=1)
    border = lambda p: (np.isclose(p[..., :2], 0) | np.isclose(p[..., :2], 1)).any(axis=-1)  # noqa: E731
    nodes = np.arange(len(mesh.nodes))
    parts = [translation_dofs(nodes, (0, 1)), translation_dofs(nodes_where(mesh, border), (2,))]
    if clamped:
        middle = mesh.nodes[mesh.corners[:, EDGES]].mean(axis=2)
        parts.append(rotation_dofs(mesh, np.unique(mesh.element_edges[border(middle)])))
    tensor = np.zeros((3, 3))
    if shear:
        tensor[0, 1] = tensor[1, 0] = 1.0
    else:
        tensor[0, 0] = -1.0
    t, modulus, nu = 0.01, 1e6, 0.3
    force = force_in_frames(mesh, tensor)
    factor = buckling_factor(mesh, np.concatenate(parts), force, t, modulus, nu)
    stiffness = modulus * t**3 / 12 / (1 - nu**2)
    exact = {(False, False): 4.0, (True, False): 10.074, (False, True): 9.325, (True, True): 14.64}
    return factor / (np.pi**2 * stiffness) / exact[clamped, shear]


STRUT = {"length": 10.0, "width": 1.0, "thickness": 0.02, "modulus": 1e6}


def _strut(n: int, order: int):
    """Return the mesh of a pinned strut, its supports and EI."""
    uv, triangles = grid(n, 1)
    points = np.column_stack([STRUT["length"] * uv[:, 0], STRUT["width"] * uv[:, 1], 0 * uv[:, 0]])
    mesh = build_mesh(points, triangles, order=order, subdivisions=1)
    left, right = at(0, 0.0), at(0, STRUT["length"])
    ends = np.union1d(nodes_where(mesh, left), nodes_where(mesh, right))
    fixed = np.concatenate(
        [
            translation_dofs(np.arange(len(mesh.nodes)), (1,)),
            translation_dofs(nodes_where(mesh, left), (0,)),
            translation_dofs(ends, (2,)),
        ]
    )
    return mesh, fixed, STRUT["modulus"] * STRUT["width"] * STRUT["thickness"] ** 3 / 12


def euler_strut(n: int, order: int) -> float:
    """Buckling load of a pinned strut in n elements, over pi^2 E I / L^2; nu = 0."""
    mesh, fixed, stiffness = _strut(n, order)
    tensor = np.zeros((3, 3))
    tensor[0, 0] = -1 / STRUT["width"]
    force = force_in_frames(mesh, tensor)
    found = buckling_factor(mesh, fixed, force, STRUT["thickness"], STRUT["modulus"], 0.0)
    return found * STRUT["length"] ** 2 / (np.pi**2 * stiffness)


def beam_column(n: int, order: int) -> float:
    """Amplification of the middle deflection at 0.8 P_cr under uniform load, over the exact one.

    12 (2 sec u - u^2 - 2) / (5 u^4), u = pi/2 sqrt(0.8) (Timoshenko & Gere 1961, art. 1.11).
    """
    mesh, fixed, stiffness = _strut(n, order)
    model = build_model(mesh, NONE, 0.0, fixed)
    thickness = np.full(len(mesh.elements), STRUT["thickness"])
    values = assemble_stiffness(model.operators, model.pattern, thickness, STRUT["modulus"])
    factor, dofs = factorise(model.pattern, values), model.pattern.dofs
    critical = np.pi**2 * stiffness / STRUT["length"] ** 2
    forces = np.zeros((mesh.dof_count, 1))
    end = edge_traction(mesh, at(0, STRUT["length"])) / STRUT["width"]
    forces[0 : 3 * len(mesh.nodes) : 3, 0] = -0.8 * critical * end
    area = model.operators.geometry.area
    surface = np.zeros((len(area), 3, 1))
    surface[:, 2] = -1e-6 * critical
    forces += nodal_forces(model.operators, surface)

    def correction(displacement, _columns):
        full = np.zeros((mesh.dof_count, 1))
        full[dofs] = displacement
        force = membrane_forces(model.operators, full, thickness, STRUT["modulus"])
        return -factor.solve(apply_geometric(model.operators, force, full)[dofs])

    linear = factor.solve(forces[dofs])
    second = solve_second_order(linear, correction, 1e-10, 200)
    assert second.converged
    middle = np.linalg.norm(mesh.nodes - (STRUT["length"] / 2, 0, 0), axis=1).argmin()
    row = np.flatnonzero(dofs == 3 * middle + 2)[0]
    u = np.pi / 2 * np.sqrt(0.8)
    exact = 12 * (2 / np.cos(u) - u**2 - 2) / (5 * u**4)
    return float(second.displacement[row, 0] / linear[row, 0] / exact)


def _cylinder(angle: float, length: float, around: int, along: int, order: int):
    """Return a sector of the unit cylinder about z from phi = 0 to `angle`."""
    uv, triangles = grid(around, along)
    phi = angle * uv[:, 0]
    points = np.column_stack([np.cos(phi), np.sin(phi), length * uv[:, 1]])
    return build_mesh(points, triangles, order=order, subdivisions=1)


def cylinder_under_axial_load(n: int, order: int) -> float:
    """Buckling stress of a supported cylinder, over E t / (R sqrt(3 (1 - nu^2))).

    R / t = 200, three axisymmetric half-waves long; a quarter of its circumference with symmetry,
    n elements around, n / 2 along (Timoshenko & Gere 1961, art. 11.1).
    """
    t, nu, modulus = 0.005, 0.3, 1e6
    length = 3 * np.pi * np.sqrt(t) / (12 * (1 - nu**2)) ** 0.25
    mesh = _cylinder(np.pi / 2, length, n, n // 2, order)
    rims = lambda p: np.isclose(p[..., 2], 0) | np.isclose(p[..., 2], length)  # noqa: E731
    fixed = [translation_dofs(nodes_where(mesh, rims), (0, 1))]
    fixed += [translation_dofs([nodes_where(mesh, at(2, 0.0))[0]], (2,))]
    for axis in (0, 1):
        fixed += [translation_dofs(nodes_where(mesh, at(axis, 0.0)), (axis,))]
        fixed += [rotation_dofs(mesh, edges_where(mesh, at(axis, 0.0)))]
    tensor = np.zeros((3, 3))
    tensor[2, 2] = -1.0
    force = force_in_frames(mesh, tensor)
    factor = buckling_factor(mesh, np.concatenate(fixed), force, t, modulus, nu)
    return factor / t / (modulus * t / np.sqrt(3 * (1 - nu**2)))


def ring_under_dead_pressure(n: int, order: int) -> float:
    """Buckling pressure of a ring under radial load of fixed direction, over 4 E I / R^3.

    Bodner 1958 (J. Aeronaut. Sci. 25:640); a quarter with symmetry, n elements, nu = 0.
    """
    t, modulus, width = 0.02, 1e6, 0.2
    mesh = _cylinder(np.pi / 2, width, n, 1, order)
    planes = [at(1, 0.0), at(0, 0.0)]
    fixed = np.concatenate(
        [translation_dofs(nodes_where(mesh, planes[0]), (1,)),
         translation_dofs(nodes_where(mesh, planes[1]), (0,)),
         translation_dofs(np.arange(len(mesh.nodes)), (2,))]
        + [rotation_dofs(mesh, edges_where(mesh, plane)) for plane in planes]
    )  # fmt: skip
    tensor = _hoop_tensor(mesh)
    factor = buckling_factor(mesh, fixed, -force_in_frames(mesh, tensor), t, modulus, 0.0)
    return factor * 12 / (modulus * t**3) / 4


def shallow_arch(n: int, order: int) -> float:
    """Buckling pressure of a hinged shallow arch, half-angle 15 degrees, over 144 E I / R^3.

    The antisymmetric mode under uniform thrust: (pi / alpha)^2 for loads of fixed direction, to
    0.7 % (Timoshenko & Gere 1961, art. 7.6, has (pi / alpha)^2 - 1 for loads that follow).
    """
    t, modulus, width = 0.005, 1e6, 0.1
    angle = np.pi / 6
    mesh = _cylinder(angle, width, n, 1, order)
    first = np.isclose(np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0]), 0, atol=1e-9)
    last = np.isclose(np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0]), angle, atol=1e-9)
    fixed = np.concatenate(
        [translation_dofs(np.flatnonzero(first | last)),
         translation_dofs(np.arange(len(mesh.nodes)), (2,))]
    )  # fmt: skip
    tensor = _hoop_tensor(mesh)
    factor = buckling_factor(mesh, fixed, -force_in_frames(mesh, tensor), t, modulus, 0.0)
    return factor * 12 / (modulus * t**3) / 144


def _hoop_tensor(mesh) -> np.ndarray:
    """Return e e^T (E, 3, 3) of the chord direction of each element around the z axis."""
    frame = build_model(mesh, NONE, 0.0, NONE).operators.geometry.frame
    around = np.cross([0.0, 0.0, 1.0], frame[:, 2])
    return around[:, :, None] * around[:, None, :]
