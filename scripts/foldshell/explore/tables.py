"""Tables of an exploration: candidates of a round, all that were tried, the best of them."""

import csv
import io
from collections.abc import Sequence
from pathlib import Path

from foldshell.explore.fronts import find_front, rank_by
from foldshell.explore.measures import count_broken
from foldshell.files.errors import InputError
from foldshell.files.whole import write_text_if_changed
from foldshell.records.candidate import CandidateRecord, list_measures
from foldshell.settings.design import COLUMNS, DesignColumns
from foldshell.settings.exploration import Exploration
from foldshell.settings.field import Plain, list_settings

ENDS = ("state", "feasible", "broken", "reason")
JUDGED = ("engineering", "engineering_reason")


def write_candidates(path: str | Path, rows: Sequence[Plain]) -> None:
    """Write the designs of a round as a table of designs; its bytes depend on the rows alone."""
    columns = [column for column in COLUMNS if column != "tags"]
    lines = ["\t".join(columns)]
    lines += ["\t".join(_write(row.get(column, "")) for column in columns) for row in rows]
    write_text_if_changed(path, "\n".join(lines) + "\n")


def read_candidate(path: str | Path, name: str) -> Plain:
    """Return the row of a candidate with its values typed; raises `InputError` without one."""
    kinds = {known.key: known.kind for known in list_settings(DesignColumns).values()}
    for row in csv.DictReader(io.StringIO(Path(path).read_text(encoding="utf-8")), delimiter="\t"):
        if row["design"] == name:
            return {key: kinds[key](value) if key in kinds else value for key, value in row.items()}
    raise InputError(f"{path}: design {name!r}: there is no such row")


def _write(value: object) -> str:
    if value is None:
        return ""
    return ", ".join(value) if isinstance(value, tuple) else f"{value}"


def tabulate(exploration: Exploration, records: Sequence[CandidateRecord]) -> list[list[object]]:
    """Return a header and a row a candidate: name, variables, measures, ends."""
    variables = exploration.columns
    ends = (*ENDS, *JUDGED) if exploration.needs_engineering else ENDS
    names = (*list_measures(exploration.needs_engineering), *ends)
    header: list[object] = ["candidate", *variables, *names]
    rows = [
        [
            record.candidate,
            *(record.value_of(name) for name in variables),
            *(getattr(record, name) for name in names),
        ]
        for record in sorted(records, key=lambda record: record.candidate)
    ]
    return [header, *rows]


def write_explored(
    path: str | Path, exploration: Exploration, records: Sequence[CandidateRecord]
) -> None:
    """Write explore.tsv: one row a candidate, in order of rounds."""
    lines = ["\t".join(_write(cell) for cell in row) for row in tabulate(exploration, records)]
    write_text_if_changed(path, "\n".join(lines) + "\n")


def write_design_explorer(
    path: str | Path, exploration: Exploration, records: Sequence[CandidateRecord]
) -> None:
    """Write the candidates that have a volume as Design Explorer reads them: `in:` and `out:`."""
    variables = exploration.columns
    numbers = [
        name for name in list_measures(exploration.needs_engineering) if name != "mesh_subdivisions"
    ]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*(f"in:{name}" for name in variables), *(f"out:{name}" for name in numbers)])
    for record in sorted(records, key=lambda record: record.candidate):
        if record.volume_m3 is not None:
            cells = [record.value_of(name) for name in variables]
            writer.writerow([*cells, *(getattr(record, name) for name in numbers)])
    write_text_if_changed(path, text.getvalue())


def name_selected(exploration: Exploration, record: CandidateRecord) -> str:
    """Return the name of a chosen candidate as a design."""
    return f"{exploration.name[:50]}-{record.candidate}"


def write_selected(
    path: str | Path, exploration: Exploration, best: Sequence[CandidateRecord]
) -> None:
    """Write the best candidates as a table of designs that any study takes."""
    lines = ["\t".join(COLUMNS)]
    for record in best:
        row = {**record.columns, "design": name_selected(exploration, record), "tags": "found"}
        lines.append("\t".join(_write(row.get(column, "")) for column in COLUMNS))
    write_text_if_changed(path, "\n".join(lines) + "\n")


def describe_candidate(record: CandidateRecord) -> str:
    """Say in a line what became of a candidate."""
    if record.volume_m3 is None:
        return f"candidate {record.candidate}: {record.state}, {record.reason}"
    limits = f", breaks {', '.join(record.broken)}" if record.broken else ""
    return (
        f"candidate {record.candidate}: {record.volume_m3:.1f} m3, factor "
        f"{record.buckling_factor_min or float('inf'):.1f}, {record.state}{limits}"
    )


def describe_search(exploration: Exploration, records: Sequence[CandidateRecord]) -> str:
    """Say in a sentence what was found, or which limit excluded most."""
    kept = [record for record in records if record.feasible]
    if not kept:
        most = list(count_broken(records).items())[:1]
        name, count = most[0] if most else ("nothing", 0)
        return (
            f"{exploration.name}: no candidate keeps all limits: {name} excluded most, "
            f"{count} of {len(records)}"
        )
    best = rank_by(kept, exploration.aims[0])[0]
    front = len(find_front(kept, exploration.aims)) if len(exploration.aims) == 2 else 0
    more = f", {front} on the front" if front else ""
    aim = exploration.aims[0]
    return (
        f"{exploration.name}: {len(kept)} of {len(records)} candidates keep all limits; best "
        f"{aim} {getattr(best, aim):.4g} ({best.candidate}){more}"
    )


def join_tables(path: str | Path, tables: Sequence[str | Path], names: Sequence[str]) -> None:
    """Write the rows of some designs of several tables of designs as one table."""
    rows = {}
    for table in tables:
        with Path(table).open(encoding="utf-8", newline="") as stream:
            rows |= {row["design"]: row for row in csv.DictReader(stream, delimiter="\t")}
    lines = ["\t".join(COLUMNS)]
    lines += ["\t".join(rows[name].get(column) or "" for column in COLUMNS)
              for name in names if name in rows]  # fmt: skip
    write_text_if_changed(path, "\n".join(lines) + "\n")
