"""Workbooks that a person has changed: noticed by their hash, and kept aside."""

import os
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.whole import DIGITS, atomic_path, hash_data, hash_file, read_json
from foldshell.records.files import read_record, write_record
from foldshell.records.written import WrittenRecord

WORKBOOK = "thickness.xlsx"
ANALYSIS = "analysis.json"
NEWER_NS = 1_000_000_000
RECORD = "written.json"
"""Beside each thickness.xlsx: what the workflow wrote."""


@contextmanager
def recorded_workbook(
    workbook: str | Path, record: str | Path, thickness: np.ndarray
) -> Iterator[Path]:
    """Yield a temporary name for a workbook with a thickness (P,) m; write down its hash and
    these, then rename it into place.

    The workbook comes last, since the next analysis waits for it.
    """
    with atomic_path(workbook) as temporary:
        yield temporary
        hashed, written = hash_file(temporary), tuple(thickness.tolist())
        write_record(record, WrittenRecord(sha256=hashed, thickness_m=written))


def read_written(workbook: str | Path) -> WrittenRecord | None:
    """Return what the workflow wrote into a workbook, None without a record that can be read."""
    try:
        return read_record(Path(workbook).parent / RECORD, WrittenRecord)
    except InputError:
        return None


def is_edited(workbook: str | Path) -> bool:
    """Tell whether a workbook differs from what the workflow wrote; False without a record, and
    for other files beside it."""
    workbook = Path(workbook)
    written = read_written(workbook) if workbook.name == WORKBOOK else None
    return written is not None and workbook.exists() and hash_file(workbook) != written.sha256


def find_edited_panels(workbook: str | Path, thickness: np.ndarray) -> tuple[int, ...] | None:
    """Return the panels whose thickness (P,) m a person has changed, None in a workbook that
    nobody has.

    A workbook that was only saved anew has none; without a record of what was written all count.
    """
    if not is_edited(workbook):
        return None
    before = read_written(workbook).thickness_m
    if before is None or len(before) != len(thickness):
        return tuple(range(len(thickness)))
    return tuple(np.flatnonzero(np.asarray(before) != thickness).tolist())


def hash_edit(decisions: str, workbook: str | Path, thickness: np.ndarray) -> str:
    """Return the hash of all that decides a design, once its thicknesses (P,) m were read.

    It stays what it was, unless a person has changed a thickness that the workflow wrote.
    """
    edited = find_edited_panels(workbook, thickness)
    return hash_data([decisions, thickness.tolist()])[:DIGITS] if edited else decisions


def describe_reading(workbook: str | Path, thickness: np.ndarray, decisions: str) -> dict[str, str]:
    """Return what an analysis says of the workbook of thicknesses (P,) m that it read."""
    return {
        "settings_hash": hash_edit(decisions, workbook, thickness),
        "workbook_sha256": hash_file(workbook),
    }


def keep_edited(workbook: str | Path) -> bool:
    """Copy an edited workbook to `edited-<hash>.xlsx` beside it; return whether it was edited.

    Snakemake deletes an output before its rule makes it anew; the copy outlives that.
    """
    workbook = Path(workbook)
    if not is_edited(workbook):
        return False
    copy = workbook.with_name(f"edited-{hash_file(workbook)[:12]}{workbook.suffix}")
    if not copy.exists():
        with atomic_path(copy) as temporary:
            shutil.copyfile(workbook, temporary)
    return True


def renew_if_unread(workbook: str | Path) -> bool:
    """Make a workbook newer than its analysis where that has read other bytes; return whether.

    Snakemake looks at the content of an input only where it is newer than the output. A workbook
    whose date was set back, or that was put back by a version control, is not.
    """
    workbook = Path(workbook)
    analysis = workbook.with_name(ANALYSIS)
    try:
        read = read_json(analysis)["workbook_sha256"]  # also in a file of another version
        if hash_file(workbook) == read:
            return False
        now = max(time.time_ns(), analysis.stat().st_mtime_ns + NEWER_NS)
        os.utime(workbook, ns=(now, now))
    except (OSError, ValueError, KeyError, TypeError):
        return False
    return True


def keep_all_edited(results: str | Path) -> list[Path]:
    """Keep every edited thickness workbook under a results folder; return their paths.

    Those that the analysis after them has not read are made newer than it.
    """
    found = sorted(Path(results).glob("**/sizing/[0-9][0-9]/thickness.xlsx"))
    for path in found:
        renew_if_unread(path)
    return [path for path in found if keep_edited(path)]
