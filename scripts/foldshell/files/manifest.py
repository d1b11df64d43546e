"""The manifest of a design or study: every file with hash and size, who made it, and from what.

It is put together from the records of the jobs, never from the files, so that a file that was
damaged after its job is not taken for what the job made.
"""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.job_record import FOLDER, FileState, JobRecord, state_of
from foldshell.files.whole import Json, hash_data, read_json, write_json

FORMAT = "foldshell-manifest 1"
NAME = "manifest.json"


@dataclass(frozen=True)
class Manifest:
    """What a folder of results holds.

    `files` by relative path; `job_of` the job that made each; `inputs` the files that each job
    read, of this folder; `members` the SHA-256 of the manifests of a study's designs, by path
    relative to the study's folder; `result_sha256` of all that decides the result; `made_by`
    versions of the program and its packages, and the commit.
    """

    title: str
    result_sha256: str
    made_by: Mapping[str, str]
    files: Mapping[str, FileState]
    job_of: Mapping[str, str]
    inputs: Mapping[str, list[str]]
    members: Mapping[str, str]


def make_manifest(
    title: str,
    home: str | Path,
    records: Iterable[JobRecord],
    result_sha256: str,
    made_by: Mapping[str, str],
    members: Mapping[str, str] | None = None,
) -> Manifest:
    """Put the manifest of the folder `home` together from the records of its jobs."""
    records = sorted(records, key=lambda record: record.name)
    files, job_of = {}, {}
    for record in records:
        own = f"{FOLDER}/{record.name}.json"
        states = {**record.outputs, own: state_of(Path(home, own))}
        files |= states
        job_of |= dict.fromkeys(states, record.name)
    return Manifest(
        title,
        result_sha256,
        dict(made_by),
        dict(sorted(files.items())),
        dict(sorted(job_of.items())),
        {record.name: sorted(record.inputs) for record in records},
        dict(sorted((members or {}).items())),
    )


def write_manifest(path: str | Path, manifest: Manifest) -> None:
    """Write a manifest with the hash of its own content, by which an edit of it shows."""
    content = {"format": FORMAT, **asdict(manifest)}
    write_json(path, {**content, "content_sha256": hash_data(content)})


def read_manifest(path: str | Path) -> Manifest:
    """Read a manifest.

    Raises
    ------
    InputError
        for a file that is none, one of another version, or one whose content was changed.
    """
    try:
        content: Json = read_json(path)
        kind, digest = content["format"], content.pop("content_sha256")
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        raise InputError(f"{path}: damaged: it cannot be read as a manifest") from None
    if kind != FORMAT:
        raise InputError(f"{path}: made by another version: format {kind!r}, {FORMAT!r} is known")
    if hash_data(content) != digest:
        raise InputError(f"{path}: damaged: its content was changed after it was written")
    del content["format"]
    content["files"] = {name: FileState(**state) for name, state in content["files"].items()}
    return Manifest(**content)
