"""Rule neutral_model: the final state of a design as a model that any FE program can read."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.exchange.neutral_model import make_neutral_model
from foldshell.files.whole import write_json
from foldshell.records.analysis import read_analysis
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.arrays import read_checked_arrays, read_typed_arrays
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.results.governing import choose_combinations, find_limits
from foldshell.settings.analysed import LOADED
from foldshell.settings.crosscheck import Crosscheck
from foldshell.settings.stage import Plain, read_stage


def main(
    mesh_path: str | Path,
    final_path: str | Path,
    report_path: str | Path,
    model_path: str | Path,
    *,
    design: str,
    settings: Plain,
) -> None:
    """Write crosscheck/model.json from mesh.npz and the final state."""
    mesh = read_checked_arrays(mesh_path, MeshArrays)
    thickness = read_typed_arrays(final_path, AnalysisArrays).thickness
    given = read_stage(settings, *LOADED, Crosscheck)
    report = read_analysis(report_path)
    compared = choose_combinations(given.crosscheck, given.combinations, report, given.loads)
    model = make_neutral_model(design, mesh, thickness, given, compared, find_limits(report))
    write_json(model_path, model)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.final,  # noqa: F821
            snakemake.input.report,  # noqa: F821
            snakemake.output.model,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
