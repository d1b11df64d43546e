"""What claims compare of one analysed state, as plain numbers from its report and its fields."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.measures import Measures
from foldshell.settings.loads import Combinations
from foldshell.settings.sizing import REINFORCED
from foldshell.shell.supports import SUPPORT_SETS

SCALARS = (
    "utilization_mean",
    "utilization_max",
    "utilization_panel_mean_max",
    "panels_above_one",
    "panels_at_bound",
)

LOCAL = ("strip", REINFORCED)
"""Measures whose own mean and variation over panels stand in for those of points."""


@dataclass(frozen=True)
class Layout:
    """Counts of polylines of a design, and which edges stand on supports: all, zigzag or strip; of
    a set of the table it is not known."""

    zigzag_count: int
    strip_count: int
    support: str

    @property
    def panels(self) -> int:
        """Panels of the sheet; those of edge beams follow them."""
        return (self.zigzag_count - 1) * (self.strip_count - 1)

    @property
    def free_edge_panels(self) -> np.ndarray:
        """True for panels in the row along an edge without supports, (P,)."""
        row, column = np.indices((self.zigzag_count - 1, self.strip_count - 1))
        on_zigzag = (row == 0) | (row == self.zigzag_count - 2)
        on_strip = (column == 0) | (column == self.strip_count - 2)
        known = SUPPORT_SETS.get(self.support)
        held = known.where if known else ()
        free = (on_zigzag & ("zigzag" not in held)) | (on_strip & ("strip" not in held))
        return free.ravel()


def measure_state(
    mesh: Mapping[str, np.ndarray],
    layout: Layout,
    report: AnalysisRecord,
    arrays: AnalysisArrays,
    combinations: Combinations,
    measure: str,
) -> Measures:
    """Return all measures of an analysed state; those of an answer it did not give are None.

    `mesh` are the arrays of mesh.npz, `combinations` has the groups strength and deflection.
    """
    count = len(combinations.deflection)
    factors = [report.buckling_factor[name] for name in combinations.strength]
    change = report.criteria.volume_change_relative
    return Measures(
        state=report.verdict,
        reason=report.reason,
        iterations=report.iteration + 1,
        volume=report.volume_m3,
        volume_per_area=report.volume_m3 / report.area_m2,
        volume_change=change and change.value,
        displacement=report.displacement_vertical_max_m,
        buckling_factor=min((factor for factor in factors if factor is not None), default=None),
        **{name: getattr(report, name) for name in SCALARS},
        panel_area=float(measure_panel_areas(mesh, layout).mean()),
        **measure_utilization(mesh, layout, arrays, measure),
        **measure_local(mesh, layout, arrays, measure),
        **measure_edge_displacement(mesh, layout, arrays.translations, count),
    )


def measure_panel_areas(mesh: Mapping[str, np.ndarray], layout: Layout) -> np.ndarray:
    """Return the areas of the sheet's panels (P,) m2."""
    area = np.bincount(mesh["facet_panel"], facet_areas(mesh["vertices"], mesh["facets"]))
    return area[: layout.panels]


def measure_utilization(
    mesh: Mapping[str, np.ndarray], layout: Layout, arrays: AnalysisArrays, measure: str
) -> dict[str, float | int | None]:
    """Return how even panels are used, and how many are above 1; None without an answer.

    `mesh` are the arrays of mesh.npz; `measure` is the utilization of a panel that limits hold
    for.
    """
    used = arrays.utilization_panel_mean
    if used is None:
        names = ("utilization_variation", "above_one", "above_one_at_free_edge")
        return dict.fromkeys(names)
    above = arrays.utilization(measure) > 1
    return {
        "utilization_variation": weighted_variation(used, measure_panel_areas(mesh, layout)),
        "above_one": int(above.sum()),
        "above_one_at_free_edge": int((above & layout.free_edge_panels).sum()),
    }


def measure_local(
    mesh: Mapping[str, np.ndarray], layout: Layout, arrays: AnalysisArrays, measure: str
) -> dict[str, float]:
    """Return how panels are used by strips, or as reinforced concrete, where a loop sized by it;
    nothing else.

    `mesh` are the arrays of mesh.npz.
    """
    used = arrays.utilization(measure) if measure in LOCAL else None
    return {} if used is None else summarise_local(used, measure_panel_areas(mesh, layout), measure)


def summarise_local(used: np.ndarray, area: np.ndarray, measure: str) -> dict[str, float]:
    """Return largest, mean and variation of the utilization of panels by a local measure.

    used (P,) without unit, area (P,) m2.
    """
    return {
        f"utilization_{measure}_max": float(used.max()),
        f"utilization_{measure}_mean": float(area @ used / area.sum()),
        f"utilization_{measure}_variation": weighted_variation(used, area),
    }


def measure_edge_displacement(
    mesh: Mapping[str, np.ndarray], layout: Layout, translations: np.ndarray | None, count: int
) -> dict[str, float | None]:
    """Return the largest downward displacement (m) along free edges and elsewhere.

    Along an edge means on a panel of the row beside it; `translations` is (N, 3, c) m with the
    deflection combinations in its last `count` columns.
    """
    nothing = {"displacement_edge": None, "displacement_inner": None}
    along = layout.free_edge_panels
    if translations is None or not along.any():
        return nothing
    down = (-translations[:, 2, -count:]).max(axis=1)
    sheet = mesh["panel"] < layout.panels
    elements = mesh["elements"][sheet]
    beside = along[mesh["panel"][sheet]]
    edge = np.unique(elements[beside])
    inner = np.setdiff1d(elements[~beside], edge)
    return {
        "displacement_edge": float(down[edge].max()),
        "displacement_inner": float(down[inner].max()),
    }


def measure_depth(vertices: np.ndarray, zigzag_count: int, strip_count: int) -> float:
    """Return the mean depth of the folds (m): how far ridges stand off the middle of the two
    zig-zags beside them, along the same strip line; (V, 3) m in the order of zig-zags."""
    point = vertices.reshape(zigzag_count, strip_count, 3)
    off = point[1:-1] - (point[:-2] + point[2:]) / 2
    return float(np.linalg.norm(off, axis=2).mean())


def facet_areas(vertices: np.ndarray, facets: np.ndarray) -> np.ndarray:
    """Return the area of triangles (F,) m2."""
    a, b, c = vertices[facets].swapaxes(0, 1)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def weighted_variation(values: np.ndarray, weight: np.ndarray) -> float:
    """Return the standard deviation over the mean (-), both weighted: values and weight (N,)."""
    mean = np.average(values, weights=weight)
    return float(np.sqrt(np.average((values - mean) ** 2, weights=weight)) / mean)
