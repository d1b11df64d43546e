"""What a job read and made, by content: one small file per job, beside the results.

A record names its outputs with SHA-256 and size, its inputs with the hash they had when the job
began, and hashes of its parameters and of the library files it imports. It holds no time and no
name of a machine, so that the same job leaves the same bytes.
"""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.whole import hash_data, hash_file, read_json, write_json

FORMAT = "foldshell-job 1"
FOLDER = "jobs"
"""In the folder of a design or of a study: where its records stand."""


@dataclass(frozen=True)
class FileState:
    """A file by its content: SHA-256 in hexadecimal, size in bytes."""

    sha256: str
    bytes: int


@dataclass(frozen=True)
class JobRecord:
    """One job: rule and wildcards, files by path, hashes of parameters and code.

    Paths of outputs are relative to the folder of the design or study, those of inputs too where
    they lie in it; `external` are inputs from elsewhere (tables, surface files), by path as given.
    """

    name: str
    rule: str
    wildcards: Mapping[str, str]
    outputs: Mapping[str, FileState]
    inputs: Mapping[str, str]
    external: Mapping[str, str]
    params_sha256: str
    code_sha256: str


def state_of(path: str | Path) -> FileState:
    """Return hash and size of a file."""
    return FileState(hash_file(path), Path(path).stat().st_size)


def hash_inputs(paths: Iterable[str | Path]) -> dict[str, str]:
    """Return {path: SHA-256} of the inputs that are files."""
    return {str(path): hash_file(path) for path in paths if Path(path).is_file()}


def list_outputs(paths: Iterable[str | Path]) -> list[Path]:
    """Return the files of a job, those in an output folder one by one."""
    found: list[Path] = []
    for path in map(Path, paths):
        inside = sorted(item for item in path.rglob("*") if item.is_file()) if path.is_dir() else []
        found += inside or [path]
    return found


def write_record(home: str | Path, record: JobRecord) -> Path:
    """Write `jobs/<name>.json` in the folder of a design or study; return its path."""
    path = Path(home, FOLDER, f"{record.name}.json")
    write_json(path, {"format": FORMAT, **asdict(record)})
    return path


def read_record(path: str | Path) -> JobRecord:
    """Read the record of a job.

    Raises
    ------
    InputError
        for a file that is none, or one of another version.
    """
    try:
        data = read_json(path)
        kind = data.pop("format")
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        raise InputError(f"{path}: is not the record of a job") from None
    if kind != FORMAT:
        raise InputError(f"{path}: format: {kind!r}: {FORMAT!r} is allowed, of this version")
    try:
        data["outputs"] = {name: FileState(**state) for name, state in data["outputs"].items()}
        return JobRecord(**data)
    except (KeyError, AttributeError, TypeError):
        raise InputError(f"{path}: is not the record of a job") from None


def read_records(home: str | Path) -> list[JobRecord]:
    """Read all records in the folder of a design or study, by name; raises `InputError`."""
    return [read_record(path) for path in sorted(Path(home, FOLDER).glob("*.json"))]


def hash_result(records: Iterable[JobRecord], rules: Iterable[str]) -> str:
    """Return the SHA-256 of all that decides a result: parameters, code, and files from outside of
    the jobs of the named rules, and workbooks that a person changed between two of them.

    The last come in by the hash that an analysis read, where it is not the one that was written.
    """
    deciding = [record for record in records if record.rule in set(rules)]
    written = {path: state.sha256 for record in deciding for path, state in record.outputs.items()}
    parts = []
    for record in sorted(deciding, key=lambda record: record.name):
        edited = {
            path: digest
            for path, digest in record.inputs.items()
            if path in written and written[path] != digest
        }
        parts.append(
            [record.name, record.params_sha256, record.code_sha256, dict(record.external), edited]
        )
    return hash_data(parts)
