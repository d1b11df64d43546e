"""Are results still what was made? By content alone: manifests and job records against files.

Nothing but the folder of results is needed: neither the records of Snakemake, nor times of files,
nor the machine on which they were made.
"""

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from foldshell.engine.workbook_state import judge_workbook
from foldshell.files.errors import InputError
from foldshell.files.job_record import FOLDER, FileState, JobRecord, read_record
from foldshell.files.manifest import NAME, Manifest, read_manifest
from foldshell.files.whole import hash_file
from foldshell.records.edits import WORKBOOK

KINDS = ("missing", "damaged", "edited by hand", "made by another version", "left over")


@dataclass(frozen=True)
class Fault:
    """A file that is not what was made: `kind` is one of `KINDS`; `job` made it, if known.

    `used` marks an edit that the analysis after it has read: nothing is to be done.
    """

    path: Path
    kind: str
    detail: str
    job: str | None = None
    used: bool = False


@dataclass(frozen=True)
class Home:
    """The folder of a design or study, and what is known of it."""

    folder: Path
    manifest: Manifest | None
    records: Mapping[str, JobRecord]
    faults: tuple[Fault, ...] = ()
    files: Mapping[str, FileState] = field(default_factory=dict)
    job_of: Mapping[str, str] = field(default_factory=dict)
    inputs: Mapping[str, list[str]] = field(default_factory=dict)


def find_homes(results: str | Path) -> list[Path]:
    """Return the folders below `results` that hold a manifest or records of jobs, sorted."""
    found = []
    for folder, names, files in os.walk(results):
        names.sort()
        if FOLDER in names or NAME in files:
            found.append(Path(folder))
    return found


def read_home(folder: str | Path) -> Home:
    """Read manifest and records of a folder; what cannot be read is a fault.

    A job that is newer than the manifest counts by its record.
    """
    folder = Path(folder)
    faults: list[Fault] = []
    manifest = _read_or_note(read_manifest, folder / NAME, faults)
    records: dict[str, JobRecord] = {}
    for path in sorted((folder / FOLDER).glob("*.json")):
        record = _read_or_note(read_record, path, faults)
        if record is not None:
            records[record.name] = record
    listed = manifest.files if manifest else {}
    files, job_of = dict(listed), dict(manifest.job_of if manifest else {})
    inputs = dict(manifest.inputs if manifest else {})
    for record in records.values():
        if manifest and f"{FOLDER}/{record.name}.json" in listed:
            continue
        files |= record.outputs
        job_of |= dict.fromkeys(record.outputs, record.name)
        inputs[record.name] = list(record.inputs)
    return Home(folder, manifest, records, tuple(faults), files, job_of, inputs)


def _read_or_note(reader, path: Path, faults: list[Fault]):
    if not os.path.lexists(path):
        return None
    try:
        return reader(path)
    except InputError as error:
        words = str(error).removeprefix(f"{path}: ")
        other = "version" in words
        faults.append(Fault(path, KINDS[3] if other else "damaged", words))
        return None


def find_faults(results: str | Path) -> list[Fault]:
    """Compare all files below a folder of results with what was made, in order of paths."""
    homes = [read_home(folder) for folder in find_homes(results)]
    faults = [fault for home in homes for fault in check_home(home)]
    return sorted(faults, key=lambda fault: str(fault.path))


def check_home(home: Home) -> Iterator[Fault]:
    """Yield the faults of one folder."""
    yield from home.faults
    known = {fault.path for fault in home.faults}
    for name, state in home.files.items():
        path = home.folder / name
        fault = None if path in known else check_file(path, state, home.job_of.get(name))
        if fault and path.name == WORKBOOK and fault.kind == "damaged":
            fault = judge_workbook(home, name, fault)
        if fault:
            yield fault
    yield from _find_left_over(home)
    yield from _check_members(home)


def check_file(path: Path, state: FileState, job: str | None) -> Fault | None:
    """Return what is wrong with a file by its content, None where nothing is."""
    if not os.path.lexists(path):
        return Fault(path, "missing", f"made by job {job}", job)
    if path.is_symlink():
        return Fault(path, "damaged", "a link stands in its place", job)
    if not path.is_file():
        return Fault(path, "damaged", "something that is no file stands in its place", job)
    try:
        size, digest = path.stat().st_size, hash_file(path)
    except OSError as error:
        return Fault(path, "damaged", f"cannot be read: {error.strerror}", job)
    if digest == state.sha256:
        return None
    if size == 0:
        return Fault(path, "damaged", "empty", job)
    if size < state.bytes:
        return Fault(path, "damaged", f"{size} of {state.bytes} bytes", job)
    return Fault(path, "damaged", "its content is not what was made", job)


def _find_left_over(home: Home) -> Iterator[Fault]:
    """Yield iterations that belong to no loop of the manifest."""
    if home.manifest is None:
        return
    listed = {Path(name).parts[1] for name in home.files if name.startswith("sizing/")}
    for folder in sorted((home.folder / "sizing").glob("[0-9][0-9]")):
        if folder.name not in listed:
            yield Fault(folder, "left over", "an iteration that the design does not have")


def _check_members(home: Home) -> Iterator[Fault]:
    """Yield the designs of a study whose manifest is gone, or not the one that was gathered."""
    for name, digest in (home.manifest.members if home.manifest else {}).items():
        path = Path(os.path.normpath(home.folder / name))
        if not path.is_file():
            yield Fault(path, "missing", f"the manifest of a design of study {home.manifest.title}")
        elif hash_file(path) != digest:
            yield Fault(path, "damaged", f"not the one that study {home.manifest.title} gathered")


def find_dependents(home: Home, names: Iterable[str]) -> list[str]:
    """Return the jobs that made these files, and all jobs that read what those made, in order."""
    made: dict[str, set[str]] = {}
    for name, job in home.job_of.items():
        made.setdefault(job, set()).add(name)
    waiting = [home.job_of[name] for name in names if name in home.job_of]
    found: set[str] = set()
    while waiting:
        job = waiting.pop()
        if job not in found:
            found.add(job)
            waiting += [
                other
                for other, read in home.inputs.items()
                if not made.get(job, set()).isdisjoint(read)
            ]
    return sorted(found)
