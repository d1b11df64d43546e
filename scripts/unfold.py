"""Rule unfold: the crease pattern that a folded design really has, as FOLD, DXF and SVG."""

from pathlib import Path

import numpy as np

from foldshell.files.errors import InputError, user_errors
from foldshell.files.whole import read_arrays
from foldshell.pattern.drawings import draw_pattern, write_dxf, write_svg
from foldshell.pattern.fold_format import read_fold, write_fold
from foldshell.pattern.unfold import describe_true_sheet


def main(
    pattern_path: str | Path,
    folded_path: str | Path,
    fold_path: str | Path,
    dxf_path: str | Path,
    svg_path: str | Path,
    *,
    design: str,
    frames: int = 9,
) -> None:
    """Read crease_pattern.fold and folded.npz; write developable_pattern.fold, .dxf and .svg.

    The flat state is the one that folded.npz records: the given pattern in paper and isometric
    mode, the unfolded panels in exact and rigid mode. The folded shape is a frame, and before
    it, where the panels can follow, `frames` states of its rigid folding path.
    """
    sheet, folded = read_fold(pattern_path), read_arrays(folded_path)
    if folded["vertices"].shape != sheet.flat.shape:
        raise InputError(
            f"{folded_path}: vertices: {len(folded['vertices'])}: must be {len(sheet.flat)} as in "
            f"{pattern_path}"
        )
    parts = np.linspace(0.0, 1.0, frames + 1)[:-1]
    true = describe_true_sheet(sheet, folded["flat"], folded["vertices"], parts)
    drawing = draw_pattern(true.flat, true.grid)
    write_dxf(dxf_path, drawing)
    write_svg(svg_path, drawing)
    write_fold(fold_path, true, f"{design}, as folded")


if "snakemake" in globals():
    with user_errors():
        main(
            snakemake.input.pattern,  # noqa: F821
            snakemake.input.folded,  # noqa: F821
            snakemake.output.fold,  # noqa: F821
            snakemake.output.dxf,  # noqa: F821
            snakemake.output.svg,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
        )
