"""Rule fold: fold a crease pattern onto its target surface, and cut it to its outline."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import named_errors
from foldshell.folding.fold_files import fold_to_files
from foldshell.folding.targets import find_target
from foldshell.pattern.outline import read_outline
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
    outline: Sequence[str] = ("none", "none"),
    settings: Plain,
) -> None:
    """Read crease_pattern.fold; write folded.npz, folded.vtu and quality.json.

    A sheet that does not reach its target is written too: quality.json tells its state. `outline`
    holds the columns outline and openings of the table.
    """
    chosen = read_stage(settings, Fold).fold
    paths = folded_path, vtu_path, quality_path
    with named_errors(design):
        cut = read_outline(*outline, file_unit)
        target = find_target(surface, span_m, height_m, file_unit, sides)
        fold_to_files(fold_path, paths, target, fold_mode, chosen, cut)


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
