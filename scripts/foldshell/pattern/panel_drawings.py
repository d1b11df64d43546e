"""Drawings of panels that are no grid: their flat sheet, or the plan of a folded one."""

import numpy as np

from foldshell.pattern.drawings import Drawing
from foldshell.pattern.panel_mesh import PanelMesh


def draw_panels(mesh: PanelMesh, scale: float = 1.0, title: str = "") -> Drawing:
    """Turn panels into lines [mm] at `scale` (1 is full size): creases by kind, borders.

    A sheet without a flat state is drawn in plan, and its title says so.
    """
    shape = mesh.vertices if mesh.flat is None else mesh.flat
    if mesh.flat is None:
        title += ", plan of the folded sheet (its flat sheet is not known)"
    points = (shape[:, :2] - shape[mesh.panels.corners, :2].min(axis=0)) * 1000.0 * scale
    kinds = {"mountain": ("M",), "valley": ("V",), "flat": ("F", "U")}
    creases = {
        kind: points[mesh.edges[np.isin(mesh.assignments, letters)]]
        for kind, letters in kinds.items()
    }
    creases = {k: lines for k, lines in creases.items() if len(lines) or k != "flat"}
    loops = sorted((points[loop] for loop in mesh.borders), key=_area, reverse=True)
    return Drawing(loops[0], creases, scale, title, tuple(loops[1:]))


def _area(loop: np.ndarray) -> float:
    x, y = loop.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))
