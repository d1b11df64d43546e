"""Which files an archive holds, and where they stand in it."""

import contextlib
import getpass
import socket
import subprocess
import tarfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.files.job_record import FOLDER, read_records
from foldshell.files.whole import hash_file

FIELDS = (".vtu", ".npz")
"""Endings of the large files of fields, which an archive may leave out."""
NEEDED_FIELDS = ("folded.npz", "mesh.npz", "iterations.npz", "classes.npz")
"""Fields that stay in any case: shape, mesh, and the thicknesses of all iterations of a design."""
CODE, RESULTS, CONFIG, GIVEN = "code", "results", "config", "given"
RULE = "archive_study"
"""The rule that makes an archive: its record of an earlier one stays outside, as that one does."""
LEFT_OUT = "left-out.txt"
"""Lists the results that an archive without fields leaves out."""


@dataclass(frozen=True)
class Study:
    """What is archived: tag, designs, results folder, folder of the study in it, project folder;
    `settings` are the files of settings that designs name."""

    tag: str
    designs: tuple[str, ...]
    results: Path
    home: Path
    project: Path
    settings: tuple[str, ...] = ()


def list_results(study: Study, fields: bool) -> Iterator[tuple[Path, str]]:
    """Yield (path, place in the archive) of the results of a study, in order of places.

    Times, logs and records of jobs are among them; older archives and half-written files are not.
    """
    folders = [study.results / name for name in study.designs] + [study.home]
    own = [study.results / "schemas", study.results / "benchmarks", study.results / "logs"]
    found: dict[str, Path] = {}
    for folder in [*folders, *own]:
        for path in folder.rglob("*") if folder.is_dir() else ():
            if path.is_file() and _wanted(path, study, fields):
                found[f"{RESULTS}/{path.relative_to(study.results).as_posix()}"] = path
    yield from ((found[place], place) for place in sorted(found))


def list_given(study: Study, tables: Iterable[Path]) -> list[str]:
    """Return the files from outside of the results that the jobs of the designs read, but for the
    tables: target surfaces, crease patterns, settings; as paths relative to the project.

    Raises
    ------
    InputError
        for one that is outside of the project, or was changed since a job read it.
    """
    known = {path.name for path in tables}
    found = {path: hash_file(study.project / path) for path in study.settings}
    for design in study.designs:
        for record in read_records(study.results / design):
            found |= record.external
    for path, digest in found.items():
        source = study.project / path
        if Path(path).name in known:
            continue
        if not source.is_file():
            raise InputError(
                f"{path}: is not in {study.project.name}: an archive holds files of the project: "
                "copy it there, name it by its place in it, and run the study again"
            )
        if hash_file(source) != digest:
            raise InputError(f"{path}: has changed since it was read: run the study again first")
    return sorted(path for path in found if Path(path).name not in known)


def _wanted(path: Path, study: Study, fields: bool) -> bool:
    own = study.home / "archive", study.home / FOLDER / f"{RULE}.json"
    if path.name.startswith(".") or any(path.is_relative_to(place) for place in own):
        return False
    named = {"benchmarks", "logs"} & set(path.parts)
    if named and not any(design in path.as_posix() for design in study.designs):
        return False
    return fields or path.suffix not in FIELDS or path.name in NEEDED_FIELDS


def export_code(project: Path, folder: Path, dirty: str) -> tuple[str, str]:
    """Write the source of the checked-out commit into a folder; return commit and difference.

    Raises
    ------
    InputError
        where files differ from the commit and `dirty` is "refuse", or there is no repository.
    """
    commit = _git(project, "rev-parse", "HEAD").strip()
    difference = _git(project, "diff", "HEAD", "--no-ext-diff")
    if difference and dirty == "refuse":
        names = _git(project, "diff", "HEAD", "--name-only").split()
        raise InputError(
            f"{project}: {names[0]} and {len(names) - 1} more files differ from commit "
            f"{commit[:12]}: commit them, or set archive.dirty: diff to archive the difference too"
            if len(names) > 1
            else f"{project}: {names[0]} differs from commit {commit[:12]}: commit it, or set "
            "archive.dirty: diff to archive the difference too"
        )
    data = _git_bytes(project, "archive", "--format=tar", "HEAD")
    with tarfile.open(fileobj=BytesIO(data)) as tar:
        tar.extractall(folder, filter="data")
    return commit, difference


def _git(project: Path, *words: str) -> str:
    return _git_bytes(project, *words).decode("utf-8", "replace")


def _git_bytes(project: Path, *words: str) -> bytes:
    try:
        done = subprocess.run(["git", "-C", str(project), *words], capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        raise InputError(
            f"{project}: no git repository: the archive holds the source of a commit"
        ) from None
    return done.stdout


def private_words(project: Path) -> tuple[str, ...]:
    """Return what must not stand in an archive: names of the machine, the user and folders."""
    found = {str(project), str(Path.home()), socket.gethostname()}
    with contextlib.suppress(OSError, KeyError):
        found.add(getpass.getuser())
    return tuple(sorted(word for word in found if len(word) > 4))


def clean_text(text: str, words: Sequence[str]) -> str:
    """Return a log with paths relative to the project and without private words."""
    for word in sorted(words, key=len, reverse=True):
        text = text.replace(f"{word}/", "").replace(word, "-")
    return text


def find_private(paths: Iterable[Path], words: Sequence[str]) -> list[str]:
    """Return `file: word` of every private word that stands in one of the files."""
    found = []
    for path in paths:
        data = path.read_bytes()
        found += [f"{path}: {word}" for word in words if word.encode() in data]
    return found
