"""Rule fold: fold a crease pattern onto its target surface."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import named_errors
from foldshell.folding.files import write_folded, write_folded_vtu, write_quality
from foldshell.folding.fold import fold_sheet
from foldshell.folding.fold_panels import fold_panels
from foldshell.folding.panel_files import write_panels
from foldshell.folding.targets import find_target
from foldshell.pattern.fold_format import read_fold
from foldshell.pattern.panel_fold_format import is_panel_fold, read_panel_fold
from foldshell.settings.fold import Fold
from foldshell.settings.stage import Plain, read_stage


def main(
    fold_path: str | Path,
    folded_path: str | Path,
    vtu_path: str | Path,
    quality_path: str | Path,
    *,
    design: str,
    surface: str,
    span_m: float,
    height_m: float,
    fold_mode: str,
    file_unit: str = "m",
    sides: Sequence[float] = (),
    settings: Plain,
) -> None:
    """Read crease_pattern.fold; write folded.npz, folded.vtu and quality.json.

    A sheet that does not reach its target is written too: quality.json tells its state.
    """
    chosen = read_stage(settings, Fold).fold
    with named_errors(design):
        target = find_target(surface, span_m, height_m, file_unit, sides)
        if is_panel_fold(fold_path):
            panels = fold_panels(read_panel_fold(fold_path)[0], target, fold_mode, chosen)
            return write_panels(folded_path, vtu_path, quality_path, panels)
        sheet = read_fold(fold_path)
        result = fold_sheet(sheet, target, fold_mode, chosen)
    write_folded(folded_path, sheet, result)
    write_folded_vtu(vtu_path, sheet, result)
    write_quality(quality_path, result)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.fold,  # noqa: F821
            snakemake.output.folded,  # noqa: F821
            snakemake.output.vtu,  # noqa: F821
            snakemake.output.quality,  # noqa: F821
            design=snakemake.wildcards.design,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
