"""The front door: from a target surface to a sized shell, in memory.

These functions join what the rules do one after the other; results are those of the workflow, to
the last bit.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.files.package_data import workflow_folder
from foldshell.folding.files import folded_arrays
from foldshell.folding.fold import FoldResult
from foldshell.folding.fold import fold_sheet as fold_onto
from foldshell.folding.mesh_target import MeshTarget
from foldshell.folding.quadric import Quadric
from foldshell.folding.targets import measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.pattern.fold_format import write_fold
from foldshell.pattern.sheet import Sheet
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.arrays import list_arrays
from foldshell.settings.design import DesignColumns
from foldshell.settings.field import list_settings
from foldshell.settings.fold import Pattern
from foldshell.settings.study import Settings
from foldshell.shell.edge_beams import make_edge_beam
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.case import AnalysisCase, make_case
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.loop import run_loop
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.panels import PanelGrid, ThicknessTable, mirror_panels
from foldshell.workbook.styles import Line, make_lines
from foldshell.workbook.write_thickness import write_thickness

DEFAULTS = DesignColumns()
"""What is taken where an argument is left out, as in a table of designs."""


@dataclass(frozen=True)
class FoldedSheet:
    """A sheet folded onto a target; `result` tells its state, shape and quality."""

    sheet: Sheet
    target: Quadric | MeshTarget
    result: FoldResult


@dataclass(frozen=True)
class Shell:
    """A folded sheet meshed and supported, ready to be analysed; `span` in m."""

    case: AnalysisCase
    grid: PanelGrid
    span: float
    settings: Settings


@dataclass(frozen=True)
class SizedShell:
    """A shell and the analyses of its loop, which are those of analysis.json.

    `final` is the one that is delivered, as in final.json: the last, or the best of a loop that did
    not converge; `thickness` (P,) m of the panels and `utilization` (P,), by the measure of the
    settings, are of it.
    """

    shell: Shell
    analyses: tuple[AnalysisRecord, ...]
    final: AnalysisRecord
    thickness: np.ndarray
    utilization: np.ndarray

    @property
    def last(self) -> AnalysisRecord:
        """The last analysis: verdict, reason, volume_m3, least_factor, ..."""
        return self.analyses[-1]


def make_sheet(
    target: Quadric | MeshTarget,
    zigzag_count: int,
    strip_count: int,
    pattern: str = DEFAULTS.pattern,
    sector_angle_deg: float = list_settings(Pattern)["sector_angle"].default,
) -> Sheet:
    """Size a crease pattern of so many zig-zags and strips for a target.

    `pattern` is miura, arc_miura, smooth (the target itself) or flat. Raises `ValueError`.
    """
    lengths, turning = target.section_lengths(), measure_turning(target)
    counts = zigzag_count, strip_count
    return design_sheet(pattern, lengths, *counts, sector_angle_deg, turning=turning)


def fold_sheet(
    sheet: Sheet,
    target: Quadric | MeshTarget,
    mode: str = DEFAULTS.fold_mode,
    settings: Settings | None = None,
) -> FoldedSheet:
    """Fold a sheet onto a target; a sheet that does not reach it says so in `result.state`."""
    chosen = (settings or Settings()).fold
    return FoldedSheet(sheet, target, fold_onto(sheet, target, mode, chosen))


def mesh_shell(
    folded: FoldedSheet,
    support: str = DEFAULTS.support,
    settings: Settings | None = None,
    edge_beam: tuple[float, float] = (DEFAULTS.edge_beam_depth, DEFAULTS.edge_beam_thickness),
) -> Shell:
    """Mesh a folded sheet, pin it along zig-zag, strip or all borders, and hang an edge beam of a
    depth and a thickness (m) from free ones. Raises `ValueError` for a mechanism."""
    settings = settings or Settings()
    arrays = list_arrays(folded_arrays(folded.sheet, folded.result))
    beam = make_edge_beam(*edge_beam)
    mesh = mesh_folded_sheet(arrays, support, settings.analysis.subdivisions, edge_beam=beam)
    case = make_case(mesh, settings)
    first = folded.sheet.grid.quads[:, 0]
    grid = PanelGrid(arrays["zigzag"][first], arrays["strip"][first])
    return Shell(case, grid, folded.target.span, settings)


def analyse_shell(shell: Shell, thickness: float | np.ndarray) -> SizedShell:
    """Analyse a shell of one thickness, or of one per panel (P,) m, to second order."""
    values = np.broadcast_to(np.asarray(thickness, float), shell.grid.panel.shape)
    task = IterationTask(0, shell.span, round_thickness(values))
    record, arrays = shell.case.run(task, alone=True)
    return _gather(shell, [record], record, arrays)


def size_shell(shell: Shell) -> SizedShell:
    """Size the panels of a shell from the start thickness of the settings until a verdict."""
    sizing = shell.settings.sizing
    limits = mirror_panels(shell.grid, sizing.symmetry)
    done = run_loop(shell.case, shell.span, sizing, limits)
    return _gather(shell, done.analyses, done.final, done.arrays)


def _gather(
    shell: Shell, analyses: Sequence[AnalysisRecord], final: AnalysisRecord, arrays: AnalysisArrays
) -> SizedShell:
    used = arrays.utilization(shell.case.sizing.measure)
    used = np.full(shell.grid.panel.size, np.nan) if used is None else used
    return SizedShell(shell, tuple(analyses), final, arrays.thickness, used)


def write_workbook(path: str | Path, sized: SizedShell, title: str = "shell") -> None:
    """Write thickness.xlsx with the thicknesses (m) of a shell's panels."""
    sizing, keys = sized.shell.case.sizing, ("iteration", "verdict", "reason", "volume_m3")
    summary = [Line("design", title), *make_lines(sized.final, keys)]
    table = ThicknessTable(sized.shell.grid, sized.thickness)
    bounds = sizing.least_thickness, sizing.largest_thickness
    write_thickness(path, table, summary, *bounds)


def write_pattern(path: str | Path, sheet: Sheet, title: str = "sheet") -> None:
    """Write a crease pattern as a FOLD file (m)."""
    write_fold(path, sheet, title)


def snakefile() -> str:
    """Return the path of the workflow's Snakefile, to be included by one of your own."""
    return str(workflow_folder() / "Snakefile")
