"""Rule pattern: the crease pattern of a design, sized for its target, as a FOLD file."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import named_errors
from foldshell.folding.targets import find_target, measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.pattern.drawings import draw_pattern, write_drawings
from foldshell.pattern.fold_format import write_fold
from foldshell.pattern.make_panels import make_panels, write_panel_pattern
from foldshell.settings.design import GRID_PATTERNS, NONE, OTHER_PARAMETERS
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
    folded: str = NONE,
    file_unit: str = "m",
    sides: Sequence[float] = (),
    dxf_path: str | Path | None = None,
    svg_path: str | Path | None = None,
    settings: Plain,
    **form: float,
) -> None:
    """Write crease_pattern.fold: flat, rest and folded states [m]; a folded sheet as it stands."""
    style = read_stage(settings, Drawings).drawings
    with named_errors(design):
        target = find_target(surface, span_m, height_m, file_unit, sides)
        if pattern not in GRID_PATTERNS:
            mesh = make_panels(pattern, folded, file_unit, target, (zigzag, strip), **form)
            return write_panel_pattern(mesh, fold_path, dxf_path, svg_path, design, style)
        form = {key: form[key] for key in form if key not in OTHER_PARAMETERS}
        lengths, form["turning"] = target.section_lengths(), measure_turning(target)
        sheet = design_sheet(pattern, lengths, zigzag, strip, sector_angle_deg, **form)
    drawing = draw_pattern(sheet.flat, sheet.grid, style.scale, f"{design}, crease pattern")
    write_drawings(drawing, dxf_path, svg_path, style.preset)
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
