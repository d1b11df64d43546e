"""Rule analyse: second-order shell analysis of one workbook of thicknesses, and the verdict."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from foldshell.shell.analysis import AnalysisOptions, build_model
from foldshell.shell.loads import Loads
from foldshell.shell.material import Material
from foldshell.shell.mesh_files import read_mesh
from foldshell.sizing.criteria import StopRule
from foldshell.sizing.iteration import IterationTask, LoadPlan, run_iteration
from foldshell.sizing.step import NEED_CONSTRAINTS
from foldshell.study.errors import InputError, user_errors
from foldshell.study.files import hash_file, read_arrays, read_json, write_arrays, write_json
from foldshell.workbook.edits import keep_edited
from foldshell.workbook.panels import make_panel_grid
from foldshell.workbook.read_thickness import read_thickness


def main(
    mesh_path: str | Path,
    workbook_path: str | Path,
    json_path: str | Path,
    arrays_path: str | Path,
    *,
    iteration: int,
    span_m: float,
    zigzag: int,
    strip: int,
    settings: Mapping[str, Any],
    previous: tuple[str, str] | None = None,
) -> None:
    """Write analysis.npz, then analysis.json; `previous` names those of the iteration before."""
    sizing = settings["sizing"]
    rule = StopRule(**{name: sizing[name] for name in StopRule.__dataclass_fields__})
    edited = keep_edited(workbook_path)
    grid = make_panel_grid(zigzag, strip)
    thickness = read_thickness(workbook_path, grid, rule.least_thickness, rule.largest_thickness)
    mesh, arrays = read_mesh(mesh_path)
    material = Material(**settings["material"])
    try:
        model = build_model(mesh, arrays["supported_nodes"], material.poissons_ratio)
    except ValueError as error:
        raise InputError(f"{mesh_path}: {error}") from None
    before = (read_json(previous[0]), read_arrays(previous[1])) if previous else ({}, {})
    plan = LoadPlan(Loads(**settings["loads"]), **settings["combinations"])
    options = AnalysisOptions(**settings["analysis"])
    task = IterationTask(iteration, span_m, thickness, *before)
    factor_min = sizing["thinning_buckling_factor_min"]
    factor_min = factor_min if sizing["rule"] in NEED_CONSTRAINTS else None
    report, fields = run_iteration(model, task, material, plan, options, rule, factor_min)
    report["edited"] = edited
    report["workbook_sha256"] = hash_file(workbook_path)
    write_arrays(arrays_path, fields)
    write_json(json_path, report)


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.workbook,  # noqa: F821
            snakemake.output.json,  # noqa: F821
            snakemake.output.arrays,  # noqa: F821
            iteration=int(snakemake.wildcards.iteration),  # noqa: F821
            previous=tuple(snakemake.input.get("previous", ())) or None,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
