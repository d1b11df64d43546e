"""Rule check: the engineering verdict on the final state, beside that of the paper's criteria."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.records.analysis import read_analysis
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.arrays import read_typed_arrays, write_typed_arrays
from foldshell.records.files import read_record, write_record
from foldshell.records.mesh_convergence import MeshConvergenceRecord
from foldshell.records.sheet_arrays import MeshArrays
from foldshell.results.engineering_record import check_final_state
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.codes import Codes
from foldshell.settings.reinforcement import Co2, Prices
from foldshell.settings.stage import Plain, read_stage
from foldshell.sizing.case import open_case
from foldshell.workbook.engineering import write_engineering


def main(
    paths: Mapping[str, str | Path],
    json_path: str | Path,
    arrays_path: str | Path,
    workbook_path: str | Path,
    *,
    design: str,
    span_m: float,
    settings: Plain,
) -> None:
    """Write engineering.npz, engineering.xlsx and engineering.json.

    `paths` are mesh, arrays (npz), final and mesh_convergence (json); `settings` are those of the
    stages `size` and `checks`.
    """
    given = read_stage(settings, *ANALYSED, Codes, Co2, Prices)
    report = read_analysis(paths["final"])
    final = read_typed_arrays(paths["arrays"], AnalysisArrays)
    shell = read_typed_arrays(paths["mesh"], MeshArrays)
    errors = read_record(paths["mesh_convergence"], MeshConvergenceRecord)
    case = open_case(paths["mesh"], given)
    record, arrays = check_final_state(case, given, final, shell, span_m, errors, report)
    write_typed_arrays(arrays_path, arrays)
    write_engineering(workbook_path, design, record, arrays)
    write_record(json_path, record)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input,  # noqa: F821
            *(snakemake.output[name] for name in ("record", "arrays", "workbook")),  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
