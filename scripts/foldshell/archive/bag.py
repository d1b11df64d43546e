"""Put a study into a bag, and the bag into one file."""

import json
import os
import shutil
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path

import bagit
import yaml

from foldshell.archive.content import (
    CODE,
    CONFIG,
    GIVEN,
    LEFT_OUT,
    RESULTS,
    RULE,
    Study,
    clean_text,
    export_code,
    find_private,
    list_given,
    list_results,
    private_words,
)
from foldshell.archive.crate import CrateContent, make_metadata
from foldshell.archive.edits import describe_edits
from foldshell.archive.machine import describe_machine
from foldshell.archive.seal import DIGITS, SEAL, hash_before_seal
from foldshell.archive.words import describe_archive
from foldshell.files.errors import InputError
from foldshell.files.job_record import FOLDER, read_records
from foldshell.files.whole import Json, atomic_path
from foldshell.settings.archive import Archive

TEXTS = (".log", ".tsv", ".txt")
EPOCH = (1980, 1, 1, 0, 0, 0)


def write_archive(
    path: str | Path,
    study: Study,
    config: Json,
    tables: Sequence[Path],
    result_sha256: str,
    date: str,
    options: Archive,
) -> None:
    """Write the archive of a study as one zip file.

    Parameters
    ----------
    config : all settings of the run
    tables : table of designs first, then other files that the settings name
    date : when, as YYYY-MM-DD

    Raises
    ------
    InputError
        for a working tree that differs from its commit, and where something would be let out that
        names the machine or its user.
    """
    with tempfile.TemporaryDirectory() as scratch:
        bag = Path(scratch, Path(path).stem)
        bag.mkdir()
        commit, difference = _copy_code(study, bag, options)
        _copy_config(bag, config, tables)
        _copy_given(study, bag, tables)
        _copy_results(study, bag, options)
        _write_json(bag / "machine.json", describe_machine())
        if difference:
            (bag / "difference.patch").write_text(difference, encoding="utf-8")
        words = describe_archive(study, commit, result_sha256, options, tables[0].name)
        (bag / "README.md").write_text(words, encoding="utf-8")
        _check_private(bag, private_words(study.project))
        _write_json(bag / "ro-crate-metadata.json", _describe(study, bag, commit, date))
        bagit.make_bag(str(bag), _bag_info(study, date, result_sha256), checksums=["sha256"])
        with atomic_path(path) as temporary:
            zip_folder(bag, temporary)


def _copy_code(study: Study, bag: Path, options: Archive) -> tuple[str, str]:
    (bag / CODE).mkdir()
    return export_code(study.project, bag / CODE, options.dirty)


def _copy_config(bag: Path, config: Json, tables: Sequence[Path]) -> None:
    """Write the settings of the run, with the tables and files they name beside them."""
    folder = bag / CONFIG
    folder.mkdir()
    text = yaml.safe_dump(dict(config), sort_keys=False, allow_unicode=True)
    (folder / "config.yaml").write_text(text, encoding="utf-8")
    for table in tables:
        shutil.copyfile(table, folder / Path(table).name)


def _copy_given(study: Study, bag: Path, tables: Sequence[Path]) -> None:
    """Copy the files that designs name, such as target surfaces, but those of the commit."""
    for path in list_given(study, tables):
        source, code = study.project / path, bag / CODE / path
        if not (code.is_file() and code.read_bytes() == source.read_bytes()):
            target = bag / GIVEN / path
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)


def _copy_results(study: Study, bag: Path, options: Archive) -> None:
    words = private_words(study.project)
    if not options.fields:
        every = {place for _, place in list_results(study, True)}
        kept = {place for _, place in list_results(study, False)}
        lines = "".join(f"{place}\n" for place in sorted(every - kept))
        (bag / LEFT_OUT).write_text(lines, encoding="utf-8")
    for path, place in list_results(study, options.fields):
        target = bag / place
        target.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix in TEXTS:
            text = path.read_text(encoding="utf-8", errors="replace")
            target.write_text(clean_text(text, words), encoding="utf-8")
        else:
            shutil.copyfile(path, target)


def _check_private(bag: Path, words: tuple[str, ...]) -> None:
    files = (path for path in (bag / RESULTS).rglob("*") if path.is_file())
    found = find_private(files, words)
    if found:
        raise InputError(f"{found[0].replace(f'{bag}/', '')}: names this machine or its user")


def _describe(study: Study, bag: Path, commit: str, date: str) -> Json:
    from importlib.metadata import version

    files = {
        path.relative_to(bag).as_posix(): path.stat().st_size
        for path in sorted(bag.rglob("*"))
        if path.is_file()
    }
    home = study.home.relative_to(study.results).as_posix()
    names = [*study.designs, *([home] if (study.home / FOLDER).is_dir() else [])]
    records = {
        name: [record for record in read_records(study.results / name) if record.rule != RULE]
        for name in names
    }
    return make_metadata(
        CrateContent(
            title=f"Study {study.tag} of folded shell structures",
            description="Folded sheets, sized shells, their cross-check and what made them.",
            date=date,
            commit=commit,
            snakemake=version("snakemake"),
            files=files,
            records=records,
            edits={
                name: describe_edits(study.results / name, found) for name, found in records.items()
            },
        )
    )


def _bag_info(study: Study, date: str, result_sha256: str) -> dict[str, str]:
    return {
        "Bagging-Date": date,
        "External-Identifier": f"{study.tag}-{result_sha256[:8]}",
        "External-Description": f"Study {study.tag} of foldshell",
        "Bag-Software-Agent": "foldshell",
    }


def _write_json(path: Path, data: object) -> None:
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def zip_folder(folder: Path, path: Path) -> None:
    """Write a folder as a zip whose bytes depend on names and contents alone.

    Its comment ends with the SHA-256 of all bytes before: the hashes of a bag do not reach what a
    zip holds besides the files.
    """
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        archive.comment = SEAL + bytes(DIGITS)
        for file in sorted(item for item in folder.rglob("*") if item.is_file()):
            place = f"{folder.name}/{file.relative_to(folder).as_posix()}"
            archive.writestr(zipfile.ZipInfo(place, EPOCH), file.read_bytes(), zipfile.ZIP_DEFLATED)
    with open(path, "r+b") as stream:
        digest = hash_before_seal(stream)
        stream.seek(-DIGITS, os.SEEK_END)
        stream.write(digest.encode())
