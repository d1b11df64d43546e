"""Rule animate: the folding path in a FOLD file as an animated GIF and stills."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.folding.animation import draw_states, list_states, write_animation, write_stills
from foldshell.pattern.fold_format import read_fold


def main(
    fold_path: str | Path,
    gif_path: str | Path,
    stills_folder: str | Path | None = None,
    *,
    seconds_per_frame: float = 0.2,
) -> None:
    """Read crease_pattern.fold or developable_pattern.fold; write the path as GIF and stills."""
    sheet = read_fold(fold_path)
    images = draw_states(list_states(sheet), sheet.grid)
    if stills_folder:
        write_stills(stills_folder, images)
    write_animation(gif_path, images, seconds_per_frame)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.fold,  # noqa: F821
            snakemake.output.gif,  # noqa: F821
            snakemake.output.get("stills"),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
