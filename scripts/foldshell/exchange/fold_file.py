"""The design as one FOLD file: pattern with target angles, and its way to the folded sheet.

The frames follow each other: flat, the states of the folding path, the folded sheet last, each laid
as near as it can on the one after it.
"""

from pathlib import Path

import numpy as np

from foldshell.exchange.model import ExportModel
from foldshell.exchange.options import ExportOptions
from foldshell.files.whole import write_json
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.fold_format import describe_sheet, read_fold
from foldshell.pattern.sheet import Frame, Sheet
from foldshell.pattern.unfold import describe_true_sheet, fit_onto

PARTS = 9
"""States on the way from flat to folded."""


def write_fold_file(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write the FOLD file of a design from its crease_pattern.fold."""
    given = read_fold(options.sources["pattern"])
    folded = model.vertices[: len(model.flat)]
    parts = np.linspace(0.0, 1.0, PARTS + 1)[:-1]
    sheet = describe_true_sheet(given, model.flat, folded, parts)
    if len(sheet.path) == 1 and np.array_equal(model.flat, given.flat):
        sheet = Sheet(**{**vars(sheet), "path": (*_way_to(given, folded), Frame("folded", folded))})
    data = describe_sheet(sheet, f"{model.design}, {model.flat_note}")
    # the folded sheet once, at its place at the end
    data["file_frames"] = [f for f in data["file_frames"] if f["frame_title"] != "rest"]
    thickness = [panel.thickness for panel in model.panels if panel.sized]
    data["foldshell:panel_thickness_m"] = thickness
    write_json(paths[0], data)


def _way_to(given: Sheet, folded: np.ndarray) -> list[Frame]:
    """Return the states of a given pattern's path that fold less than the folded sheet, in order,
    and its rest state, laid on one another from the folded sheet backwards."""
    reach = np.nanmax(np.abs(measure_folds(given.rest, given.grid)))
    before = [
        frame
        for frame in given.path
        if np.nanmax(np.abs(measure_folds(frame.vertices, given.grid))) < reach
    ]
    placed, onto = [], folded
    for frame in [Frame("rest state of the pattern", given.rest), *reversed(before)]:
        onto = fit_onto(frame.vertices, onto)
        placed.insert(0, Frame(frame.title, onto))
    return placed
