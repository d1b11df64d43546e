"""Rule sensitivity: loop or delivered state of one design under one changed setting."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.claims.measures import Layout
from foldshell.claims.sensitivity import list_changes
from foldshell.claims.variants import measure_variant
from foldshell.engine.job import run_job
from foldshell.records.files import write_record
from foldshell.records.measures import VariantRecord
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage


def main(
    mesh_path: str | Path,
    json_path: str | Path,
    delivered: Sequence[str | Path] = (),
    *,
    design: str,
    variant: str,
    span_m: float,
    layout: tuple[int, int, str],
    settings: Plain,
) -> None:
    """Write what claims compare of the state that is delivered.

    `delivered` are final.json, final.npz and comparison.json of the design, for variants that do
    not size anew; `layout` are zigzag, strip and support of the design, `settings` the plain
    parameters of the stage `size` before the variant changes them.
    """
    given = read_stage(settings, *ANALYSED)
    measures = measure_variant(mesh_path, variant, given, span_m, Layout(*layout), delivered)
    changes = list_changes(variant)
    record = VariantRecord(design=design, variant=variant, changes=changes, measures=measures)
    write_record(json_path, record)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.input.get("delivered", ()),  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            variant=snakemake.wildcards.variant,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
