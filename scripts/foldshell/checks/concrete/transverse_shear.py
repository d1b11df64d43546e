"""Transverse shear of a thin plate: the divergence of its moments."""

import numpy as np

from foldshell.shell.reference import lattice_points, orthonormal_basis, reference_triangle
from foldshell.shell.stiffness import ShellOperators


def shear_coefficients(operators: ShellOperators, moment: np.ndarray) -> np.ndarray:
    """v_x = m_xx,x + m_xy,y, v_y = m_xy,x + m_yy,y: coefficients (E, 2, m, c) kN/m.

    moment (E, 3, m, c) kNm/m, coefficients of the orthonormal basis in the axes of elements.
    Equilibrium of a plate (Timoshenko & Woinowsky-Krieger 1959, eq. 101, 102).
    """
    order = operators.mesh.order
    nodal = orthonormal_basis(order - 1, lattice_points(order))
    slope = reference_triangle(order).gradient @ nodal  # r or s, of which, to which function
    along = np.einsum("kmn,ekx->exmn", slope, operators.geometry.inverse, optimize=True)
    x, y = along[:, 0], along[:, 1]
    xx, yy, xy = np.moveaxis(moment, 1, 0)
    return np.stack([x @ xx + y @ xy, x @ xy + y @ yy], axis=1)


def turn_vectors(values: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Return (E, q, c, 2) x, y in axes turned by `angle` (E,) rad, in their unit."""
    cos, sin = (one[:, None, None] for one in (np.cos(angle), np.sin(angle)))
    x, y = np.moveaxis(values, -1, 0)
    return np.stack([cos * x + sin * y, cos * y - sin * x], axis=-1)
