"""Scatter element matrices into one sparse lower triangle whose pattern is found once."""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.mesh import ShellMesh
from foldshell.shell.stiffness import ShellOperators


@dataclass(frozen=True)
class LowerPattern:
    """Compressed columns of the lower triangle over the free degrees of freedom.

    Attributes
    ----------
    free : (D,) bool, the degrees of freedom that are not supported
    indptr, indices : compressed columns, rows in ascending order
    take : positions in the flattened packed element matrices that take part
    put : where each of them is added
    """

    free: np.ndarray
    indptr: np.ndarray
    indices: np.ndarray
    take: np.ndarray
    put: np.ndarray

    @property
    def size(self) -> int:
        """Number of free degrees of freedom."""
        return len(self.indptr) - 1


def translation_dofs(nodes: np.ndarray, directions: tuple[int, ...] = (0, 1, 2)) -> np.ndarray:
    """Return the numbers of displacements along x (0), y (1), z (2) at nodes."""
    return (3 * np.asarray(nodes, dtype=np.int64)[:, None] + np.array(directions)).ravel()


def rotation_dofs(mesh: ShellMesh, edges: np.ndarray) -> np.ndarray:
    """Return the numbers of all rotation coefficients of element edges."""
    start = 3 * len(mesh.nodes) + mesh.order * np.asarray(edges, dtype=np.int64)
    return (start[:, None] + np.arange(mesh.order)).ravel()


def find_pattern(operators: ShellOperators, fixed: np.ndarray) -> LowerPattern:
    """Find where each packed element entry goes once the `fixed` freedoms are left out."""
    mesh = operators.mesh
    free = np.ones(mesh.dof_count, dtype=bool)
    free[np.asarray(fixed, dtype=np.int64)] = False
    number = np.where(free, np.cumsum(free) - 1, -1)
    size = int(free.sum())
    local = number[operators.dofs]
    i, j = np.tril_indices(local.shape[1])
    low, high = local[:, i].ravel(), local[:, j].ravel()
    take = np.flatnonzero((low >= 0) & (high >= 0))
    low, high = low[take], high[take]
    keys = np.minimum(low, high) * size + np.maximum(low, high)
    unique, put = np.unique(keys, return_inverse=True)
    column, row = np.divmod(unique, size)
    indptr = np.concatenate([[0], np.cumsum(np.bincount(column, minlength=size))])
    return LowerPattern(free, indptr, row, take, put.ravel())


def assemble_stiffness(
    operators: ShellOperators,
    pattern: LowerPattern,
    thickness: np.ndarray,
    youngs_modulus: float,
) -> np.ndarray:
    """Return the nonzeros of K = E (t K_m + t^3 K_b) in the order of `pattern`.

    Parameters
    ----------
    thickness : (E,) m, of each element
    youngs_modulus : kPa
    """
    t = youngs_modulus * np.asarray(thickness)[:, None]
    packed = operators.bending * (t * thickness[:, None] ** 2)
    packed[:, : operators.membrane.shape[1]] += operators.membrane * t
    return np.bincount(pattern.put, packed.ravel()[pattern.take], len(pattern.indices))
