"""Patch tests and zero modes of skewed, rotated and renumbered patches, as figures."""

import sys
from pathlib import Path

import numpy as np

from foldshell.shell.mesh import ShellMesh
from foldshell.shell.stiffness import build_operators
from foldshell.shell.stress import stress_resultants

sys.path.append(str(Path(__file__).parents[1] / "unit" / "shell"))

from shell_cases import dense_stiffness, edge_rotations, folded_strip, skewed_patch

NU, THICKNESS, MODULUS = 0.3, 0.2, 7.0


def membrane_patch_error(order: int, seed: int) -> float:
    """Return the largest error of N over the largest exact one, for a linear in-plane field."""
    mesh, frame = skewed_patch(seed, order)
    gradient = np.array([[1.0, 0.4], [-0.7, 0.6]])
    local = (mesh.nodes @ frame.T)[:, :2] @ gradient.T
    displacement = np.zeros(mesh.dof_count)
    displacement[: 3 * len(mesh.nodes)] = (local @ frame[:2]).ravel()
    strain = np.array([1.0, 0.6, 0.4 - 0.7])
    found, exact = _resultants(mesh, frame, displacement, strain, THICKNESS, "force")
    return _largest_error(found, exact)


def bending_patch_error(order: int, seed: int) -> float:
    """Return the largest error of M over the largest exact one, for a quadratic deflection."""
    mesh, frame = skewed_patch(seed, order)
    hessian = np.array([[1.0, 0.35], [0.35, -0.8]])
    plane = lambda x: x @ frame[:2].T  # noqa: E731
    deflection = 0.5 * np.einsum("na,ab,nb->n", plane(mesh.nodes), hessian, plane(mesh.nodes))
    spin = lambda x: np.cross(plane(x) @ hessian @ frame[:2], frame[2])  # noqa: E731
    displacement = np.concatenate(
        [(deflection[:, None] * frame[2]).ravel(), edge_rotations(mesh, spin).ravel()]
    )
    curvature = np.array([hessian[0, 0], hessian[1, 1], 2 * hessian[0, 1]])
    found, exact = _resultants(mesh, frame, displacement, curvature, THICKNESS**3 / 12, "moment")
    return _largest_error(found, exact)


def zero_modes(order: int, kind: str) -> int:
    """Return how many eigenvalues of a free patch vanish to round-off."""
    mesh = skewed_patch(2, order)[0] if kind == "flat" else folded_strip(4, order - 1)
    values = np.linalg.eigvalsh(dense_stiffness(build_operators(mesh, NU), THICKNESS))
    return int((np.abs(values) < 1e-10 * values[-1]).sum())


def _resultants(mesh: ShellMesh, frame, displacement, strain, factor, name):
    """Return computed and exact components, (E, 3, m), in the element frames."""
    operators = build_operators(mesh, NU)
    thickness = np.full(len(mesh.elements), THICKNESS)
    found = stress_resultants(operators, displacement[:, None], thickness, MODULUS)
    plane = factor * MODULUS * operators.elasticity @ strain
    tensor = np.array([[plane[0], plane[2]], [plane[2], plane[1]]])
    axes = np.einsum("eax,bx->eab", operators.geometry.frame[:, :2], frame[:2])
    turned = np.einsum("eab,bc,edc->ead", axes, tensor, axes)
    values = getattr(found, name)[..., 0]
    exact = np.zeros_like(values)
    exact[:, 0, 0], exact[:, 1, 0], exact[:, 2, 0] = (
        turned[:, 0, 0], turned[:, 1, 1], turned[:, 0, 1],
    )  # fmt: skip
    return values, exact


def _largest_error(found, exact) -> float:
    return float(np.abs(found - exact).max() / np.abs(exact).max())
