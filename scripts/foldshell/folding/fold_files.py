"""Fold a crease pattern from its file, cut it where it has an outline, and write what it became."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.folding.cut_files import cut_folded_panels, cut_folded_sheet, write_cut
from foldshell.folding.files import write_folded, write_folded_vtu, write_quality
from foldshell.folding.fold import fold_sheet
from foldshell.folding.fold_panels import fold_panels
from foldshell.folding.panel_files import write_panels
from foldshell.folding.terms import Target
from foldshell.pattern.fold_format import read_fold
from foldshell.pattern.outline import Outline
from foldshell.pattern.panel_fold_format import is_panel_fold, read_panel_fold
from foldshell.settings.fold import Fold


def fold_to_files(
    fold_path: str | Path,
    paths: Sequence[str | Path],
    target: Target | None,
    mode: str,
    settings: Fold,
    outline: Outline | None = None,
) -> None:
    """Fold a pattern onto a target; write folded.npz, folded.vtu and quality.json to `paths`.

    With an outline the whole sheet is folded and judged, and cut then. Raises `InputError`.
    """
    if is_panel_fold(fold_path):
        panels = fold_panels(read_panel_fold(fold_path)[0], target, mode, settings)
        if outline is None:
            write_panels(*paths, panels)
        else:
            write_cut(*paths, panels, cut_folded_panels(panels, outline), outline)
        return
    sheet = read_fold(fold_path)
    result = fold_sheet(sheet, target, mode, settings)
    if outline is not None:
        write_cut(*paths, result, cut_folded_sheet(sheet, result, outline), outline)
        return
    folded, vtu, quality = paths
    write_folded(folded, sheet, result)
    write_folded_vtu(vtu, sheet, result)
    write_quality(quality, result)
