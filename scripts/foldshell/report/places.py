"""Where utilization governs: the panel with the largest mean, and its place."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.pattern.folded_panels import list_panels
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.arrays import read_typed_arrays
from foldshell.records.sheet_arrays import FoldedArrays


@dataclass(frozen=True)
class PanelPlace:
    """A panel by its number, from 0, and the mean of its corners x, y, z in m."""

    panel: int
    middle: tuple[float, float, float]

    @property
    def words(self) -> str:
        """Panel and place, as the checks say it."""
        return f"panel {self.panel} at {describe_place(self.middle)}"


def describe_place(place: tuple[float, float, float]) -> str:
    """Return a place (3,) m in words."""
    return "x {:.1f}, y {:.1f}, z {:.1f} m".format(*place)


def find_panel(used: np.ndarray | None, folded: FoldedArrays) -> PanelPlace | None:
    """Return the panel that is used most and where it is, None without utilization.

    `used` is the utilization of the panels, (P,) without unit.
    """
    if used is None or not np.isfinite(used).any():
        return None
    panel = int(np.nanargmax(used))
    middle = folded.vertices[list_panels(folded)[panel]].mean(axis=0)
    return PanelPlace(panel, tuple(middle.tolist()))


def read_panels(final: str | Path, folded: str | Path) -> dict[str, PanelPlace]:
    """Return the panel that each measure of utilization finds used most, by its criterion.

    `final` and `folded` are final.npz and folded.npz; nothing where they cannot be read.
    """
    try:
        arrays = read_typed_arrays(final, AnalysisArrays)
        sheet = read_typed_arrays(folded, FoldedArrays)
    except InputError:
        return {}
    names = ("utilization_panel_mean", "utilization_element_max", "utilization_strip")
    names += ("utilization_reinforced",)
    found = {name: find_panel(getattr(arrays, name), sheet) for name in names}
    return {name: place for name, place in found.items() if place is not None}
