"""Rule refine: the final state on a second mesh, for its mesh error and for the cross-check."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from foldshell.shell.loads import Loads
from foldshell.shell.material import Material
from foldshell.shell.mesh_study import estimate_errors, study_mesh
from foldshell.study.errors import user_errors
from foldshell.study.files import read_arrays, write_json


def main(
    folded_path: str | Path,
    final_path: str | Path,
    study_path: str | Path,
    primary_path: str | Path,
    *,
    support: str,
    subdivisions: int,
    settings: Mapping[str, Any],
) -> None:
    """Write mesh_study.json (errors of the mesh in use) and crosscheck/primary.json."""
    chosen = settings["crosscheck"]
    groups = settings["combinations"]
    combinations = {
        chosen[group]: groups[group][chosen[group]] for group in ("strength", "deflection")
    }
    study = study_mesh(
        read_arrays(folded_path),
        support,
        read_arrays(final_path)["thickness"],
        subdivisions,
        Material(**settings["material"]),
        Loads(**settings["loads"]),
        combinations,
    )
    errors = estimate_errors(study)
    report = {
        "mesh_error": max(error for values in errors.values() for error in values.values()),
        "subdivisions": subdivisions,
        "errors": errors,
        "study": study,
    }
    write_json(study_path, report)
    write_json(primary_path, study)


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.input.folded,  # noqa: F821
            snakemake.input.final,  # noqa: F821
            snakemake.output.study,  # noqa: F821
            snakemake.output.primary,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
