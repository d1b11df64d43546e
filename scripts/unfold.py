"""Rule unfold: the crease pattern that a folded design really has, as FOLD, DXF and SVG."""

from pathlib import Path

import numpy as np

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.pattern.drawings import draw_pattern, write_dxf, write_svg
from foldshell.pattern.fold_format import read_fold, write_fold
from foldshell.pattern.sheet import FRAMES
from foldshell.pattern.unfold import describe_true_sheet, name_flat_state
from foldshell.records.arrays import read_typed_arrays
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.settings.exports import Drawings
from foldshell.settings.stage import Plain, read_stage


def main(
    pattern_path: str | Path,
    folded_path: str | Path,
    fold_path: str | Path,
    dxf_path: str | Path,
    svg_path: str | Path,
    *,
    design: str,
    fold_mode: str,
    frames: int = FRAMES,
    settings: Plain,
) -> None:
    """Read crease_pattern.fold and folded.npz; write developable_pattern.fold, .dxf and .svg.

    The flat state is that of folded.npz: the unfolded panels in exact and rigid mode, else the
    given pattern, as the files say. The folded shape is a frame after `frames` of its rigid path,
    where panels can follow one. `settings` are those of stage `drawings`.
    """
    style = read_stage(settings, Drawings).drawings
    sheet, folded = read_fold(pattern_path), read_typed_arrays(folded_path, FoldedArrays)
    if (count := len(folded.vertices)) != (due := len(sheet.flat)):
        raise InputError(f"{folded_path}: vertices: {count}: must be {due} as in {pattern_path}")
    parts = np.linspace(0.0, 1.0, frames + 1)[:-1]
    true = describe_true_sheet(sheet, folded.flat, folded.vertices, parts)
    title = f"{design}, {name_flat_state(sheet.grid, folded, fold_mode)}"
    drawing = draw_pattern(true.flat, true.grid, style.scale, title)
    write_dxf(dxf_path, drawing, style.preset)
    write_svg(svg_path, drawing, style.preset)
    write_fold(fold_path, true, title)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.pattern,  # noqa: F821
            snakemake.input.folded,  # noqa: F821
            snakemake.output.fold,  # noqa: F821
            snakemake.output.dxf,  # noqa: F821
            snakemake.output.svg,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
