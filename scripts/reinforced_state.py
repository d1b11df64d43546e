"""Rule reinforced_state: one design sized until it stands as reinforced concrete, in memory."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from foldshell.claims.reinforced_state import SheetToSize, size_reinforced
from foldshell.engine.job import run_job
from foldshell.records.arrays import read_checked_arrays
from foldshell.records.files import read_record, write_record
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.codes import Codes
from foldshell.settings.design import Design, Row
from foldshell.settings.reinforcement import Co2, Prices
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.support_row import from_plain


def main(
    paths: Mapping[str, str | Path],
    json_path: str | Path,
    flat_paths: Sequence[str | Path] = (),
    *,
    design: Row,
    own: str,
    flat: str | None,
    support: str | Sequence[Plain],
    subdivisions: int,
    settings: Plain,
) -> None:
    """Write the record of the state that the loop delivers.

    `paths` are folded (npz) and mesh_convergence (json), `flat_paths` folded.npz of the flat
    sheet named `flat`, none without one; `own` is the file that `settings` of the stages `size` and
    `checks` are from, `design` a row of designs.tsv.
    """
    given = read_stage(settings, *ANALYSED, Codes, Co2, Prices)
    sheet = SheetToSize(
        Design.from_row(design | {"settings": own}),
        from_plain(support),
        read_checked_arrays(paths["folded"], FoldedArrays),
        subdivisions,
        read_record(paths["mesh_convergence"], MeshConvergenceRecord),
    )
    flats = [(flat, read_checked_arrays(path, FoldedArrays)) for path in flat_paths]
    write_record(json_path, size_reinforced(sheet, given, flats[0] if flats else None))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.input.get("flat", ()),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
