"""Rule compare: analyse the neutral model independently and compare with the primary code."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from crosscheck.errors import report_errors
from crosscheck.model import read_model
from crosscheck.primary import read_primary, read_reason, read_reinforcement
from crosscheck.reading import write_json
from crosscheck.records import to_data
from crosscheck.stability import Method
from crosscheck.system import SHEAR_FACTOR
from crosscheck.verdict import check_meshes, compare_codes, leave_out
from crosscheck.workbook import write_comparison


def main(
    model_path: str | Path,
    primary_path: str | Path,
    json_path: str | Path,
    workbook_path: str | Path,
    *,
    subdivisions: Sequence[int],
    tolerance: Mapping[str, float] | None = None,
    stability: bool = True,
    shear_factor: float = SHEAR_FACTOR,
    solver: str,
) -> None:
    """Read model.json and primary.json; write comparison.json and comparison.xlsx.

    `subdivisions` are the elements along a block side of each mesh, coarse to fine, of the first
    comparison; where codes differ, a second one on finer meshes stands. `tolerance` overrides
    relative tolerances by quantity; `stability` adds buckling factors, values of second order that
    the primary code gives, and what shear adds. `shear_factor` 5/6 is the physical plate; `solver`
    scipy takes the plain path. A mechanism has nothing to compare: `pass` is null, with the reason.
    """
    model, reason = read_model(model_path), read_reason(primary_path)
    meshes = check_meshes(subdivisions)
    if reason is None:
        primary = read_primary(primary_path, model.compared_combinations)
        laid, given = read_reinforcement(primary_path) or (None, None)
        method = Method(shear_factor, stability, stability, stability, solver, laid)
        result = compare_codes(model, primary, meshes, tolerance or {}, method, given)
    else:
        result = leave_out(None, reason, solver)
    write_comparison(workbook_path, model.design, result)
    write_json(json_path, {"design": model.design, **to_data(result)})


if "snakemake" in globals():
    from foldshell.engine.job import run_job  # only notes what was read and written

    with report_errors(), run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.model,  # noqa: F821
            snakemake.input.primary,  # noqa: F821
            snakemake.output.comparison,  # noqa: F821
            snakemake.output.workbook,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
