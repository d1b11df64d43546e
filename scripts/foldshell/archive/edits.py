"""Edits of workbooks by a person, as what happened between two jobs."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.job_record import JobRecord
from foldshell.files.whole import hash_file
from foldshell.records.edits import WORKBOOK, read_written
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.peek import peek_thickness
from foldshell.workbook.read_thickness import SHEET, to_number

READER = "analyse"
"""The rule that reads workbooks of thicknesses."""
NAMED = 40
"""Cells that a sentence names one by one."""


@dataclass(frozen=True)
class CellEdit:
    """A cell that a person changed: its reference, the panel, thickness (m) before and after."""

    reference: str
    panel: int
    before: float
    after: float

    @property
    def place(self) -> str:
        """Sheet and cell, as formulas name them."""
        return f"{SHEET}!{self.reference}"

    def describe(self) -> str:
        """Say what it was and what it became."""
        return f"{self.place} (panel {self.panel}): {self.before!r} -> {self.after!r} m"


@dataclass(frozen=True)
class Edit:
    """A workbook that an analysis read with other bytes than the job before had written.

    `cells` is None where they are not known: the bytes that were read are gone.
    """

    path: str
    written_sha256: str
    read_sha256: str
    reader: str
    cells: tuple[CellEdit, ...] | None = None
    file: str = ""

    def describe(self) -> str:
        """Say in words what changed: the cells, where they are known."""
        return f"sha256 {self.written_sha256} became {self.read_sha256}: {self._say_cells()}"

    def _say_cells(self) -> str:
        if self.cells is None:
            return "the cells that changed are not known"
        if not self.cells:
            return "saved anew, no thickness changed"
        more = len(self.cells) - NAMED
        said = [cell.describe() for cell in self.cells[:NAMED]]
        return "; ".join([*said, *([f"and {more} more"] if more > 0 else [])])


def find_edits(records: Iterable[JobRecord]) -> list[Edit]:
    """Return the edits of a design that an analysis has read, in order of iterations."""
    records = list(records)
    written = {
        path: state.sha256
        for record in records
        for path, state in record.outputs.items()
        if path.endswith(WORKBOOK)
    }
    return [
        Edit(path, written[path], digest, record.name)
        for record in sorted(records, key=lambda record: record.name)
        if record.rule == READER
        for path, digest in record.inputs.items()
        if path in written and written[path] != digest
    ]


def describe_edits(home: Path, records: Iterable[JobRecord]) -> list[Edit]:
    """Return the edits of the design in a folder, with the cells that differ from what the
    workflow had written, and the file below the folder that holds what the analysis read."""
    return [_find_cells(home, edit) for edit in find_edits(records)]


def _find_cells(home: Path, edit: Edit) -> Edit:
    workbook = home / edit.path
    kept = workbook.with_name(f"edited-{edit.read_sha256[:12]}{workbook.suffix}")
    found = [file for file in (workbook, kept) if _is_file(file, edit.read_sha256)]
    if not found:
        return edit
    edit = replace(edit, file=found[0].relative_to(home).as_posix())
    record = read_written(workbook)
    if record is None or record.sha256 != edit.written_sha256 or record.thickness_m is None:
        return edit
    try:
        return replace(edit, cells=tuple(_compare(found[0], record.thickness_m)))
    except (InputError, ValueError, TypeError, IndexError):  # a workbook that no analysis takes
        return edit


def _is_file(path: Path, digest: str) -> bool:
    return path.is_file() and hash_file(path) == digest


def _compare(workbook: Path, before: tuple[float, ...]) -> Iterator[CellEdit]:
    peek = peek_thickness(workbook)
    for key, cell in peek.cells.items():
        panel, after = int(key), to_number(cell) if cell else None
        if after is not None and float(round_thickness(after)) != before[panel]:
            yield CellEdit(cell.reference, panel, before[panel], after)
