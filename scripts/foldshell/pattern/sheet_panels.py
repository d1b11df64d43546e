"""A sheet of a crease grid as panels of any kind."""

import numpy as np

from foldshell.pattern.panel_graph import Ragged
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.sheet import Sheet


def make_sheet_panels(sheet: Sheet, folded: np.ndarray, flat: np.ndarray) -> PanelMesh:
    """Return a sheet's quadrilaterals with its creases, folded and flat states (V, 3) m.

    Panels keep their row, the zig-zag before them, and their place in it, the strip before them.
    """
    grid = sheet.grid
    creases = slice(0, grid.neutral.start)
    starts = 4 * np.arange(len(grid.quads) + 1)
    first = grid.quads[:, 0]
    return PanelMesh(
        Ragged(starts, grid.quads.ravel()),
        grid.edges[creases],
        grid.assignments[creases],
        np.full(grid.neutral.start, np.nan),
        flat=flat,
        folded=folded,
        labels={"row": grid.zigzag_index[first], "place": grid.strip_index[first]},
    )
