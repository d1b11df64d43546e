"""Remove what is damaged, with all that its jobs made and what was made from that."""

import shutil
from collections.abc import Iterable
from pathlib import Path

from foldshell.engine.integrity import Fault, Home, find_dependents, find_homes, read_home
from foldshell.files.job_record import FOLDER
from foldshell.files.manifest import NAME
from foldshell.files.whole import hash_file
from foldshell.records.edits import keep_edited

KEPT = "replaced"
"""In the folder of a design or study: copies of files that a repair took away."""


def repair(results: str | Path, faults: Iterable[Fault]) -> list[Path]:
    """Remove the files of all jobs concerned, so that the next run makes them anew; return them.

    A workbook that a person edited stays. Whatever else is not as it was made is kept under
    `replaced/` first: it may be somebody's work.
    """
    faults = [fault for fault in faults if fault.kind != "edited by hand"]
    removed: list[Path] = []
    for folder in find_homes(results):
        inside = [fault for fault in faults if fault.path.is_relative_to(folder)]
        if inside:
            removed += _repair_home(read_home(folder), inside)
    return removed


def _repair_home(home: Home, faults: list[Fault]) -> list[Path]:
    for fault in faults:
        _set_aside(home.folder, fault.path)
    names = [fault.path.relative_to(home.folder).as_posix() for fault in faults]
    removed = [fault.path for fault in faults]
    for job in find_dependents(home, names):
        for name in [name for name, maker in home.job_of.items() if maker == job]:
            path = home.folder / name
            keep_edited(path)
            if path.is_file() and not path.is_symlink():
                path.unlink()
                removed.append(path)
        (home.folder / FOLDER / f"{job}.json").unlink(missing_ok=True)
    (home.folder / NAME).unlink(missing_ok=True)
    return removed


def _set_aside(home: Path, path: Path) -> None:
    """Move a faulty file, link or folder to `replaced/`, under a name that tells its content."""
    if not path.exists() and not path.is_symlink():
        return
    plain = path.is_file() and not path.is_symlink()
    mark = hash_file(path)[:12] if plain else "link" if path.is_symlink() else "folder"
    target = home / KEPT / f"{path.relative_to(home).as_posix().replace('/', '-')}-{mark}"
    target.parent.mkdir(parents=True, exist_ok=True)
    if target.is_dir() and not target.is_symlink():
        shutil.rmtree(target)
    shutil.move(path, target)
