"""Rule pattern: the crease pattern of a design, sized for its target, as a FOLD file."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.folding.targets import make_target, measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.pattern.drawings import draw_pattern, write_dxf, write_svg
from foldshell.pattern.fold_format import write_fold
from foldshell.settings.exports import Drawings
from foldshell.settings.stage import Plain, read_stage


def main(
    fold_path: str | Path,
    *,
    design: str,
    pattern: str,
    surface: str,
    span_m: float,
    height_m: float,
    zigzag: int,
    strip: int,
    sector_angle_deg: float,
    dxf_path: str | Path | None = None,
    svg_path: str | Path | None = None,
    settings: Plain,
    **form: float,
) -> None:
    """Write crease_pattern.fold: flat pattern, rest state and some folded states [m].

    `form`: rest fold angle, grading, number of folded states; `dxf_path`, `svg_path`: drawings.
    """
    style = read_stage(settings, Drawings).drawings
    try:
        target = make_target(surface, span_m, height_m)
        lengths, form["turning"] = target.section_lengths(), measure_turning(target)
        sheet = design_sheet(pattern, lengths, zigzag, strip, sector_angle_deg, **form)
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"design {design}: {error}") from None
    drawing = draw_pattern(sheet.flat, sheet.grid, style.scale, f"{design}, crease pattern")
    if dxf_path:
        write_dxf(dxf_path, drawing, style.preset)
    if svg_path:
        write_svg(svg_path, drawing, style.preset)
    write_fold(fold_path, sheet, design)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.output.fold,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            dxf_path=snakemake.output.get("dxf"),  # noqa: F821
            svg_path=snakemake.output.get("svg"),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
