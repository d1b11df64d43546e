"""Rule mesh: the shell mesh of a folded sheet with its supports."""

from pathlib import Path

from foldshell.shell.mesh_files import mesh_folded_sheet, read_mesh, write_mesh, write_mesh_vtu
from foldshell.study.errors import InputError, user_errors
from foldshell.study.files import read_arrays


def main(
    folded_path: str | Path,
    mesh_path: str | Path,
    vtu_path: str | Path,
    *,
    design: str,
    support: str,
    subdivisions: int,
) -> None:
    """Read folded.npz, write mesh.npz (for the analysis) and mesh.vtu (to look at)."""
    try:
        arrays = mesh_folded_sheet(read_arrays(folded_path), support, subdivisions)
    except ValueError as error:
        raise InputError(f"design {design}: mesh: {error}") from None
    write_mesh(mesh_path, arrays)
    write_mesh_vtu(vtu_path, read_mesh(mesh_path)[0], arrays)


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.input.folded,  # noqa: F821
            snakemake.output.mesh,  # noqa: F821
            snakemake.output.vtu,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
