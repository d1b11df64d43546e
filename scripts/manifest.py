"""Rule manifest: what a design is made of, every file with its hash, and what decided it."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.provenance import find_versions
from foldshell.files.errors import user_errors
from foldshell.files.job_record import hash_result, read_records
from foldshell.files.manifest import make_manifest, read_manifest, write_manifest
from foldshell.files.whole import hash_data, hash_file

AFTERWARDS = ("archive_study",)
"""Rules that work on what a manifest tells of, and are no part of it."""


def main(
    path: str | Path,
    *,
    title: str,
    deciding_rules: Sequence[str],
    code: str | Path = ".",
    members: Sequence[str | Path] = (),
) -> None:
    """Write the manifest of the folder that `path` lies in, from the records of its jobs.

    `members` are the manifests of a study's designs; `code` is the folder of the workflow.
    """
    home = Path(path).parent
    records = [record for record in read_records(home) if record.rule not in AFTERWARDS]
    decided = sorted(read_manifest(member).result_sha256 for member in members)
    write_manifest(
        path,
        make_manifest(
            title,
            home,
            records,
            hash_data(decided) if decided else hash_result(records, deciding_rules),
            find_versions(code),
            {_relative(Path(member), home): hash_file(member) for member in members},
        ),
    )


def _relative(path: Path, home: Path) -> str:
    up = Path(*[".."] * len(home.relative_to(path.parents[1]).parts))
    return (up / path.relative_to(path.parents[1])).as_posix()


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.output.manifest,  # noqa: F821
            members=snakemake.input.get("members", ()),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
