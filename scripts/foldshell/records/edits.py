"""Workbooks that a person has changed: noticed by their hash, and kept aside."""

import os
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

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


class Limits(Protocol):
    """What is asked of panels: arrays (P,) by name."""

    @property
    def given(self) -> bool:
        """Whether anything is asked for."""


@contextmanager
def recorded_workbook(
    workbook: str | Path, record: str | Path, thickness: np.ndarray, limits: Limits | None = None
) -> Iterator[Path]:
    """Yield a temporary name for a workbook with a thickness (P,) m and what is asked of panels;
    write down its hash and these, then rename it into place.

    The workbook comes last, since the next analysis waits for it.
    """
    with atomic_path(workbook) as temporary:
        yield temporary
        hashed, written = hash_file(temporary), tuple(thickness.tolist())
        asked = _list_limits(limits)
        write_record(record, WrittenRecord(sha256=hashed, thickness_m=written, limits=asked))


def _list_limits(limits: Limits | None) -> dict[str, tuple[float | None, ...]] | None:
    """Return the columns by name, None for empty cells; None where nothing is asked of panels."""
    if limits is None or not limits.given:
        return None
    columns = {name: np.asarray(values, float) for name, values in vars(limits).items()}
    return {
        name: tuple(None if np.isnan(one) else one for one in values.tolist())
        for name, values in columns.items()
    }


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


def find_edited_panels(
    workbook: str | Path, thickness: np.ndarray, limits: Limits | None = None
) -> tuple[int, ...] | None:
    """Return the panels whose thickness (P,) m, or of which something else is asked, a person has
    changed; None in a workbook that nobody has.

    A workbook that was only saved anew has none; without a record of what was written all count.
    """
    if not is_edited(workbook):
        return None
    written = read_written(workbook)
    before = written.thickness_m
    if before is None or len(before) != len(thickness):
        return tuple(range(len(thickness)))
    changed = np.asarray(before) != thickness
    asked, was = _list_limits(limits) or {}, written.limits or {}
    nothing = {"fixed": 0.0, "group": 0.0}
    for name in {**asked, **was}:
        empty = (nothing.get(name),) * len(thickness)
        pairs = zip(asked.get(name, empty), was.get(name, empty), strict=True)
        changed |= np.array([now != old for now, old in pairs])
    return tuple(np.flatnonzero(changed).tolist())


def hash_edit(
    decisions: str, workbook: str | Path, thickness: np.ndarray, limits: Limits | None = None
) -> str:
    """Return the hash of all that decides a design, once its thicknesses (P,) m were read.

    It stays what it was, unless a person has changed what the workflow wrote.
    """
    if not find_edited_panels(workbook, thickness, limits):
        return decisions
    asked = _list_limits(limits)
    more = [] if asked is None else [{name: list(values) for name, values in asked.items()}]
    return hash_data([decisions, thickness.tolist(), *more])[:DIGITS]


def describe_reading(
    workbook: str | Path, thickness: np.ndarray, decisions: str, limits: Limits | None = None
) -> dict[str, str]:
    """Return what an analysis says of the workbook of thicknesses (P,) m that it read."""
    return {
        "settings_hash": hash_edit(decisions, workbook, thickness, limits),
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
