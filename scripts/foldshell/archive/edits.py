"""Edits of workbooks by a person, as what happened between two jobs."""

from collections.abc import Iterable
from dataclasses import dataclass

from foldshell.files.job_record import JobRecord
from foldshell.records.edits import WORKBOOK


@dataclass(frozen=True)
class Edit:
    """A workbook that an analysis read with other bytes than the job before had written."""

    path: str
    written_sha256: str
    read_sha256: str
    reader: str
    cells: tuple[str, ...] = ()

    def describe(self) -> str:
        """Say in words what changed: the cells, where they are known."""
        what = "; ".join(self.cells) or "the cells that changed are not known"
        return f"sha256 {self.written_sha256} became {self.read_sha256}: {what}"


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
        if record.rule == "analyse"
        for path, digest in record.inputs.items()
        if path in written and written[path] != digest
    ]
