"""On which parts of a sheet a load acts: zones cut out of elements exactly."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from foldshell.loads.cases import FORCE, LINE, WEIGHT, SurfaceLoad
from foldshell.loads.pieces import Pieces, join_pieces, make_pieces, split_pieces
from foldshell.loads.polygons import split_convex
from foldshell.loads.visible import subtract_covers
from foldshell.settings.zones import Variation, Zone

NEAR = 1e-11
"""Distance from a line, relative to the sheet, at which a corner counts as on it."""


@dataclass(frozen=True)
class SheetElements:
    """Flat triangles of a sheet.

    Attributes
    ----------
    corners : (E, 3, 3) m
    normal : (E, 3) unit
    area : (E,) m2
    facet, panel : (E,) numbers
    loaded : (E,) bool, those that carry more than their own weight
    """

    corners: np.ndarray
    normal: np.ndarray
    area: np.ndarray
    facet: np.ndarray
    panel: np.ndarray
    loaded: np.ndarray

    @property
    def near(self) -> float:
        """Distance (m) that counts as none."""
        return NEAR * float(np.ptp(self.corners.reshape(-1, 3), axis=0).max())


@dataclass(frozen=True)
class Extent:
    """Where a load over an area acts: on whole elements (E,) bool, and on parts of others."""

    whole: np.ndarray
    pieces: Pieces


def find_extent(load: SurfaceLoad, sheet: SheetElements) -> Extent:
    """Return where a weight, a pressure or a force over an area acts.

    Elements on which a pressure varies are among the pieces, cut where its variation has a kink.
    """
    chosen = np.ones(len(sheet.area), dtype=bool) if load.kind == WEIGHT else sheet.loaded.copy()
    if load.zone.kind == "panels":
        chosen &= mask_panels(sheet.panel, load.zone)
    extent = Extent(chosen, join_pieces([]))
    if load.zone.kind in ("region", "side"):
        extent = _cut_zone(load.zone, sheet, chosen)
    if load.area == "footprint":
        extent = _cut_covered(extent, sheet)
    if load.variation is not None:
        pieces = join_pieces([make_pieces(np.flatnonzero(extent.whole)), extent.pieces])
        extent = Extent(np.zeros_like(chosen), split_kinks(pieces, load.variation, sheet))
    return extent


def mask_panels(panel: np.ndarray, zone: Zone) -> np.ndarray:
    """Return whether panels (E,) lie in the ranges of a zone, (E,) bool; numbers all."""
    ranges = np.array(zone.panels).reshape(-1, 1, 2)
    return ((panel >= ranges[..., 0]) & (panel <= ranges[..., 1])).any(axis=0)


def _cut_zone(zone: Zone, sheet: SheetElements, chosen: np.ndarray) -> Extent:
    """Cut elements by the straight borders of a zone in plan."""
    parts = []
    for lines in _list_borders(zone, sheet):
        pieces = make_pieces(np.flatnonzero(chosen))
        for line in lines:
            pieces, _ = split_pieces(pieces, pieces.evaluate(_along(line, sheet)), sheet.near)
        parts.append(pieces)
    return _tell_whole(join_pieces(parts), chosen)


def _tell_whole(pieces: Pieces, chosen: np.ndarray) -> Extent:
    """Tell elements that are whole from those in pieces; rounding of areas is no cut."""
    share = np.bincount(pieces.owner, pieces.share, len(chosen))
    whole = share > 1 - 1e-13 * np.maximum(np.bincount(pieces.owner, minlength=len(chosen)), 1)
    kept = pieces.share > 1e-15
    return Extent(whole & chosen, pieces.pick(~whole[pieces.owner] & kept))


def _list_borders(zone: Zone, sheet: SheetElements) -> Iterator[list[np.ndarray]]:
    """Yield convex parts of a zone: lines (a, b, c), on whose inner side a x + b y + c >= 0."""
    if zone.kind == "side":
        axis = "xy".index(zone.side[0])
        own = sheet.corners[sheet.loaded][..., axis]
        middle = (own.min() + own.max()) / 2
        line = np.zeros(3)
        line[axis], line[2] = (1.0, -middle) if zone.side[1] == "+" else (-1.0, middle)
        yield [line]
        return
    for part in split_convex(np.array(zone.region.corners)):
        ahead = np.roll(part, -1, axis=0) - part
        inward = np.column_stack([-ahead[:, 1], ahead[:, 0]])
        inward /= np.linalg.norm(inward, axis=1)[:, None]
        yield list(np.column_stack([inward, -(inward * part).sum(axis=1)]))


def _along(line: np.ndarray, sheet: SheetElements) -> np.ndarray:
    """Return a x + b y + c at the corners of all elements, (E, 3) m."""
    return sheet.corners[..., :2] @ line[:2] + line[2]


def _cut_covered(extent: Extent, sheet: SheetElements) -> Extent:
    """Take away what other facets cover, seen from above."""
    pieces = join_pieces([make_pieces(np.flatnonzero(extent.whole)), extent.pieces])
    above = np.flatnonzero(sheet.loaded)
    seen = subtract_covers(pieces, sheet.corners, sheet.facet, above, sheet.near)
    return _tell_whole(seen, extent.whole | np.isin(np.arange(len(extent.whole)), pieces.owner))


def split_kinks(pieces: Pieces, variation: Variation, sheet: SheetElements) -> Pieces:
    """Cut pieces where the variation has a kink, so that it is linear over each."""
    place = sheet.corners[..., variation.axis]
    for kink in variation.places:
        pieces = join_pieces(split_pieces(pieces, pieces.evaluate(place - kink), sheet.near))
    return pieces.pick(pieces.share > 1e-15)


@dataclass(frozen=True)
class Lines:
    """Straight parts of a line on elements: `owner` (T,), `ends` (T, 2, 2) their r, s, `length`
    (T,) m along the sheet."""

    owner: np.ndarray
    ends: np.ndarray
    length: np.ndarray


def find_lines(load: SurfaceLoad, sheet: SheetElements) -> Lines:
    """Return where a line in plan runs over the sheet, on every facet that it crosses.

    Along a common edge it runs over one of the two elements.
    """
    points = np.array(load.zone.points)
    parts = [
        _cross(sheet, a, b, np.flatnonzero(sheet.loaded)) for a, b in itertools.pairwise(points)
    ]
    owner, ends, length = (np.concatenate(list(arrays)) for arrays in zip(*parts, strict=True))
    kept = length > sheet.near
    return Lines(owner[kept], ends[kept], length[kept])


def _cross(
    sheet: SheetElements, a: np.ndarray, b: np.ndarray, owner: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return owner, ends and length of a straight line from a to b (2,) m in plan."""
    size = np.linalg.norm(b - a)
    along = (b - a) / size
    corners = sheet.corners[owner]
    distance = (corners[..., :2] - a) @ np.array([-along[1], along[0]])
    distance = np.where(np.abs(distance) <= sheet.near, 0.0, distance)
    ahead = distance >= 0
    owner, distance = owner[(cut := ahead.any(axis=1) & ~ahead.all(axis=1))], distance[cut]
    ahead = ahead[cut]
    alone = np.where((ahead.sum(axis=1) == 1)[:, None], ahead, ~ahead).argmax(axis=1)
    order = (alone[:, None] + np.arange(3)) % 3
    value = np.take_along_axis(distance, order, axis=1)
    share = value[:, :1] / (value[:, :1] - value[:, 1:])
    weight = np.zeros((len(owner), 2, 3))
    rows = np.arange(len(owner))
    for k in (0, 1):
        weight[rows, k, order[:, 0]] = 1 - share[:, k]
        weight[rows, k, order[:, k + 1]] = share[:, k]
    place = weight @ sheet.corners[owner]
    far = (place[..., :2] - a) @ along
    span = np.where(np.abs(far[:, 1] - far[:, 0]) > sheet.near, far[:, 1] - far[:, 0], np.inf)
    low, high = (np.clip((limit - far[:, 0]) / span, 0, 1) for limit in (0.0, size))
    upright = np.isinf(span)  # on a vertical element: it lies between the ends or not at all
    low, high = np.where(upright, 0, low), np.where(upright, 1.0, high)
    inside = ~upright | ((far[:, 0] >= 0) & (far[:, 0] <= size))
    turned = np.stack([weight[:, 0] + t[:, None] * (weight[:, 1] - weight[:, 0])
                       for t in (low, high)], axis=1)  # fmt: skip
    step = (turned[:, 1] - turned[:, 0])[:, None] @ sheet.corners[owner]
    length = np.linalg.norm(step[:, 0], axis=1) * inside
    return owner, turned[..., 1:], length


def find_point(load: SurfaceLoad, sheet: SheetElements) -> tuple[int, np.ndarray] | None:
    """Return the element that a point in plan lies on, the topmost, and r, s (2,); None if none.

    On a common edge it is the element with the lower number.
    """
    point = np.array(load.zone.points[0])
    a, b, c = (sheet.corners[:, k, :2] for k in range(3))
    matrix = np.stack([b - a, c - a], axis=2)
    determinant = np.linalg.det(matrix)
    upright = np.abs(determinant) <= 1e-9 * sheet.area
    matrix[upright] = np.eye(2)
    place = np.linalg.solve(matrix, (point - a)[..., None])[..., 0]
    weight = np.concatenate([1 - place.sum(axis=1, keepdims=True), place], axis=1)
    on = (weight >= -1e-9).all(axis=1) & ~upright & sheet.loaded
    if not on.any():
        return None
    height = np.einsum("ec,ec->e", weight, sheet.corners[..., 2])
    top = height[on].max()
    owner = int(np.flatnonzero(on & (height >= top - 1e3 * sheet.near))[0])
    return owner, place[owner]


def is_spread(load: SurfaceLoad) -> bool:
    """Whether a load acts over an area."""
    return load.kind not in (LINE,) and not (load.kind == FORCE and load.zone.kind == "point")
