"""Workbooks that a person has changed: noticed by their hash, and kept aside."""

import shutil
from pathlib import Path

from foldshell.files.whole import atomic_path, hash_file, read_json, write_json

WORKBOOK = "thickness.xlsx"
RECORD = "written.json"
"""Beside each thickness.xlsx: the hash of the bytes that the workflow wrote."""


def record_written(workbook: str | Path, record: str | Path) -> None:
    """Write down the hash of a workbook that was just made."""
    write_json(record, {"sha256": hash_file(workbook)})


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


def keep_all_edited(results: str | Path) -> list[Path]:
    """Keep every edited thickness workbook under a results folder; return their paths."""
    found = sorted(Path(results).glob("*/sizing/[0-9][0-9]/thickness.xlsx"))
    return [path for path in found if keep_edited(path)]
