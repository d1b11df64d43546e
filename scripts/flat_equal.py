"""Rule flat_equal: the flat sheet with the volume of material of a sized folded sheet."""

from pathlib import Path

from foldshell.claims.flat_equal import analyse_flat
from foldshell.claims.measures import Layout
from foldshell.engine.job import run_job
from foldshell.records.analysis import read_analysis
from foldshell.records.arrays import read_checked_arrays
from foldshell.records.files import write_record
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage


def main(
    flat_path: str | Path,
    final_path: str | Path,
    json_path: str | Path,
    *,
    flat: str,
    layout: tuple[int, int, str],
    span_m: float,
    subdivisions: int,
    settings: Plain,
) -> None:
    """Read folded.npz of the flat sheet and final.json of the folded one; write flat_equal.json.

    `flat` names the flat design, `layout` its zigzag, strip and support; `settings` are the plain
    parameters of the stage `size`.
    """
    volume = read_analysis(final_path).volume_m3
    sheet = read_checked_arrays(flat_path, FoldedArrays)
    given = read_stage(settings, *ANALYSED)
    found = analyse_flat(flat, sheet, Layout(*layout), volume, span_m, subdivisions, given)
    write_record(json_path, found)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.flat,  # noqa: F821
            snakemake.input.final,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
