"""Copies of what a study made, where a person looks first: in the folder of all results."""

import os
import shutil
from pathlib import Path

from foldshell.files.whole import atomic_path, hash_file, read_json, write_json

NAMES = ("summary.csv", "summary.xlsx", "report.html")
RECORD = "studies/copies.json"
ASIDE = "replaced"


def copy_study(study: str | Path, top: str | Path) -> list[Path]:
    """Copy summary and report of a study into the folder `top`; return the copies.

    Links of the report are led from the study's folder to the copy's. What another study left there
    and this one does not have is removed; what a person changed is moved to replaced/ first.
    """
    study, top = Path(study), Path(top)
    known = _read_record(top / RECORD)
    made = []
    for name in NAMES:
        source, target = study / name, top / name
        content = _adapt(source, top) if source.is_file() else None
        if target.is_file() and (content is None or target.read_bytes() != content):
            _clear(target, known.get(name))
        if content is None:
            continue
        if not target.is_file():
            with atomic_path(target) as temporary:
                temporary.write_bytes(content)
        made.append(target)
    if made:
        write_json(top / RECORD, {path.name: hash_file(path) for path in made})
    return made


def _read_record(path: Path) -> dict[str, str]:
    try:
        return dict(read_json(path))
    except (OSError, ValueError, TypeError):
        return {}


def _adapt(source: Path, top: Path) -> bytes:
    """Return a file's bytes, with the links of a page led to where its copy stands."""
    content = source.read_bytes()
    if source.suffix != ".html":
        return content
    way = os.path.relpath(source.parent.parent.parent, top)
    return content.replace(b'"../../', b'"' + (f"{way}/" if way != "." else "").encode())


def _clear(target: Path, digest: str | None) -> None:
    """Remove an old copy; one that is not what was copied is moved aside."""
    found = hash_file(target)
    if found == digest:
        target.unlink()
        return
    aside = target.parent / ASIDE / f"{target.stem}-{found[:12]}{target.suffix}"
    aside.parent.mkdir(exist_ok=True)
    shutil.move(target, aside)
