"""Isolines of a cell field, by linear interpolation inside each panel."""

import numpy as np

from foldshell.results.colour_scales import make_limit_scale
from foldshell.results.design_view import DesignView
from foldshell.results.fields import cell_area

ISOLINES = 5


def panel_node_values(
    values: np.ndarray, triangles: np.ndarray, panel: np.ndarray, area: np.ndarray
) -> np.ndarray:
    """Return corner values (C, 3) of cell values (C,): area means over a node's cells of a panel.

    Panels stay apart, since stresses jump across a fold.

    Any unit; triangles (C, 3) and panel (C,) are numbers, area (C,) is m2.
    """
    key = panel[:, None] * (triangles.max() + 1) + triangles
    _, number = np.unique(key, return_inverse=True)
    number = number.reshape(-1)
    weight = np.repeat(area, 3)
    total = np.bincount(number, weight * np.repeat(values, 3)) / np.bincount(number, weight)
    return total[number].reshape(-1, 3)


def find_region_border(triangles: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Return the edges (K, 2) between triangles (C, 3) that are inside a region and others (C,).

    Numbers of nodes; inside (C,) bool.
    """
    edge = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, number = np.unique(edge, axis=0, return_inverse=True)
    number = number.reshape(-1)
    count = np.bincount(number, minlength=len(edges))
    within = np.bincount(number, np.repeat(inside, 3), len(edges))
    return edges[(within > 0) & (within < count)]


def find_isolines(corners: np.ndarray, values: np.ndarray, level: float) -> np.ndarray:
    """Return the segments (S, 2, 3) on which a linear field has a level.

    Parameters
    ----------
    corners : (C, 3, 3) m, corners of the triangles
    values : (C, 3) at them
    """
    above = values > level
    cut = above.any(axis=1) & ~above.all(axis=1)
    corners, values, above = corners[cut], values[cut], above[cut]
    single = above.sum(axis=1) == 1
    apex = np.where(single, above.argmax(axis=1), above.argmin(axis=1))
    row = np.arange(len(apex))
    start, height = corners[row, apex], values[row, apex]
    ends = []
    for turn in (1, 2):
        other = (apex + turn) % 3
        share = (level - height) / (values[row, other] - height)
        ends.append(start + share[:, None] * (corners[row, other] - start))
    return np.stack(ends, axis=1)


def utilization_isolines(view: DesignView) -> list[tuple[float, np.ndarray]]:
    """Return levels, equally spaced from 0, and their segments (S, 2, 3) m."""
    state = view.state
    corners = state.cells.nodes[state.triangles]
    values = panel_node_values(
        state.utilization, state.triangles, state.cell_panel, cell_area(state)
    )
    scale = make_limit_scale(values, view.sizing.utilization_max)
    levels = np.linspace(scale.low, scale.high, ISOLINES + 1)[1:]
    return [(float(level), find_isolines(corners, values, level)) for level in levels]
