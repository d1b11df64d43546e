"""Rule page: the page of one design, with a 3D view, in one HTML file."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.whole import atomic_path
from foldshell.report.beside import list_exports
from foldshell.report.combination_data import make_more_data
from foldshell.report.page import write_design_page
from foldshell.report.sections import read_files
from foldshell.report.viewer_data import make_grid, make_viewer_data
from foldshell.results.design_view import view_design
from foldshell.results.state import read_state
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.design import Design, Row
from foldshell.settings.stage import Plain, read_stage

ARRAYS = ("mesh", "folded", "arrays", "final")
"""Inputs that hold the final state; `classes` are added to it."""


def main(
    paths: Mapping[str, str | Path],
    pictures: Mapping[str, str | Path],
    page_path: str | Path,
    *,
    design: Row,
    settings: Plain,
) -> None:
    """Write the page.

    Parameters
    ----------
    paths : mesh, folded, arrays, class_arrays, iterations (npz), final, quality, classes,
        mesh_convergence, comparison (json), history (csv)
    pictures : PNG files by name
    design, settings : row of designs.tsv, plain parameters of stage `size`
    """
    one, given = Design.from_row(design), read_stage(settings, *ANALYSED)
    state_paths = [paths[name] for name in ARRAYS]
    state = read_state(one.name, *state_paths, given.combinations, paths["class_arrays"])
    view = view_design(state, given, one.span, one.pattern)
    files = read_files(one, paths)
    more = make_more_data(view, make_grid(view), given, paths["iterations"])
    rest = pictures, view.sizing.utilization_max, bool(list_exports(Path(page_path).parent))
    page = write_design_page(files, make_viewer_data(view), more, *rest)
    with atomic_path(page_path) as temporary:
        temporary.write_text(page, encoding="utf-8")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input,  # noqa: F821
            {Path(path).stem: path for path in snakemake.input.pictures},  # noqa: F821
            snakemake.output.page,  # noqa: F821
            design=snakemake.params.design,  # noqa: F821
            settings=snakemake.params.settings,  # noqa: F821
        )
