"""The design as one FOLD file: pattern with target angles, and its way to the folded sheet.

The frames follow each other: flat, the states of the folding path, the folded sheet last, each laid
as near as it can on the one after it.
"""

from pathlib import Path

import numpy as np

from foldshell.exchange.model import ExportModel
from foldshell.exchange.options import ExportOptions
from foldshell.files.whole import read_json, write_json
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.fold_format import describe_sheet, read_fold
from foldshell.pattern.panel_fold_format import is_panel_fold, write_panel_fold
from foldshell.pattern.panel_graph import Ragged
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.sheet import Frame, Sheet
from foldshell.pattern.unfold import describe_true_sheet, fit_onto

PARTS = 9
"""States on the way from flat to folded."""


def write_fold_file(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write the FOLD file of a design from its crease_pattern.fold; of a sheet that is no crease
    grid its panels, and of one that an outline cuts its exact pieces."""
    thickness = [panel.thickness for panel in model.panels if panel.sized]
    if model.pieces is not None or is_panel_fold(options.sources["pattern"]):
        mesh = model.pieces or _take_panels(model)
        write_panel_fold(paths[0], mesh, f"{model.design}, {model.flat_note}")
        write_json(paths[0], read_json(paths[0]) | {"foldshell:panel_thickness_m": thickness})
        return
    given = read_fold(options.sources["pattern"])
    folded = model.vertices[: len(model.flat)]
    parts = np.linspace(0.0, 1.0, PARTS + 1)[:-1]
    sheet = describe_true_sheet(given, model.flat, folded, parts)
    if len(sheet.path) == 1 and np.array_equal(model.flat, given.flat):
        sheet = Sheet(**{**vars(sheet), "path": (*_way_to(given, folded), Frame("folded", folded))})
    data = describe_sheet(sheet, f"{model.design}, {model.flat_note}")
    # the folded sheet once, at its place at the end
    data["file_frames"] = [f for f in data["file_frames"] if f["frame_title"] != "rest"]
    data["foldshell:panel_thickness_m"] = thickness
    write_json(paths[0], data)


def _take_panels(model: ExportModel) -> PanelMesh:
    """Return the sized panels with their creases, without those of an edge beam."""
    sized = [panel for panel in model.panels if panel.sized]
    corners = [panel.corners for panel in sized]
    used, number = np.unique(np.concatenate(corners), return_inverse=True)
    inside = [crease for crease in model.creases if np.isin(crease.ends, used).all()]
    edges = np.searchsorted(used, np.array([crease.ends for crease in inside]))
    starts = np.cumsum([0, *map(len, corners)])
    return PanelMesh(
        Ragged(starts, number.ravel()),
        edges,
        np.array([crease.assignment for crease in inside]),
        np.array([crease.angle for crease in inside]),
        flat=None if model.flat is None else model.flat[used],
        folded=model.vertices[used],
    )


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
