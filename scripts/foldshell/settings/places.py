"""Where results go, and the names that designs and tables may not have."""

import re
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.study import AUTO, Settings

TOP = "results"
STUDIES = "studies"
_STUDY = {"archive", "bench", "benchmarks", "explorations", "exports", "figures", "jobs"}
_STUDY |= {"kinematics", "logs", "replaced", "report", "schemas", "sensitivity", STUDIES, "tags"}
_DEVICES = {f"{device}{number}" for device in ("com", "lpt") for number in range(1, 10)}
RESERVED = _STUDY | _DEVICES | {"con", "prn", "aux", "nul"}
"""Folders and files under results/ that are no designs, and devices that Windows cannot create."""

_FOLDER = re.compile(r"[A-Za-z0-9_][A-Za-z0-9._-]*(/[A-Za-z0-9_][A-Za-z0-9._-]*)*")
_TAG = re.compile(r"[a-z0-9][a-z0-9_]{0,31}")
_RECORD = "table.txt"
"""Below studies/: the table whose designs are in a folder of results."""


def choose_results(settings: Settings) -> str:
    """Return the folder of the results of a table: `results`, for a table other than designs.tsv
    `results/<its name>`, or what the setting `results` says.

    Raises `InputError` for a name that is reserved or that Snakemake would read as a pattern, and
    for a study that can be no tag.
    """
    if not _TAG.fullmatch(settings.study):
        raise InputError(
            f"study: {settings.study!r}: a tag of lower-case letters, digits and _ is allowed"
        )
    if settings.results != AUTO:
        if not _FOLDER.fullmatch(settings.results):
            raise InputError(
                f"results: {settings.results!r}: a folder below this one is allowed, its name of "
                "letters, digits, '.', '_' and '-'"
            )
        return settings.results
    name = Path(settings.designs).stem
    if name == "designs":
        return TOP
    if name.lower() in RESERVED or "/" in name or not _FOLDER.fullmatch(name):
        reason = "is reserved" if name.lower() in RESERVED else "cannot name a folder of results"
        raise InputError(
            f"{settings.designs}: the name {name!r} {reason}: give the table another one, or say "
            "where results go by --config results=FOLDER"
        )
    return f"{TOP}/{name}"


def check_results(results: str | Path, table: str | Path) -> None:
    """Raise `InputError` where a folder holds the results of another table, or is a design's.

    Which table it belongs to is written down in studies/table.txt by `claim_results`.
    """
    folder = Path(results)
    if (folder / "sizing").is_dir() or (folder / "manifest.json").is_file():
        raise InputError(
            f"{folder}: is the folder of a design: give the table {table} another name, or say "
            "where results go by --config results=FOLDER"
        )
    record = folder / STUDIES / _RECORD
    other = record.read_text(encoding="utf-8").strip() if record.is_file() else str(table)
    if other != str(table) and Path(other).is_file():
        raise InputError(
            f"{folder}: holds results of the table {other}, this one is {table}: say where results "
            f"go by --config results=FOLDER, or delete {record} to mix them"
        )


def claim_results(results: str | Path, table: str | Path) -> None:
    """Write down which table the results in a folder belong to."""
    record = Path(results) / STUDIES / _RECORD
    record.parent.mkdir(parents=True, exist_ok=True)
    if not record.is_file() or record.read_text(encoding="utf-8").strip() != str(table):
        record.write_text(f"{table}\n", encoding="utf-8")
