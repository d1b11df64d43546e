"""All iterations of one design, read back from their files."""

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.job_record import FOLDER
from foldshell.files.whole import TEMPORARY_PREFIX, atomic_path
from foldshell.records.analysis import AnalysisRecord, read_analysis, write_analysis
from foldshell.records.analysis_arrays import AnalysisArrays, IterationsArrays
from foldshell.records.arrays import read_typed_arrays, write_typed_arrays
from foldshell.records.edits import keep_edited
from foldshell.records.files import REMEDY
from foldshell.records.history import HistoryRow
from foldshell.records.iteration import read_iteration
from foldshell.records.table import read_rows
from foldshell.results.history import make_history
from foldshell.settings.stage import StageSettings
from foldshell.sizing.case import open_case
from foldshell.sizing.delivery import choose_delivered, complete_delivered, describe_delivered

SUPERSEDED = "superseded"


@dataclass(frozen=True)
class Iterations:
    """Every analysis, the rows of the history, panels in each of them, and what final.json and
    final.npz hold; thickness (P,) m and utilization (P,), by the measure of the loop, of that
    state, nan without an answer. `final_arrays` is None where a file holds them already."""

    analyses: list[AnalysisRecord]
    history: list[HistoryRow]
    panels: IterationsArrays
    last_arrays: Path
    thickness: np.ndarray
    utilization: np.ndarray
    final: AnalysisRecord
    final_arrays: AnalysisArrays | None = None


def gather_iterations(
    json_paths: Sequence[str | Path],
    span: float,
    given: StageSettings,
    mesh_path: str | Path,
) -> Iterations:
    """Read the iterations in order; where not the last one is delivered, complete that; span m.

    Raises
    ------
    InputError
        for a file that is missing, damaged or out of order.
    """
    both = [_read(path, number) for number, path in enumerate(json_paths)]
    analyses, arrays = [one for one, _ in both], [fields for _, fields in both]
    thicknesses = [item.thickness for item in arrays]
    history = make_history(analyses, thicknesses, span / given.sizing.displacement_limit_span_over)
    number = choose_delivered(analyses)
    final, fields = analyses[number], None
    if number < analyses[-1].iteration:
        before = both[number - 1] if number else None
        final, fields = complete_delivered(open_case(mesh_path, given), span, both[number], before)
    utilization = arrays[number].utilization(given.sizing.measure)
    if utilization is None:
        utilization = np.full(len(thicknesses[number]), np.nan)
    return Iterations(
        analyses,
        history,
        _stack_panels(arrays),
        Path(json_paths[-1]).with_suffix(".npz"),
        thicknesses[number],
        utilization,
        describe_delivered(analyses, final),
        fields,
    )


def read_gathered(folder: str | Path, measure: str) -> Iterations:
    """Return what `write_final` and the history of a loop hold, from its folder `sizing`.

    Raises `InputError` for a file that is missing or damaged.
    """
    folder = Path(folder)
    history = read_rows(folder / "history.csv", HistoryRow)
    analyses = [read_analysis(folder / f"{row.iteration:02d}/analysis.json") for row in history]
    final, arrays = read_iteration(folder / "final.json")
    panels = read_typed_arrays(folder / "iterations.npz", IterationsArrays)
    utilization = arrays.utilization(measure)
    if utilization is None:
        utilization = np.full(len(arrays.thickness), np.nan)
    place = folder / "final.npz"
    return Iterations(analyses, history, panels, place, arrays.thickness, utilization, final)


def _stack_panels(arrays: Sequence[AnalysisArrays]) -> IterationsArrays:
    used = [
        np.full(len(one.thickness), np.nan)
        if one.utilization_panel_mean is None
        else one.utilization_panel_mean
        for one in arrays
    ]
    thickness = np.stack([one.thickness for one in arrays])
    return IterationsArrays(thickness=thickness, utilization_panel_mean=np.stack(used))


def write_final(
    json_path: str | Path,
    arrays_path: str | Path,
    panels_path: str | Path,
    iterations: Iterations,
) -> None:
    """Write iterations.npz, then final.npz and final.json of the state that is delivered."""
    write_typed_arrays(panels_path, iterations.panels)
    if iterations.final_arrays is None:
        with atomic_path(arrays_path) as temporary:
            shutil.copyfile(iterations.last_arrays, temporary)
    else:
        write_typed_arrays(arrays_path, iterations.final_arrays)
    write_analysis(json_path, iterations.final)


def _read(path: str | Path, number: int) -> tuple[AnalysisRecord, AnalysisArrays]:
    record, arrays = read_iteration(path)
    if record.iteration != number:
        raise InputError(f"{path}: iteration: {record.iteration}: must be {number}: {REMEDY}")
    return record, arrays


def remove_superseded(sizing: Path, count: int) -> list[int]:
    """Remove the folders of iterations `count`, `count` + 1, ...; return their numbers.

    They stem from an earlier run, before an edit or another setting ended the loop sooner. Copies
    of edited workbooks in them move to `superseded/`. Half-written files that a kill left in the
    others go too.
    """
    for leftover in sizing.glob(f"[0-9][0-9]/{TEMPORARY_PREFIX}*"):
        leftover.unlink()
    removed = []
    for folder in sorted(sizing.glob("[0-9][0-9]")):
        if int(folder.name) < count:
            continue
        keep_edited(folder / "thickness.xlsx")
        for copy in sorted(folder.glob("edited-*.xlsx")):
            (sizing / SUPERSEDED).mkdir(exist_ok=True)
            copy.replace(sizing / SUPERSEDED / f"{folder.name}-{copy.name}")
        for record in (sizing.parent / FOLDER).glob(f"*-{folder.name}.json"):
            record.unlink()
        shutil.rmtree(folder)
        removed.append(int(folder.name))
    return removed
