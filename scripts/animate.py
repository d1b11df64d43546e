"""Rule animate: the folding path in a FOLD file as an animated GIF and stills."""

from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.files.errors import named_errors
from foldshell.folding.animation import (
    draw_panel_states,
    draw_states,
    list_states,
    write_animation,
    write_stills,
)
from foldshell.folding.panel_states import list_path
from foldshell.pattern.fold_format import read_fold
from foldshell.pattern.panel_fold_format import is_panel_fold, read_panel_fold


def main(
    fold_path: str | Path,
    gif_path: str | Path,
    stills_folder: str | Path | None = None,
    *,
    seconds_per_frame: float = 0.2,
) -> None:
    """Read crease_pattern.fold or developable_pattern.fold; write the path as GIF and stills."""
    if is_panel_fold(fold_path):
        mesh, frames = read_panel_fold(fold_path)
        with named_errors(Path(fold_path).name):
            images = draw_panel_states(list_path(mesh, frames), mesh)
    else:
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
