"""Rule sensitivity: the sizing loop of one design under one changed setting, in memory."""

from pathlib import Path

from foldshell.claims.measures import Layout, measure_state
from foldshell.claims.sensitivity import VARIANTS, change_settings
from foldshell.engine.job import run_job
from foldshell.records.arrays import read_checked_arrays
from foldshell.records.files import write_record
from foldshell.records.measures import VariantRecord
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.case import open_case
from foldshell.sizing.loop import run_loop


def main(
    mesh_path: str | Path,
    json_path: str | Path,
    *,
    design: str,
    variant: str,
    span_m: float,
    layout: tuple[int, int, str],
    settings: Plain,
) -> None:
    """Write what claims compare of the state that is delivered.

    `layout` are zigzag, strip and support of the design, `settings` the plain parameters of the
    stage `size` before the variant changes them.
    """
    given = read_stage(settings, *ANALYSED)
    changed = change_settings(given, variant)
    result = run_loop(open_case(mesh_path, changed), span_m, changed.sizing)
    measures = measure_state(
        read_checked_arrays(mesh_path, MeshArrays),
        Layout(*layout),
        result.final,
        result.arrays,
        changed.combinations,
        changed.sizing.measure,
    )
    changes = VARIANTS[variant]
    record = VariantRecord(design=design, variant=variant, changes=changes, measures=measures)
    write_record(json_path, record)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            variant=snakemake.wildcards.variant,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
