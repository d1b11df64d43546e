"""What a person asks of single panels: to stay as they are, bounds, one thickness in a group."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from foldshell.records.analysis_arrays import AnalysisArrays

FloatArray = npt.NDArray[np.float64]
NO_GROUP = 0


@dataclass(frozen=True)
class PanelLimits:
    """Arrays (P,): `fixed` panels keep their thickness; `least` and `largest` in m, nan for the
    bounds of the settings; panels of one `group` (from 1, `NO_GROUP` for none) are alike."""

    fixed: npt.NDArray[np.bool_]
    least: FloatArray
    largest: FloatArray
    group: npt.NDArray[np.int64]

    @property
    def given(self) -> bool:
        """Whether anything is asked for at all."""
        bounds = np.isfinite(self.least) | np.isfinite(self.largest)
        return bool((self.fixed | bounds | (self.group != NO_GROUP)).any())


def no_limits(count: int) -> PanelLimits:
    """Return limits of so many panels that ask for nothing."""
    least, largest = np.full((2, count), np.nan)
    return PanelLimits(np.zeros(count, bool), least, largest, np.zeros(count, np.int64))


def limits_of(arrays: AnalysisArrays) -> PanelLimits | None:
    """Return the limits that analysis.npz holds, None for none."""
    if arrays.panel_fixed is None:
        return None
    found = arrays.panel_fixed, arrays.panel_least, arrays.panel_largest, arrays.panel_group
    return PanelLimits(*found)


def name_limits(limits: PanelLimits | None) -> dict[str, np.ndarray]:
    """Return limits by the names of their arrays in analysis.npz; none where nothing is asked."""
    if limits is None or not limits.given:
        return {}
    return {f"panel_{name}": values for name, values in vars(limits).items()}


def bound_panels(
    limits: PanelLimits | None, thickness: FloatArray, least: float, largest: float
) -> tuple[FloatArray, FloatArray]:
    """Return least and largest thickness of each panel, (P,) m each.

    Both are the thickness (P,) m of a fixed panel, and of all panels in its group.

    `least` and `largest` (m) are those of the settings.
    """
    low, high = np.full(len(thickness), least), np.full(len(thickness), largest)
    if limits is None:
        return low, high
    low = np.where(limits.fixed, thickness, np.fmax(low, limits.least))
    high = np.where(limits.fixed, thickness, np.fmin(high, limits.largest))
    member = index_groups(limits)
    return gather(np.maximum, low, member)[member], gather(np.minimum, high, member)[member]


def index_groups(limits: PanelLimits) -> npt.NDArray[np.int64]:
    """Return the number of each panel's group (P,), from 0 on; a panel in none has its own."""
    panel = np.arange(len(limits.group))
    key = np.where(limits.group == NO_GROUP, panel, len(panel) + limits.group)
    return np.unique(key, return_inverse=True)[1].ravel()


def gather(ufunc: np.ufunc, values: np.ndarray, member: npt.NDArray[np.int64]) -> np.ndarray:
    """Reduce values (P,) of any unit over the groups `member` (P,) belong to: (G,)."""
    order = np.argsort(member, kind="stable")
    return ufunc.reduceat(values[order], np.searchsorted(member[order], range(member.max() + 1)))


def hold_limits(
    limits: PanelLimits | None, thickness: FloatArray, least: float, largest: float
) -> FloatArray:
    """Return the thickness (P,) m within the bounds of each panel, the largest in each group.

    `least` and `largest` (m) are those of the settings.
    """
    if limits is None:
        return thickness
    low, high = bound_panels(limits, thickness, least, largest)
    member = index_groups(limits)
    return np.clip(gather(np.maximum, thickness, member)[member], low, high)


def find_conflict(limits: PanelLimits, thickness: FloatArray, least: float, largest: float) -> str:
    """Say which panel cannot keep what is asked of it, empty for none; thickness (P,) m."""
    for panel in np.flatnonzero(limits.least > limits.largest):
        return (
            f"panel {panel}: least {limits.least[panel]:g} m is above largest "
            f"{limits.largest[panel]:g} m"
        )
    outside = (thickness < limits.least) | (thickness > limits.largest)
    for panel in np.flatnonzero(limits.fixed & outside):
        return (
            f"panel {panel}: it is fixed at {thickness[panel]:g} m, outside of its own bounds: "
            "leave them empty or change the thickness"
        )
    low, high = bound_panels(limits, thickness, least, largest)
    for panel in np.flatnonzero(low > high):
        own = np.flatnonzero(limits.group == limits.group[panel]).tolist()
        return (
            f"group {limits.group[panel]}: panels {', '.join(map(str, own[:6]))} cannot be alike: "
            f"bounds and fixed panels ask for at least {low[panel]:g} and at most {high[panel]:g} m"
        )
    return ""


def mirror_groups(
    across: str, x: np.ndarray, y: np.ndarray, size: FloatArray | float = 0.5
) -> PanelLimits | None:
    """Return one group for each set of panels that mirror each other in plan; None for `none`.

    Parameters
    ----------
    across : none, x (about the middle of x), y or both
    x, y : (P,) place of each panel, m or numbers along a grid
    size : (P,) of each panel, in the same unit: a mirror image is found within half of it
    """
    if across == "none":
        return None
    place = np.column_stack([x, y]).astype(float)
    size = np.broadcast_to(size, len(place))
    centre = (place.min(axis=0) + place.max(axis=0)) / 2
    member = np.arange(len(place))
    for axis in {"x": [0], "y": [1]}.get(across, [0, 1]):
        image = place.copy()
        image[:, axis] = 2 * centre[axis] - image[:, axis]
        near, distance = _find_nearest(image, place)
        joined = np.where(distance <= size / 2, near, np.arange(len(place)))
        member = np.minimum(member, member[joined])
    values, group = np.unique(member, return_inverse=True)
    alone = np.bincount(group.ravel(), minlength=len(values))[group.ravel()] == 1
    numbers = np.where(alone, NO_GROUP, group.ravel() + 1)
    limits = no_limits(len(place))
    return PanelLimits(limits.fixed, limits.least, limits.largest, numbers)


def _find_nearest(image: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    from scipy.spatial import cKDTree

    distance, near = cKDTree(place).query(image)
    return near, distance
