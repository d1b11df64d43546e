"""Cut a folded sheet by an outline in plan: each panel with the polygon, in the panel's own plane.

The sheet is folded whole and cut then: pieces stay planar and the sheet developable, and the same
lines cut the flat sheet. A point on a fold lies on the straight line between the fold's ends, seen
from both sides alike, so that no seam opens.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.triangles import group_near
from foldshell.pattern.outline import Outline, make_region
from foldshell.pattern.panel_graph import Ragged
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.plan_weights import find_weights

MERGED = 1e-6
"""Cut points nearer than this (m) are one vertex."""
PLANAR = 1e-9
"""Warp of a panel, over its diagonal, up to which it is cut as one plane."""
MUCH_LARGER = 20
"""An outline so many times as large as the sheet is taken for one in another unit."""
UPRIGHT = 1e-4
"""Area in plan over true area below which a patch is too steep to be cut in plan."""


@dataclass(frozen=True)
class CutSheet:
    """Planar polygons that a cut leaves of a sheet.

    Attributes
    ----------
    folded, flat : (V, 3) m; flat is None where the sheet has no flat state
    polygons : rows of vertices, counter-clockwise from the positive side
    parent : (K,) panel of the whole sheet that each polygon is of
    patch : (K,) planar patch of that panel: its own, or one of its facets where it is warped
    area_before : (P,) m2, of the panels of the whole sheet
    plan : what the outline leaves of the sheet's plan, a polygon of shapely
    """

    folded: np.ndarray
    flat: np.ndarray | None
    polygons: Ragged
    parent: np.ndarray
    patch: np.ndarray
    area_before: np.ndarray
    plan: Any


def cut_sheet(
    mesh: PanelMesh, facets: np.ndarray, facet_panel: np.ndarray, outline: Outline
) -> CutSheet:
    """Cut the folded state of a sheet, with the facets (F, 3) that its panels (F,) are made of.

    All are numbers. Raises
    ------
    InputError
        for an outline that meets no panel, and where it would cut a panel that stands upright.
    """
    import shapely

    patches, parent = list_patches(mesh, facets, facet_panel)
    plan = mesh.vertices[:, :2]
    shapes = [shapely.Polygon(plan[corners]) for corners in patches]
    sheet = shapely.union_all([shapely.make_valid(shape) for shape in shapes], grid_size=None)
    region = make_region(outline, sheet)
    _refuse_apart(region, sheet, outline)
    shapely.prepare(region)
    points: list[tuple[np.ndarray, np.ndarray | None]] = []
    polygons, owners = [], []
    for k, (corners, shape) in enumerate(zip(patches, shapes, strict=True)):
        if not region.covers(shape.convex_hull) and region.intersects(shape):
            _refuse_upright(mesh, corners, int(parent[k]))
        for ring in _clip(shape, region, corners):
            rows = [_lift(mesh, corners, entry, points) for entry in ring]
            polygons.append(rows)
            owners.append(k)
    area = np.bincount(facet_panel, _areas(mesh.vertices[facets]), minlength=len(mesh.panels))
    pieces = np.array(owners, dtype=np.int64)
    return _assemble(mesh, parent, points, polygons, pieces, area, region & sheet)


def list_patches(
    mesh: PanelMesh, facets: np.ndarray, facet_panel: np.ndarray
) -> tuple[list[np.ndarray], np.ndarray]:
    """Return planar patches (k,) of vertices, and the panel (N,) of each: whole panels, or the
    facets (F, 3) of those that are warped; facet_panel (F,). They are numbers."""
    flat = mesh.measure_warp() <= PLANAR
    patches: list[np.ndarray] = []
    parent = []
    for panel, corners in enumerate(mesh.panels):
        own = [corners] if flat[panel] else list(facets[facet_panel == panel])
        patches += own
        parent += [panel] * len(own)
    return patches, np.array(parent)


def _refuse_upright(mesh: PanelMesh, corners: np.ndarray, panel: int) -> None:
    points = mesh.vertices[corners]
    double = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
    if abs(double[2]) < UPRIGHT * np.linalg.norm(double):
        place = ", ".join(f"{value:.3f}" for value in points.mean(axis=0))
        raise InputError(
            f"outline: it cuts panel {panel} about ({place}) m, which stands upright: an outline "
            "in plan cuts panels that have an area in plan"
        )


def _refuse_apart(region: Any, sheet: Any, outline: Outline) -> None:
    """Refuse an outline or an opening that meets no panel, or of another unit."""
    import shapely

    x, y, right, top = sheet.bounds
    where = f"which stands from ({x:.3f}, {y:.3f}) to ({right:.3f}, {top:.3f}) m"
    for k, hole in enumerate(outline.openings, 1):
        if not shapely.Polygon(hole).intersects(sheet):
            raise InputError(f"openings: opening {k} meets no panel of the sheet, {where}")
    low, high = region.bounds[:2], region.bounds[2:]
    big = max(np.subtract(high, low)) / max(right - x, top - y)
    apart = region.intersection(sheet).area <= 1e-9 * sheet.area
    if apart or big > MUCH_LARGER:
        words = "meets no panel of the sheet" if apart else f"{big:.0f} times as large as the sheet"
        hint = ", it looks like millimetres, metres are due" if 300 < big < 3000 else ""
        raise InputError(
            f"outline: from ({low[0]:g}, {low[1]:g}) to ({high[0]:g}, {high[1]:g}) m: {words}, "
            f"{where}{hint}"
        )


def _clip(shape: Any, region: Any, corners: np.ndarray) -> Iterator[list]:
    """Yield rings of a patch's part in the region: numbers of its vertices, or places in plan."""
    if region.covers(shape):
        yield corners.tolist()
        return
    if not region.intersects(shape):
        return
    for part in _split_holes(shape.intersection(region)):
        ring = np.array(part.exterior.coords)[:-1]
        if part.exterior.is_ccw != shape.exterior.is_ccw:
            ring = ring[::-1]
        if part.area > 0:
            yield list(ring)


def _split_holes(found: Any) -> Iterator[Any]:
    """Yield simple polygons: one with holes is split by a line through one of them."""
    import shapely

    for part in shapely.get_parts(found):
        if part.geom_type in ("MultiPolygon", "GeometryCollection"):
            yield from _split_holes(part)
        elif part.geom_type == "Polygon" and part.interiors:
            x, low, right, high = part.bounds
            middle = shapely.Polygon(part.interiors[0]).centroid.x
            for a, b in ((x - 1, middle), (middle, right + 1)):
                yield from _split_holes(part.intersection(shapely.box(a, low - 1, b, high + 1)))
        elif part.geom_type == "Polygon":
            yield part


def _lift(
    mesh: PanelMesh,
    corners: np.ndarray,
    entry: int | np.ndarray,
    points: list[tuple[np.ndarray, np.ndarray | None]],
) -> int:
    """Return the vertex of a ring's entry: one of the sheet, or a new one behind them.

    On a side of the patch it is interpolated along it, inside in the patch's plane.
    """
    if isinstance(entry, int):
        return entry
    space = mesh.vertices[corners]
    flat = None if mesh.flat is None else mesh.flat[corners]
    weights = find_weights(space, entry)
    near = np.flatnonzero(weights > 1 - 1e-12)
    if len(near):
        return int(corners[near[0]])
    points.append((weights @ space, None if flat is None else weights @ flat))
    return len(mesh.vertices) + len(points) - 1


def _assemble(
    mesh: PanelMesh,
    parent: np.ndarray,
    points: list[tuple[np.ndarray, np.ndarray | None]],
    polygons: list[list[int]],
    owner: np.ndarray,
    area: np.ndarray,
    plan: Any,
) -> CutSheet:
    """Merge vertices, put those that hang on a side into it, and drop what is not used."""
    count = len(mesh.vertices)
    new = np.array([space for space, _ in points]).reshape(-1, 3)
    folded = np.vstack([mesh.vertices, new])
    label = np.arange(len(folded))
    touched = np.union1d(np.arange(count, len(folded)), np.unique(mesh.panels.corners))
    label[touched] = touched[group_near(folded[touched], MERGED)]
    merged = [_distinct([int(label[k]) for k in rows]) for rows in polygons]
    keep = np.array([len(rows) > 2 for rows in merged], dtype=bool)
    merged = [rows for rows, kept in zip(merged, keep, strict=True) if kept]
    owner = owner[keep]
    cut = np.unique(label[count:])
    whole = [_split_pinched(_insert_hanging(rows, folded, cut)) for rows in merged]
    owner = np.repeat(owner, [len(rings) for rings in whole])
    merged = [ring for rings in whole for ring in rings]
    used, number = np.unique(np.concatenate(merged), return_inverse=True)
    starts = np.cumsum([0, *map(len, merged)])
    flat = None
    if mesh.flat is not None:
        flats = np.array([place for _, place in points]).reshape(-1, 3)
        flat = np.vstack([mesh.flat, flats])[used]
    return CutSheet(
        folded[used], flat, Ragged(starts, number.ravel()), parent[owner], owner, area, plan
    )


def _areas(corners: np.ndarray) -> np.ndarray:
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.linalg.norm(double, axis=1) / 2


def _distinct(rows: list[int]) -> list[int]:
    """Return the ring without corners that stand twice in a row, or that go out and come back."""
    while True:
        found = [row for k, row in enumerate(rows) if row != rows[k - 1]]
        size = len(found)
        spikes = {k for k in range(size) if size > 2 and found[k - 1] == found[(k + 1) % size]}
        found = [row for k, row in enumerate(found) if k not in spikes]
        if found == rows:
            return found
        rows = found


def _insert_hanging(rows: list[int], folded: np.ndarray, cut: np.ndarray) -> list[int]:
    """Return a ring with the cut vertices (N,) that lie on its sides."""
    result = []
    places = folded[cut]
    for k, start in enumerate(rows):
        end = rows[(k + 1) % len(rows)]
        along = folded[end] - folded[start]
        length = np.linalg.norm(along)
        share = (places - folded[start]) @ along / length**2
        away = np.linalg.norm(places - folded[start] - share[:, None] * along, axis=1)
        inside = (away <= MERGED) & (share * length > MERGED) & ((1 - share) * length > MERGED)
        result += [start, *cut[inside][np.argsort(share[inside])].tolist()]
    return result


def _split_pinched(ring: list[int]) -> list[list[int]]:
    """Return the simple rings of one that comes back to a vertex: a cut may end at a fold."""
    open_ring: list[int] = []
    found = []
    for vertex in ring:
        if vertex in open_ring:
            at = open_ring.index(vertex)
            found.append(open_ring[at:])
            open_ring = open_ring[:at]
        open_ring.append(vertex)
    return [rows for rows in (*found, open_ring) if len(rows) > 2]


def select_polygons(cut: CutSheet, chosen: np.ndarray) -> CutSheet:
    """Return a cut with some (K,) bool of its polygons alone."""
    if chosen.all():
        return cut
    rows = [cut.polygons[int(k)] for k in np.flatnonzero(chosen)]
    used, number = np.unique(np.concatenate(rows), return_inverse=True)
    starts = np.cumsum([0, *map(len, rows)])
    flat = None if cut.flat is None else cut.flat[used]
    polygons = Ragged(starts, number.ravel())
    owners = cut.parent[chosen], cut.patch[chosen]
    return CutSheet(cut.folded[used], flat, polygons, *owners, cut.area_before, cut.plan)
