"""Faces of a sheet as rings of sides: planar panels whole, bent ones facet by facet."""

from dataclasses import dataclass

import numpy as np

from foldshell.exchange.model import ExportModel
from foldshell.files.errors import InputError


@dataclass(frozen=True)
class Sides:
    """Sides of the faces, each as it runs counter-clockwise about its face: a planar panel is one
    face, of a bent one each facet.

    `face`, `start`, `stop`, `before`, `after`, `twin` (H,): face, vertices, sides beside it in the
    face, and the same edge in the neighbour (-1 on the border); `normal` (H, 3) and `thickness`
    (H,) m are the face's, `panel` its panel.
    """

    face: np.ndarray
    start: np.ndarray
    stop: np.ndarray
    before: np.ndarray
    after: np.ndarray
    twin: np.ndarray
    normal: np.ndarray
    thickness: np.ndarray
    panel: np.ndarray


def list_sides(model: ExportModel) -> Sides:
    """List the sides of all faces; `InputError` where an edge has more than two faces."""
    rings, normals, owners = [], [], []
    for panel in model.panels:
        if panel.planar:
            rings.append(panel.corners.tolist())
            area = model.area_vectors[panel.facets].sum(axis=0)
            normals.append(area / np.linalg.norm(area))
        else:
            rings += model.facets[panel.facets].tolist()
            normals += list(model.normals[panel.facets])
        owners += [panel.number] * (len(rings) - len(owners))
    count = np.array([len(ring) for ring in rings])
    face, first = (
        np.repeat(np.arange(len(rings)), count),
        np.repeat(np.cumsum(count) - count, count),
    )
    place = np.arange(len(face)) - first
    after = first + (place + 1) % count[face]
    before = first + (place - 1) % count[face]
    start = np.concatenate(rings)
    panel = np.array(owners)[face]
    thickness = np.array([one.thickness for one in model.panels])[panel]
    twin = _find_twins(start, start[after])
    return Sides(
        face, start, start[after], before, after, twin, np.array(normals)[face], thickness, panel
    )


def _find_twins(start: np.ndarray, stop: np.ndarray) -> np.ndarray:
    """Return the side that runs the other way along each, -1 where there is none."""
    count = int(max(start.max(), stop.max())) + 1
    keys, back = start * count + stop, stop * count + start
    order = np.argsort(keys)
    double = np.flatnonzero(np.diff(keys[order]) == 0)
    if len(double):
        side = order[double[0]]
        raise InputError(
            f"exports: solid: the edge between vertices {start[side]} and {stop[side]} has more "
            "than two faces, or faces turned over: each edge of a solid joins two"
        )
    place = np.minimum(np.searchsorted(keys[order], back), len(keys) - 1)
    return np.where(keys[order][place] == back, order[place], -1)
