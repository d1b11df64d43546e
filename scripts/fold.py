"""Rule fold: fold a crease pattern onto its target surface."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from foldshell.engine.job import run_job
from foldshell.files.errors import InputError
from foldshell.folding.files import write_folded, write_folded_vtu, write_quality
from foldshell.folding.fold import fold_sheet
from foldshell.folding.settings import read_settings
from foldshell.folding.targets import make_target
from foldshell.pattern.fold_format import read_fold


def main(
    fold_path: str | Path,
    folded_path: str | Path,
    vtu_path: str | Path,
    quality_path: str | Path,
    *,
    design: str,
    surface: str = "paraboloid",
    span_m: float = 28.0,
    height_m: float = 10.0,
    fold_mode: str = "paper",
    settings: Mapping[str, Any] | None = None,
) -> None:
    """Read crease_pattern.fold; write folded.npz, folded.vtu and quality.json.

    `settings` is the `fold:` section of the configuration as plain values. A sheet that does
    not reach its target is written too: quality.json tells its state.
    """
    sheet = read_fold(fold_path)
    try:
        target = make_target(surface, span_m, height_m)
        result = fold_sheet(sheet, target, fold_mode, read_settings(settings or {}))
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"design {design}: {error}") from None
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
