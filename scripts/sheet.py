"""Rule sheet: the calculation sheet of a design, to print from a browser, and its data."""

from collections.abc import Mapping
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.whole import atomic_path, write_json
from foldshell.report.markup import render
from foldshell.report.page import shrink_picture
from foldshell.report.sheet import find_marks, make_sheet
from foldshell.report.sheet_files import read_sheet
from foldshell.report.sketch import draw_sketch
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.design import Design, Row
from foldshell.settings.stage import Plain, read_stage

PICTURE_WIDTH = 800


def main(
    paths: Mapping[str, str | Path],
    html_path: str | Path,
    data_path: str | Path,
    *,
    design: Row,
    settings: Plain,
) -> None:
    """Write the sheet as HTML, and as data for `sheet_pdf`.

    `paths` are mesh, folded, arrays (npz), final, comparison, mesh_convergence (json) and
    utilization (png); `design` is a row of designs.tsv, `settings` those of stage `size`.
    """
    one, given = Design.from_row(design), read_stage(settings, *ANALYSED)
    files, view = read_sheet(paths, one, given)
    sheet = make_sheet(files, view, given)
    sketch = draw_sketch(view, find_marks(view, files.final))
    picture = shrink_picture(paths["utilization"], PICTURE_WIDTH)
    page = render("sheet.html", title=sheet["title"], sheet=sheet, sketch=sketch, picture=picture)
    with atomic_path(html_path) as temporary:
        temporary.write_text(page, encoding="utf-8")
    write_json(data_path, sheet | {"sketch": sketch})


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input,  # noqa: F821
            snakemake.output.html,  # noqa: F821
            snakemake.output.data,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
