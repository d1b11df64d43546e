"""What Snakemake does not notice: results deleted, cut off or changed after they were made.

Snakemake keeps a record of every output: the job's end and the SHA-256 of each input as the job
read it. So each file that a later job has read can be compared with what that job saw; files that
no job reads are opened, and their time is compared with the end of their job.
"""

import base64
import json
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from foldshell.files.edits import is_edited
from foldshell.files.whole import hash_file, read_arrays, read_json

CLOCK_SLACK = 2.0
"""Seconds by which a file may be younger than the end of its job."""


@dataclass(frozen=True)
class JobRecord:
    """An output (relative path), its rule, the end of its job (s) and {input: SHA-256 or None}."""

    path: str
    rule: str
    ended: float
    inputs: Mapping[str, str | None] = field(default_factory=dict)


@dataclass(frozen=True)
class Fault:
    """A file that is not what was made: kind is deleted, damaged, changed or edited."""

    path: str
    kind: str
    detail: str


def read_records(folder: str | Path) -> list[JobRecord]:
    """Read `.snakemake/metadata`, in order of paths; records that cannot be read are left out."""
    records = []
    for file in sorted(path for path in Path(folder).rglob("*") if path.is_file()):
        name = "".join(part.removeprefix("@") for part in file.relative_to(folder).parts)
        try:
            data = json.loads(file.read_text(encoding="utf-8"))
            path = base64.urlsafe_b64decode(name.encode()).decode()
            sums = data.get("input_checksums") or {}
            inputs = {item: _digest(sums.get(item)) for item in data.get("input") or ()}
            records.append(JobRecord(path, str(data["rule"]), float(data["endtime"]), inputs))
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            continue
    return sorted(records, key=lambda record: record.path)


def _digest(checksum: str | None) -> str | None:
    return checksum.removeprefix("sha256:") if checksum else None


def keep_current(records: Iterable[JobRecord], results: str) -> list[JobRecord]:
    """Leave out what is not under `results`, and iterations past the last of a design.

    A loop that ended sooner than in an earlier run leaves records of files that were removed.
    """
    records = [record for record in records if Path(record.path).is_relative_to(results)]
    used = {name for record in records if record.rule == "size" for name in record.inputs}
    counts: dict[Path, int] = {}
    for name in used:
        place = _iteration(name)
        if place:
            counts[place[0]] = max(place[1], counts.get(place[0], 0))
    return [record for record in records if not _is_superseded(record.path, counts)]


def _iteration(path: str) -> tuple[Path, int] | None:
    """Return the folder `sizing` and the number of the iteration that a file belongs to."""
    folder = Path(path).parent
    return (folder.parent, int(folder.name)) if folder.name.isdigit() else None


def _is_superseded(path: str, counts: Mapping[Path, int]) -> bool:
    place = _iteration(path)
    return place is not None and place[0] in counts and place[1] > counts[place[0]]


def find_faults(root: str | Path, records: Iterable[JobRecord]) -> list[Fault]:
    """Compare files under `root` with the records; an order of paths, one fault a file."""
    root, records = Path(root), list(records)
    readers: dict[str, dict[str, JobRecord]] = {}
    for record in records:
        for name, digest in record.inputs.items():
            if digest:
                readers.setdefault(name, {}).setdefault(digest, record)
    found = [_check(root, record, readers.get(record.path, {})) for record in records]
    return [fault for fault in found if fault]


def _check(root: Path, record: JobRecord, readers: Mapping[str, JobRecord]) -> Fault | None:
    path = root / record.path
    if not path.exists():
        return Fault(record.path, "deleted", f"made by rule {record.rule}")
    if path.name == "thickness.xlsx" and is_edited(path):
        return Fault(record.path, "edited", "the next run redoes what follows it")
    if path.is_dir():
        return None
    problem = find_damage(path)
    if problem:
        return Fault(record.path, "damaged", problem)
    if readers:
        digest = hash_file(path)
        other = [reader.rule for known, reader in readers.items() if known != digest]
        return Fault(record.path, "changed", f"since rule {other[0]} read it") if other else None
    late = path.stat().st_mtime - record.ended
    if late > CLOCK_SLACK:
        return Fault(record.path, "changed", f"{late:.0f} s after its rule {record.rule} ended")
    return None


def find_damage(path: Path) -> str | None:
    """Say what shows that a file is cut off or not of its kind; None where nothing does."""
    if path.stat().st_size == 0:
        return "empty"
    try:
        if path.suffix in (".json", ".fold"):
            read_json(path)
        elif path.suffix == ".npz":
            read_arrays(path)
        elif path.suffix in (".xlsx", ".zip"):
            with zipfile.ZipFile(path) as archive:
                broken = archive.testzip()
            return f"{broken} in it is damaged" if broken else None
        else:
            return _find_cut(path)
    except (OSError, ValueError, EOFError, zipfile.BadZipFile):
        return f"cannot be read as {path.suffix}"
    return None


def _find_cut(path: Path) -> str | None:
    """Look for the end that every whole file of a kind has."""
    ends = {".png": b"IEND\xaeB`\x82", ".vtu": b"</VTKFile>", ".svg": b"</svg>"}
    if path.suffix not in ends:
        return None
    with open(path, "rb") as stream:
        stream.seek(max(0, path.stat().st_size - 64))
        return None if ends[path.suffix] in stream.read() else "its end is missing"


def find_dependents(faults: Iterable[Fault], records: Iterable[JobRecord]) -> list[str]:
    """Return the faulty files, but edited workbooks, and all that was made from them, in order.

    Once these are gone Snakemake makes them anew, and nothing else.
    """
    made_from: dict[str, set[str]] = {}
    for record in records:
        for name in record.inputs:
            made_from.setdefault(name, set()).add(record.path)
    waiting = [fault.path for fault in faults if fault.kind != "edited"]
    found: set[str] = set()
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting.extend(made_from.get(path, ()))
    return sorted(found)
