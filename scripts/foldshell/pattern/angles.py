"""Angles of a triangulated sheet: folds about edges, sectors about vertices."""

import numpy as np

from foldshell.pattern.grid import Grid, find_hinges


def measure_hinges(vertices: np.ndarray, hinges: np.ndarray) -> np.ndarray:
    """phi = atan2(|e| (n_l x n_r).e, ...): fold angles (H,) [rad] in (-pi, pi].

    vertices (V, 3), hinges (H, 4) of ends, left and right opposite vertex. Valley positive,
    flat 0.
    """
    first, second, left, right = (vertices[hinges[:, k]] for k in range(4))
    edge = second - first
    normal_left = np.cross(edge, left - first)
    normal_right = np.cross(right - first, edge)
    sine = np.einsum("ij,ij->i", right - first, normal_left)
    sine *= np.linalg.norm(edge, axis=1)
    return np.arctan2(sine, np.einsum("ij,ij->i", normal_left, normal_right))


def measure_folds(vertices: np.ndarray, grid: Grid) -> np.ndarray:
    """Fold angle (E,) [rad] of every edge of a sheet, 0 on its border; valley positive."""
    hinges = find_hinges(grid.facets, grid.edges)
    angles = np.zeros(len(grid.edges))
    angles[hinges.edges] = measure_hinges(vertices, hinges.vertices)
    return angles


def corner_sectors(grid: Grid) -> np.ndarray:
    """Rows (4, N, 3) of (vertex, arm, arm): the four panel corners about interior vertices.

    Counter-clockwise from the panel at (i, j), i.e. ahead along both counts.
    """
    number = np.arange(grid.zigzag_count * grid.strip_count).reshape(
        grid.zigzag_count, grid.strip_count
    )
    centre = number[1:-1, 1:-1].ravel()
    around = [number[1:-1, 2:], number[2:, 1:-1], number[1:-1, :-2], number[:-2, 1:-1]]
    arms = [arm.ravel() for arm in around]
    return np.stack([np.column_stack([centre, arms[k], arms[(k + 1) % 4]]) for k in range(4)])


def measure_sectors(vertices: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Angle [rad] between the two arms of each (vertex, arm, arm) row of `corners` (..., 3)."""
    one = vertices[corners[..., 1]] - vertices[corners[..., 0]]
    two = vertices[corners[..., 2]] - vertices[corners[..., 0]]
    cross = np.linalg.norm(np.cross(one, two), axis=-1)
    return np.arctan2(cross, np.sum(one * two, axis=-1))


def developability_residual(vertices: np.ndarray, grid: Grid) -> np.ndarray:
    """Sum of the facet angles about each interior vertex less 2 pi (N,) [rad].

    Summed over facets, not panel corners, so that it is the angle defect of the mesh itself
    when panels are not planar.
    """
    corners = np.stack([np.roll(grid.facets, -k, axis=1) for k in range(3)]).reshape(-1, 3)
    total = np.zeros(len(vertices))
    np.add.at(total, corners[:, 0], measure_sectors(vertices, corners))
    return total[corner_sectors(grid)[0][:, 0]] - 2 * np.pi


def flat_foldability_residual(vertices: np.ndarray, grid: Grid) -> np.ndarray:
    """Kawasaki: sector angles 1 - 2 + 3 - 4 about each interior vertex (N,) [rad]."""
    sectors = measure_sectors(vertices, corner_sectors(grid))
    return sectors[0] - sectors[1] + sectors[2] - sectors[3]
