"""Rule mesh_convergence: the final state on a second mesh, for its error and the cross-check."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.whole import read_arrays
from foldshell.loads.cases import make_load_cases
from foldshell.records.files import write_record
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.results.mesh_convergence import estimate_errors, find_largest_errors, study_mesh
from foldshell.settings.analysed import LOADED
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.stage import Plain, read_stage
from foldshell.shell.edge_beams import make_edge_beam


def main(
    folded_path: str | Path,
    final_path: str | Path,
    study_path: str | Path,
    primary_path: str | Path,
    *,
    support: str,
    edge_beam: Sequence[float],
    subdivisions: int,
    settings: Plain,
) -> None:
    """Write mesh_convergence.json (errors of the mesh in use), crosscheck/primary.json; those of a
    mechanism hold the reason in place of numbers."""
    given = read_stage(settings, *LOADED, Crosscheck)
    compared = given.crosscheck.strength, given.crosscheck.deflection
    combinations = {name: given.combinations.all[name] for name in compared}
    study = study_mesh(
        read_arrays(folded_path),
        support,
        read_arrays(final_path)["thickness"],
        subdivisions,
        given.material,
        make_load_cases(given.loads, given.material.unit_weight),
        combinations,
        make_edge_beam(*edge_beam),
    )
    errors = estimate_errors(study)
    record = MeshConvergenceRecord(
        **find_largest_errors(errors), subdivisions=subdivisions, errors=errors, study=study
    )
    write_record(study_path, record)
    write_record(primary_path, study)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.folded,  # noqa: F821
            snakemake.input.final,  # noqa: F821
            snakemake.output.study,  # noqa: F821
            snakemake.output.primary,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
