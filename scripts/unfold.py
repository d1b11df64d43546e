"""Rule unfold: the crease pattern that a folded design really has, as FOLD, DXF and SVG."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.folding.unfold_files import unfold_grid, unfold_panels
from foldshell.pattern.drawings import write_drawings
from foldshell.pattern.panel_fold_format import is_panel_fold
from foldshell.pattern.sheet import FRAMES
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
    given pattern, as the files say; of a cut sheet its pieces. The folded shape is a frame after
    `frames` of its rigid path, where panels can follow one. `settings` are those of `drawings`.
    """
    style = read_stage(settings, Drawings).drawings
    folded = read_typed_arrays(folded_path, FoldedArrays)
    if folded.zigzag is None or is_panel_fold(pattern_path):
        drawing = unfold_panels(folded, fold_path, design, fold_mode, style.scale, frames)
    else:
        paths = pattern_path, folded_path, fold_path
        drawing = unfold_grid(*paths, folded, design, fold_mode, frames, style.scale)
    write_drawings(drawing, dxf_path, svg_path, style.preset)


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
