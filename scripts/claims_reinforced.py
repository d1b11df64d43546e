"""Rule claims_reinforced: the claims C4 to C13 on designs that stand as reinforced concrete."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.claims.design_result import make_comparer
from foldshell.claims.reinforced import judge_reinforced
from foldshell.claims.reinforced_gather import read_reinforced_sources
from foldshell.claims.reinforced_words import write_reinforced_claims
from foldshell.engine.job import run_job
from foldshell.files.whole import atomic_path
from foldshell.records.design_row import make_design_row
from foldshell.records.files import write_records
from foldshell.settings.design import Row
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import STAGES


def main(
    results: str | Path,
    json_path: str | Path,
    page_path: str | Path,
    *,
    designs: Sequence[Row],
    flats: Sequence[Row],
    own: str,
    factor_due: float,
    settings: Plain,
) -> None:
    """Write claims_reinforced.json and claims_reinforced.md.

    `designs` are rows of designs.tsv, `flats` those with a flat sheet of equal volume, `own` the
    file of settings of the reinforced loops and `factor_due` the buckling factor in it, `settings`
    the plain parameters of the stage `study`.
    """
    given = read_stage(settings, *STAGES["study"])
    rows = [[make_design_row(row) for row in group] for group in (designs, flats)]
    found = read_reinforced_sources(Path(results), *rows, given)
    comparer = make_comparer(given.sizing)
    claims = judge_reinforced(*found[:4], comparer, factor_due)
    write_records(json_path, claims)
    with atomic_path(page_path) as temporary:
        text = write_reinforced_claims(claims, found.states, own)
        temporary.write_text(text, encoding="utf-8")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.params.results,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.output.page,  # noqa: F821
            **{k: v for k, v in snakemake.params.items() if k != "results"},  # noqa: F821
        )
