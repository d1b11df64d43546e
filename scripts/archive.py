"""Rule archive: the study as one file that a stranger can verify and run again."""

from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from foldshell.archive.content import Study
from foldshell.engine.job import run_job
from foldshell.files.libraries import need_library
from foldshell.files.manifest import read_manifest
from foldshell.files.whole import hash_data, hash_file, write_json
from foldshell.settings.archive import Archive
from foldshell.settings.field import Plain
from foldshell.settings.stage import read_stage


def main(
    pointer_path: str | Path,
    *,
    tag: str,
    designs: Sequence[str],
    results: str | Path,
    project: str | Path,
    config: Plain,
    tables: Sequence[str | Path],
    own: Sequence[str],
    settings: Plain,
) -> None:
    """Write `<tag>-<first 8 of the result's hash>.zip`, then archive.json, which names it; `own`
    are the files of settings that designs name."""
    for library in ("bagit", "rocrate"):
        need_library(library, "archive")
    from foldshell.archive.bag import write_archive

    folder = Path(pointer_path).parent
    found = [read_manifest(Path(results, name, "manifest.json")) for name in designs]
    result = hash_data([manifest.result_sha256 for manifest in found])
    study = Study(tag, tuple(designs), Path(results), folder.parent, Path(project), tuple(own))
    path = folder / f"{tag}-{result[:8]}.zip"
    date = datetime.now(UTC).date().isoformat()
    options = read_stage(settings, Archive).archive
    write_archive(path, study, config, [Path(table) for table in tables], result, date, options)
    about = {"file": path.name, "sha256": hash_file(path), "bytes": path.stat().st_size}
    write_json(pointer_path, {**about, "result_sha256": result})


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(snakemake.output.pointer, **snakemake.params)  # noqa: F821
