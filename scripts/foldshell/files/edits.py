"""Workbooks that a person has changed: noticed by their hash, and kept aside."""

import os
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path, hash_data, hash_file, read_json, write_json

WORKBOOK = "thickness.xlsx"
ANALYSIS = "analysis.json"
NEWER_NS = 1_000_000_000
RECORD = "written.json"
"""Beside each thickness.xlsx: the hash of the bytes that the workflow wrote, and of the values."""

DIGITS = 12
"""Hexadecimal digits of the hash of all that decides a design, as tables and workbooks show it."""


@contextmanager
def recorded_workbook(
    workbook: str | Path, record: str | Path, values: np.ndarray
) -> Iterator[Path]:
    """Yield a temporary name for a workbook of thicknesses (P,) m; write down the hashes of its
    bytes and of these `values`, then rename it into place.

    The workbook comes last, since the next analysis waits for it.
    """
    with atomic_path(workbook) as temporary:
        yield temporary
        hashes = {"sha256": hash_file(temporary), "values_sha256": hash_data(values.tolist())}
        write_json(record, hashes)


def is_edited(workbook: str | Path) -> bool:
    """Tell whether a workbook differs from what the workflow wrote; False without a record, and
    for other files beside it."""
    workbook = Path(workbook)
    if workbook.name != WORKBOOK:
        return False
    try:
        recorded = read_json(workbook.parent / RECORD)["sha256"]
    except (OSError, ValueError, KeyError, TypeError):
        return False
    return workbook.exists() and hash_file(workbook) != recorded


def hash_edit(decisions: str, workbook: str | Path, values: np.ndarray) -> str:
    """Return the hash of all that decides a design, once its thicknesses (P,) m were read.

    It stays what it was, unless a person has changed the values that the workflow wrote.
    """
    read = hash_data(values.tolist())
    try:
        written = read_json(Path(workbook).parent / RECORD)["values_sha256"]
    except (OSError, ValueError, KeyError, TypeError):
        written = read
    return decisions if read == written else hash_data([decisions, read])[:DIGITS]


def describe_reading(
    workbook: str | Path, values: np.ndarray, decisions: str
) -> dict[str, str | bool]:
    """Return what an analysis says of the workbook of thicknesses (P,) m that it read."""
    return {
        "edited": is_edited(workbook),
        "settings_hash": hash_edit(decisions, workbook, values),
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
        read = read_json(analysis)["workbook_sha256"]
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
