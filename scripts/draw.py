"""Rule draw: the pictures of a design, its final fields and its principal stress lines as VTU."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from foldshell.engine.job import run_job
from foldshell.exchange.design_vtu import write_design_vtu, write_lines_vtu
from foldshell.figures.layout import save_png
from foldshell.figures.pictures import draw_design
from foldshell.results.design_view import view_design
from foldshell.results.state import read_state
from foldshell.settings.material import Material


def main(
    mesh_path: str | Path,
    folded_path: str | Path,
    final_path: str | Path,
    report_path: str | Path,
    classes_path: str | Path,
    vtu_path: str | Path,
    lines_path: str | Path,
    pictures: Mapping[str, str | Path],
    *,
    design: str,
    span_m: float,
    pattern: str,
    settings: Mapping[str, Any],
) -> None:
    """Write design.vtu, design_lines.vtu and the PNG files of `pictures`, named as in `PICTURES`;
    `settings` are the parameters of stages `size` and `figures`, report_path is final.json."""
    files = mesh_path, folded_path, final_path, report_path
    state = read_state(design, *files, settings["combinations"], classes_path)
    view = view_design(state, settings, span_m, pattern)
    combinations = settings["combinations"]["strength"] | settings["combinations"]["deflection"]
    material = settings["material"]
    known = Material(**material) if "criterion" in material else None
    write_design_vtu(vtu_path, state, view.elasticity, known, combinations)
    write_lines_vtu(lines_path, view)
    size = tuple(settings["figures"][key] for key in ("width_px", "height_px"))
    for name, picture in draw_design(view, size, tuple(pictures)).items():
        save_png(pictures[name], picture)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        files = dict(snakemake.output.items())  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.folded,  # noqa: F821
            snakemake.input.final,  # noqa: F821
            snakemake.input.report,  # noqa: F821
            snakemake.input.classes,  # noqa: F821
            files.pop("vtu"),
            files.pop("lines"),
            files,
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
