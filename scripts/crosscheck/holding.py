"""What supports exert: rows of stiffness at held translations, and springs at nodes."""

from dataclasses import dataclass

import numpy as np

from crosscheck.discretisation import Discretisation


@dataclass(frozen=True)
class Holding:
    """Rows of stiffness at held translations: H facets that have such nodes, global x, y, z."""

    facets: np.ndarray  # (H,)
    held: np.ndarray  # (H, n, 3) which translations of the n = 12m outline nodes are held
    rows: np.ndarray  # (H, n, 3, 6n) kN/m, zero where nothing is held

    def keep(self, part: np.ndarray, total: np.ndarray) -> None:
        """Keep the rows of some facets, `part` their numbers, of matrices (f, 6n, 6n) in kN/m."""
        _, mine, given = np.intersect1d(self.facets, part, return_indices=True)
        size = total.shape[-1]
        rows = total[given].reshape(len(given), size // 6, 6, size)[:, :, :3]
        self.rows[mine] = np.where(self.held[mine][..., None], rows, 0.0)


def make_holding(grid: Discretisation) -> Holding:
    """The facets with held nodes, their rows still to be kept."""
    held = grid.equations[:, :, :3] < 0
    facets = np.flatnonzero(held.any(axis=(1, 2)))
    nodes = held.shape[1]
    return Holding(facets, held[facets], np.zeros((len(facets), nodes, 3, 6 * nodes)))


def add_springs(total: np.ndarray, springs: np.ndarray) -> None:
    """Add springs (F, n, 3) to the diagonals of facet matrices (F, 6n, 6n), kN/m both."""
    count, nodes = springs.shape[:2]
    six = np.concatenate([springs, np.zeros_like(springs)], axis=2).reshape(count, -1)
    place = np.arange(6 * nodes)
    total[:, place, place] += six


def find_reactions(
    grid: Discretisation, holding: Holding, outline: np.ndarray, load: np.ndarray
) -> np.ndarray:
    """K u - F at the held translations of skeleton nodes, -k u of springs: (S, 3, c) in kN.

    `outline` (F, n, 6, c) are global displacements in m and rad, `load` the condensed loads.
    """
    facets = holding.facets
    nodes, cases = outline.shape[1], outline.shape[-1]
    rows = holding.rows.reshape(len(facets), 3 * nodes, 6 * nodes)
    moved = outline[facets].reshape(len(facets), 6 * nodes, cases)
    force = (rows @ moved).reshape(len(facets), nodes, 3, cases)
    force -= np.where(holding.held[..., None], load[facets, :, :3], 0.0)
    total = np.zeros((grid.mesh.skeleton, 3, cases))
    np.add.at(total, grid.mesh.facet_nodes[facets, :nodes], force)
    if grid.springs is not None:
        pull = -grid.springs[..., None] * outline[:, :, :3]
        np.add.at(total, grid.mesh.facet_nodes[:, :nodes], pull)
    return total
