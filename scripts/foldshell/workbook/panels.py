"""The panels of a design as rows of a table, and thicknesses as they stand in files."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from foldshell.pattern.folded_panels import list_panels, measure_middles, measure_panel_areas
from foldshell.records.arrays import read_typed_arrays
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.sizing.panel_limits import PanelLimits, mirror_groups

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
Paths = Sequence[str | Path]


@dataclass(frozen=True)
class PanelGrid:
    """Panels by id, 0, 1, 2, ..., and what tells a person which is which.

    Of a grid these are zig-zags i, i+1 and strips j, j+1, panel p = i (strip_count - 1) + j; of any
    other sheet the mean (P, 3) m of its corners, area (P,) m2 and number of corners (P,), behind
    the integers (P,) that a pattern has names for (`labels`).
    """

    zigzag_index: IntArray | None = None
    strip_index: IntArray | None = None
    labels: Mapping[str, IntArray] = field(default_factory=dict)
    middle: FloatArray | None = None
    area: FloatArray | None = None
    corners: IntArray | None = None

    @property
    def indices(self) -> dict[str, IntArray]:
        """Integers (P,) by name that a row of a table is checked by."""
        known = {"zigzag": self.zigzag_index, "strip": self.strip_index, **self.labels}
        return {name: values for name, values in known.items() if values is not None}

    @property
    def panel(self) -> IntArray:
        """Panel ids (P,): 0, 1, 2, ..."""
        first = self.zigzag_index if self.area is None else self.area
        return np.arange(0 if first is None else first.size)

    @property
    def columns(self) -> list[tuple[str, str, str, npt.NDArray]]:
        """Name, unit, style and values (P,) of the columns that stand behind the id."""
        found = [(name, "-", "integer", values) for name, values in self.indices.items()]
        if self.area is not None:
            places = zip("xyz", self.middle.T, strict=True)
            found += [(axis, "m", "metre", values) for axis, values in places]
            found += [("area", "m2", "metre", self.area), ("corners", "-", "integer", self.corners)]
        return found


@dataclass(frozen=True)
class ThicknessTable:
    """Columns of the sheet `thickness`, one value per panel in the order of ids.

    thickness and previous in m, utilization and relative change without unit; `limits` are what a
    person asks of panels.
    """

    grid: PanelGrid
    thickness: FloatArray
    previous: FloatArray | None = None
    utilization: FloatArray | None = None
    change: FloatArray | None = None
    note: tuple[str, ...] | None = None
    limits: PanelLimits | None = None


def make_panel_grid(zigzag_count: int, strip_count: int) -> PanelGrid:
    """Number the (zigzag_count - 1)(strip_count - 1) panels between counts of polylines."""
    rows, columns = np.divmod(np.arange((zigzag_count - 1) * (strip_count - 1)), strip_count - 1)
    return PanelGrid(rows, columns)


def list_sheet_panels(folded_path: str | Path) -> PanelGrid:
    """Return the panels of folded.npz, of a sheet that is no grid. Raises `InputError`."""
    folded = read_typed_arrays(folded_path, FoldedArrays)
    labels = {"row": folded.panel_row, "place": folded.panel_place}
    return PanelGrid(
        labels={name: values for name, values in labels.items() if values is not None},
        middle=measure_middles(folded),
        area=measure_panel_areas(folded),
        corners=np.diff(list_panels(folded).starts),
    )


def choose_panels(zigzag_count: int, strip_count: int, folded: Paths) -> PanelGrid:
    """Return the panels of a grid, or those of folded.npz where one is given."""
    if folded:
        return list_sheet_panels(folded[0])
    return make_panel_grid(zigzag_count, strip_count)


def mirror_panels(grid: PanelGrid, symmetry: str) -> PanelLimits | None:
    """Return the groups of panels that mirror each other (`sizing.symmetry`), None for none.

    Along a grid strips lie across x and zig-zags across y; other sheets are mirrored in plan.
    """
    if grid.area is None:
        return mirror_groups(symmetry, grid.strip_index, grid.zigzag_index)
    return mirror_groups(symmetry, *grid.middle.T[:2], np.sqrt(grid.area) / 2)
