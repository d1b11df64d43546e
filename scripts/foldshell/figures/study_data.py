"""What the study's figures draw: rows of summary.csv, with fields of the final states."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows
from foldshell.results.fields import cell_area
from foldshell.results.state import DesignState, read_state
from foldshell.settings.loads import Combinations
from foldshell.settings.stages import FINAL_STATE

NUMBERS = ("span_m", "height_m", "zigzag", "strip", "volume_per_area_m", "utilization_mean",
           "displacement_vertical_max_m")  # fmt: skip
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


def read_summary(path: str | Path) -> list[StudyDesign]:
    """Read summary.csv; raises `InputError` for one that is damaged."""
    return [_make_design(row) for row in read_rows(path, SummaryRow)]


def read_states(
    path: str | Path, results: str | Path, combinations: Combinations
) -> Iterator[tuple[StudyDesign, DesignState]]:
    """Yield each design of summary.csv with its final state, from its folder in `results`."""
    for design in read_summary(path):
        files = [Path(results, design.name, file) for file in FINAL_STATE]
        yield design, read_state(design.name, *files, combinations)


def _make_design(row: SummaryRow) -> StudyDesign:
    numbers = {name: getattr(row, name) for name in NUMBERS}
    return StudyDesign(
        name=row.design,
        tags=tuple(row.tags.split(",")),
        pattern=row.pattern,
        surface=row.surface,
        support=row.support,
        state=row.state,
        number={k: float("nan") if value is None else value for k, value in numbers.items()},
    )


def add_fields(design: StudyDesign, state: DesignState) -> StudyDesign:
    """Return the design with what its final state says about cells and panels."""
    if state.utilization is None:
        return design
    share = utilization_shares(state.utilization, cell_area(state))
    panels = np.stack([state.folded.planarity, state.final.utilization_panel_mean])
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
