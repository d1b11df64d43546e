"""The final fields among the exports: design.vtu under the design's name."""

import shutil
from pathlib import Path

from foldshell.exchange.model import ExportModel
from foldshell.exchange.options import ExportOptions
from foldshell.files.whole import atomic_path


def copy_vtu(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Copy design.vtu."""
    with atomic_path(paths[0]) as temporary:
        shutil.copyfile(options.sources["design_vtu"], temporary)
