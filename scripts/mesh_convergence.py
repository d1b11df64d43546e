"""Rule mesh_convergence: the final state on a second mesh, for its error and the cross-check."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.loads.cases import make_load_cases
from foldshell.records.analysis import read_analysis
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.arrays import read_checked_arrays, read_typed_arrays
from foldshell.records.files import write_record
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.results.analysis_start import pick_known
from foldshell.results.governing import list_compared
from foldshell.results.mesh_convergence import DesignOnMeshes
from foldshell.results.mesh_order import study_meshes
from foldshell.results.reinforced_meshes import ask_concrete
from foldshell.settings.analysed import MEASURED
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.support_row import from_plain
from foldshell.shell.edge_beams import make_edge_beam


def main(
    folded_path: str | Path,
    final_path: str | Path,
    report_path: str | Path,
    study_path: str | Path,
    primary_path: str | Path,
    *,
    support: str | list[Plain],
    edge_beam: list[float],
    subdivisions: int,
    third: bool = False,
    settings: Plain,
) -> None:
    """Write mesh_convergence.json and crosscheck/primary.json; the reason for a mechanism."""
    given, final = read_stage(settings, *MEASURED), read_typed_arrays(final_path, AnalysisArrays)
    report = read_analysis(report_path)
    named = list_compared(given.crosscheck, given.combinations, report, given.loads)
    design = DesignOnMeshes(
        read_checked_arrays(folded_path, FoldedArrays), from_plain(support), final.thickness,
        given.material, make_load_cases(given.loads, given.material.unit_weight), named,
        make_edge_beam(*edge_beam), pick_known(final, report, given.combinations.all, list(named)),
        ask_concrete(given, report),
    )  # fmt: skip
    record, study = study_meshes(design, subdivisions, third)
    write_record(study_path, record)
    write_record(primary_path, study)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.folded,  # noqa: F821
            snakemake.input.final,  # noqa: F821
            snakemake.input.report,  # noqa: F821
            snakemake.output.study,  # noqa: F821
            snakemake.output.primary,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
