"""What the study's figures compare: rows of summary.csv, sorted into groups and series."""

import csv
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from foldshell.files.errors import InputError
from foldshell.results.fields import cell_area
from foldshell.results.state import DesignState, read_state
from foldshell.settings.stages import FINAL_STATE

NUMBERS = ("span_m", "height_m", "zigzag", "strip", "volume_per_area_m", "utilization_mean",
           "displacement_vertical_max_m")  # fmt: skip
SURFACES = ("paraboloid", "hypar", "arch")
SUPPORTS = ("all", "zigzag", "strip")
UTILIZATION_BIN = 0.1
UTILIZATION_END = 2.0


@dataclass(frozen=True)
class StudyDesign:
    """One row of the summary; numbers that are missing are nan. `share` (B,) is the share of the
    mesh area in each bin of utilization, `panels` (2, P) planarity (-) and mean utilization (-) of
    each panel; both None without utilization."""

    name: str
    tags: tuple[str, ...]
    pattern: str
    surface: str
    support: str
    state: str
    number: Mapping[str, float]
    share: np.ndarray | None = None
    panels: np.ndarray | None = None

    @property
    def span_height(self) -> str:
        """Span and height in m as `28/10`."""
        return f"{self.number['span_m']:g}/{self.number['height_m']:g}"

    @property
    def density(self) -> str:
        """Polylines as `15x16`."""
        return f"{self.number['zigzag']:g}x{self.number['strip']:g}"


@dataclass(frozen=True)
class Comparison:
    """Which designs a figure compares: a column of charts a value of `column`, a line or bar a
    value of `series`."""

    title: str
    tag: str
    column: Callable[[StudyDesign], str]
    series: Callable[[StudyDesign], str]
    chosen: Callable[[StudyDesign], bool] = lambda design: True


COMPARISONS: dict[str, Comparison] = {
    "supports": Comparison("Supported edges", "supports", lambda d: d.surface, lambda d: d.support),
    "surface": Comparison(
        "Surfaces", "supports", lambda d: f"{d.support} edges supported", lambda d: d.surface
    ),
    "curvature": Comparison(
        "Span / height [m]",
        "curvature",
        lambda d: f"{d.surface}, {d.support} edges supported",
        lambda d: d.span_height,
    ),
    "density_zigzag": Comparison(
        "Zig-zags x strips, zig-zag edges supported",
        "density",
        lambda d: d.surface,
        lambda d: d.density,
        lambda d: d.support == "zigzag",
    ),
    "density_strip": Comparison(
        "Zig-zags x strips, strip edges supported",
        "density",
        lambda d: d.surface,
        lambda d: d.density,
        lambda d: d.support == "strip",
    ),
}


def read_summary(path: str | Path) -> list[StudyDesign]:
    """Read summary.csv.

    Raises
    ------
    InputError
        for a column that is missing or a number that is none.
    """
    with Path(path).open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return [_read_row(path, row) for row in rows]


def read_states(
    path: str | Path, results: str | Path, combinations: Mapping[str, Any]
) -> Iterator[tuple[StudyDesign, DesignState]]:
    """Yield each design of summary.csv with its final state, from its folder in `results`."""
    for design in read_summary(path):
        files = [Path(results, design.name, file) for file in FINAL_STATE]
        yield design, read_state(design.name, *files, combinations)


def _read_row(path: str | Path, row: Mapping[str, Any]) -> StudyDesign:
    missing = {"design", "tags", "pattern", "surface", "support", "state", *NUMBERS} - set(row)
    if missing:
        raise InputError(f"{path}: header: no column {min(missing)}: it is needed")
    number = {}
    for name in NUMBERS:
        try:
            number[name] = float(row[name]) if row[name] else float("nan")
        except ValueError:
            raise InputError(
                f"{path}: {row['design']}, {name}: {row[name]!r}: must be a number"
            ) from None
    return StudyDesign(
        name=row["design"],
        tags=tuple(row["tags"].split(",")),
        pattern=row["pattern"],
        surface=row["surface"],
        support=row["support"],
        state=row["state"],
        number=number,
    )


def add_fields(design: StudyDesign, state: DesignState) -> StudyDesign:
    """Return the design with what its final state says about cells and panels."""
    if state.utilization is None:
        return design
    share = utilization_shares(state.utilization, cell_area(state))
    panels = np.stack([state.folded["planarity"], state.final["utilization_panel_mean"]])
    return replace(design, share=share, panels=panels)


def utilization_edges() -> np.ndarray:
    """Return the edges (B + 1,) of the bins; the last bin has no upper end. Without unit."""
    count = round(UTILIZATION_END / UTILIZATION_BIN)
    return np.append(np.arange(count + 1) * UTILIZATION_BIN, np.inf)


def utilization_shares(values: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Return the share (B,) of the area of cells in each bin of utilization; they add up to 1."""
    edges = utilization_edges()
    number = np.searchsorted(edges, values, side="right") - 1
    return np.bincount(number, area, len(edges) - 1) / area.sum()


def sort_into_columns(
    designs: Iterable[StudyDesign], comparison: Comparison
) -> dict[str, dict[str, StudyDesign]]:
    """Return {column: {series: design}} of the designs of a comparison.

    Surfaces and supports keep the order of the paper, other series that of the summary.
    """
    chosen = [d for d in designs if comparison.tag in d.tags and comparison.chosen(d)]
    chosen.sort(key=lambda d: (_place(d.surface, SURFACES), _place(d.support, SUPPORTS)))
    columns: dict[str, dict[str, StudyDesign]] = {}
    for design in chosen:
        columns.setdefault(comparison.column(design), {})[comparison.series(design)] = design
    return columns


def pair_supports(designs: Sequence[StudyDesign]) -> list[tuple[StudyDesign, StudyDesign]]:
    """Return pairs that differ only in being supported on zig-zag or on strip edges (Fig. 8)."""
    key = {
        (d.pattern, d.surface, d.span_height, d.density, d.support): d
        for d in designs
        if "density" in d.tags
    }
    pairs = [
        (design, key[(*rest, "strip")])
        for (*rest, support), design in key.items()
        if support == "zigzag" and (*rest, "strip") in key
    ]
    return sorted(pairs, key=lambda pair: _place(pair[0].surface, SURFACES))


def _place(value: str, order: Sequence[str]) -> int:
    return order.index(value) if value in order else len(order)
