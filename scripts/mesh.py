"""Rule mesh: the shell mesh of a folded sheet with its supports."""

import sys
from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.records.arrays import read_checked_arrays
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.settings.field import Plain
from foldshell.settings.support_row import from_plain
from foldshell.shell.edge_beams import make_edge_beam
from foldshell.shell.mesh_files import (
    mesh_folded_sheet,
    mesh_from_arrays,
    write_mesh,
    write_mesh_vtu,
)
from foldshell.shell.piercing import refuse_piercing


def main(
    folded_path: str | Path,
    mesh_path: str | Path,
    vtu_path: str | Path,
    *,
    design: str,
    support: str | Sequence[Plain],
    subdivisions: int,
    edge_beam: Sequence[float],
) -> None:
    """Read folded.npz, write mesh.npz (for the analysis) and mesh.vtu (to look at).

    `support` is a word for pinned borders or the plain rows of a set, `edge_beam` holds the depth
    and the thickness of its panels, m; one that pierces the sheet is refused.
    """
    folded, beam = read_checked_arrays(folded_path, FoldedArrays), make_edge_beam(*edge_beam)
    try:
        arrays = mesh_folded_sheet(folded, from_plain(support), subdivisions, edge_beam=beam)
    except ValueError as error:
        raise InputError(f"design {design}: mesh: {error}") from None
    if beam:
        refuse_piercing(arrays, design)
    for name in ("support_reports", "support_warnings"):
        for sentence in arrays.get(name, ()):
            print(f"design {design}: {sentence}", file=sys.stderr)
    write_mesh(mesh_path, arrays)
    write_mesh_vtu(vtu_path, mesh_from_arrays(arrays), arrays)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.folded,  # noqa: F821
            snakemake.output.mesh,  # noqa: F821
            snakemake.output.vtu,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
