"""Rule draw: the pictures of a design, its final fields and its principal stress lines as VTU."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.exchange.design_vtu import write_design_vtu, write_lines_vtu
from foldshell.figures.layout import save_png
from foldshell.figures.pictures import draw_design
from foldshell.results.design_view import view_design
from foldshell.results.state import read_state
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.study import Figures


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
    settings: Plain,
) -> None:
    """Write design.vtu, design_lines.vtu and the PNG files of `pictures`, named as in `PICTURES`;
    `settings` are the parameters of stages `size` and `figures`, report_path is final.json."""
    files = mesh_path, folded_path, final_path, report_path
    given = read_stage(settings, *ANALYSED, Figures)
    state = read_state(design, *files, given.combinations, classes_path)
    view = view_design(state, given, span_m, pattern)
    named = given.combinations.all
    write_design_vtu(vtu_path, state, view.material, named, view.operators)
    write_lines_vtu(lines_path, view)
    size = (given.figures.width_px, given.figures.height_px)
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
