"""Rule claims: each claim of the paper judged by the numbers of the study."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from foldshell.claims.design_result import make_comparer
from foldshell.claims.gather import Sources, read_sources
from foldshell.claims.sensitivity import describe_variants
from foldshell.claims.study import judge_study, list_runs, write_spread, write_warnings
from foldshell.claims.words import write_claims
from foldshell.engine.job import run_job
from foldshell.files.whole import atomic_path
from foldshell.records.design_row import make_design_row
from foldshell.records.files import write_records
from foldshell.records.measures import SensitivityRow
from foldshell.records.table import write_rows
from foldshell.settings.design import Row
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import STAGES


def main(
    results: str | Path,
    json_path: str | Path,
    page_path: str | Path,
    runs_path: str | Path,
    *,
    designs: Mapping[str, Sequence[Row]],
    variants: Sequence[str],
    settings: Plain,
) -> None:
    """Write claims.json, claims.md and the table of all runs with other settings.

    `designs` has rows of designs.tsv: `sized` in full, `folds` for their folding alone, `runs`
    with other settings (`variants`), `flats` with a flat sheet of equal volume. `settings` are
    the plain parameters of the stage `study`.
    """
    given = read_stage(settings, *STAGES["study"])
    rows = {name: [make_design_row(row) for row in group] for name, group in designs.items()}
    found: Sources = read_sources(Path(results), rows, variants, given)
    claims = judge_study(*found, make_comparer(given.sizing))
    write_records(json_path, claims)
    write_rows(runs_path, SensitivityRow, list_runs(found.variants))
    warnings = write_warnings(found.design_results)
    spread = write_spread(found.variants, found.design_results, describe_variants())
    with atomic_path(page_path) as temporary:
        temporary.write_text(write_claims(claims, warnings + spread), encoding="utf-8")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.params.results,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.output.page,  # noqa: F821
            snakemake.output.runs,  # noqa: F821
            designs=snakemake.params.designs,  # noqa: F821
            variants=snakemake.params.variants,  # noqa: F821
            settings=snakemake.params.settings,  # noqa: F821
        )
