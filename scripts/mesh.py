"""Rule mesh: the shell mesh of a folded sheet with its supports."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays
from foldshell.folding.intersections import find_piercing
from foldshell.shell.edge_beams import make_edge_beam
from foldshell.shell.mesh_files import (
    mesh_folded_sheet,
    mesh_from_arrays,
    write_mesh,
    write_mesh_vtu,
)


def main(
    folded_path: str | Path,
    mesh_path: str | Path,
    vtu_path: str | Path,
    *,
    design: str,
    support: str,
    subdivisions: int,
    edge_beam: Sequence[float],
) -> None:
    """Read folded.npz, write mesh.npz (for the analysis) and mesh.vtu (to look at).

    `edge_beam` holds the depth and the thickness of its panels, m; one that pierces the sheet is
    refused.
    """
    folded, beam = read_arrays(folded_path), make_edge_beam(*edge_beam)
    try:
        arrays = mesh_folded_sheet(folded, support, subdivisions, edge_beam=beam)
    except ValueError as error:
        raise InputError(f"design {design}: mesh: {error}") from None
    if beam:
        _check_edge_beam(arrays, len(folded["facets"]), design)
    write_mesh(mesh_path, arrays)
    write_mesh_vtu(vtu_path, mesh_from_arrays(arrays), arrays)


def _check_edge_beam(arrays: Mapping[str, Any], sheet: int, design: str) -> None:
    place = find_piercing(arrays["vertices"], arrays["facets"], sheet)
    if place is not None:
        raise InputError(
            f"design {design}: edge_beam_depth_m: a panel pierces the sheet near "
            f"{place.round(2).tolist()} m: an edge beam clear of it is allowed, such as one of the "
            "other sign, which stands on the other side of the border"
        )


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.folded,  # noqa: F821
            snakemake.output.mesh,  # noqa: F821
            snakemake.output.vtu,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
