"""The panels of a design as rows of a table, and thicknesses as they stand in files."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True)
class PanelGrid:
    """Panels between zig-zags i, i+1 and strips j, j+1; panel p = i (strip_count - 1) + j."""

    zigzag_index: IntArray
    strip_index: IntArray

    @property
    def panel(self) -> IntArray:
        """Panel ids (P,): 0, 1, 2, ..."""
        return np.arange(self.zigzag_index.size)


@dataclass(frozen=True)
class ThicknessTable:
    """Columns of the sheet `thickness`, one value per panel in the order of ids.

    thickness and previous in m, utilization and relative change without unit.
    """

    grid: PanelGrid
    thickness: FloatArray
    previous: FloatArray | None = None
    utilization: FloatArray | None = None
    change: FloatArray | None = None
    note: tuple[str, ...] | None = None


def make_panel_grid(zigzag_count: int, strip_count: int) -> PanelGrid:
    """Number the (zigzag_count - 1)(strip_count - 1) panels between counts of polylines."""
    rows, columns = np.divmod(np.arange((zigzag_count - 1) * (strip_count - 1)), strip_count - 1)
    return PanelGrid(rows, columns)
