"""Loads on parts of facets, integrated over polygons in plan.

What a load acts on is cut out of each facet as a polygon in plan (shapely), triangulated and
integrated by Gauss points, whose places in the nine-node elements follow from inverting the
bilinear map. Facets that stand upright have no plan: a zone takes them whole, by their middle.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from crosscheck.discretisation import Discretisation
from crosscheck.element import evaluate_shape
from crosscheck.errors import CrosscheckError
from crosscheck.model import Model
from crosscheck.own_loads import OwnLoad, Variation

UPRIGHT = 1e-9  # least |n_z| of a facet that has a plan
TRIANGLE = np.array(
    [[1 / 3, 1 / 3], [0.6, 0.2], [0.2, 0.6], [0.2, 0.2]]
)  # Strang and Fix, degree 3
WEIGHTS = np.array([-27, 25, 25, 25]) / 48


@dataclass(frozen=True)
class Sheet:
    """A model's facets in plan: their corners, normals, areas, and polygons of shapely."""

    corners: np.ndarray  # (F, 3, 3) m
    normal: np.ndarray  # (F, 3)
    area: np.ndarray  # (F,) m2
    polygons: list[Any]
    loaded: np.ndarray  # (F,) bool, carrying more than their own weight


def make_sheet(model: Model) -> Sheet:
    """The facets of a model in plan."""
    from shapely import Polygon

    corners = model.vertices[model.facets]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(cross, axis=1)
    polygons = [Polygon(one) for one in corners[..., :2]]
    loaded = ~model.self_weight_only
    return Sheet(corners, cross / length[:, None], length / 2, polygons, loaded)


def list_parts(model: Model, sheet: Sheet, load: OwnLoad) -> Iterator[tuple[int, Any]]:
    """Each facet with the polygon in plan on which a load acts, None for all of it."""
    region = _find_region(sheet, load)
    covers = _find_covers(sheet) if load.area == "footprint" else {}
    for facet in np.flatnonzero(sheet.loaded).tolist():
        if load.zone.panels is not None and model.facet_panel[facet] not in load.zone.panels:
            continue
        upright = abs(sheet.normal[facet, 2]) < UPRIGHT
        if upright:
            if region is None or region.covers(sheet.polygons[facet].centroid):
                yield facet, None
            continue
        part = sheet.polygons[facet]
        if region is not None:
            part = part.intersection(region)
        for cover in covers.get(facet, ()):
            part = part.difference(sheet.polygons[cover])
        if part.area > 1e-12 * sheet.area[facet]:
            whole = part.area > (1 - 1e-12) * sheet.polygons[facet].area
            yield facet, None if whole else part


def _find_region(sheet: Sheet, load: OwnLoad) -> Any:
    from shapely import Polygon, box

    if load.zone.polygon is not None:
        return Polygon(load.zone.polygon)
    if not load.zone.side:
        return None
    plan = sheet.corners[sheet.loaded][..., :2].reshape(-1, 2)
    low, high = plan.min(axis=0), plan.max(axis=0)
    edge = [low - 1, high + 1]
    axis, upper = "xy".index(load.zone.side[0]), load.zone.side[1] == "+"
    edge[0 if upper else 1][axis] = (low + high)[axis] / 2
    return box(*edge[0], *edge[1])


def _find_covers(sheet: Sheet) -> dict[int, list[int]]:
    """The facets that lie above each facet where their plans overlap."""
    from shapely import STRtree

    flat = sheet.loaded & (np.abs(sheet.normal[:, 2]) >= UPRIGHT)
    tree, covers = STRtree(sheet.polygons), {}
    for one, other in tree.query(sheet.polygons, predicate="intersects").T.tolist():
        if one == other or not (flat[one] and flat[other]):
            continue
        common = sheet.polygons[one].intersection(sheet.polygons[other])
        if common.area < 1e-12 * sheet.area[one]:
            continue
        middle = np.array([common.centroid.x, common.centroid.y])
        if _height(sheet, other, middle) > _height(sheet, one, middle):
            covers.setdefault(one, []).append(other)
    return covers


def _height(sheet: Sheet, facet: int, point: np.ndarray) -> float:
    """z of a facet's plane at (x, y)."""
    start, normal = sheet.corners[facet, 0], sheet.normal[facet]
    return float(start[2] - (point - start[:2]) @ normal[:2] / normal[2])


def area_share(load: OwnLoad, normal: np.ndarray) -> np.ndarray:
    """Area that a load refers to per area of sheet: by n_z of normals (F, 3), (F,) without
    unit."""
    upward = normal[:, 2]
    named = {"plan_net": upward, "plan_up": np.clip(upward, 0, None)}
    named |= {"sheet": np.ones(len(normal))}
    return named.get(load.area, np.abs(upward))


def cut_strips(part: Any, variation: Variation | None, sheet: Sheet, facet: int) -> list[Any]:
    """A polygon cut where a variation along x or y has a kink; along z its facet is tilted."""
    from shapely.geometry import Polygon

    if variation is None:
        return [part]
    row = np.append(np.eye(2)[variation.axis], 0.0) if variation.axis < 2 else None
    if row is None:
        normal, start = sheet.normal[facet], sheet.corners[facet, 0]
        slope = -normal[:2] / normal[2]
        row = np.append(slope, start[2] - slope @ start[:2])
    size = np.hypot(*row[:2])
    if size < 1e-12:
        return [part]
    along, across = row[:2] / size, np.array([-row[1], row[0]]) / size
    far = 10 * (1 + np.abs(sheet.corners).max())
    stops = np.concatenate([[-far], (variation.places - row[2]) / size, [far]])
    strips = []
    for low, high in pairwise(stops):
        corners = [a * along + b * across for a, b in
                   ((low, -far), (high, -far), (high, far), (low, far))]  # fmt: skip
        strips.append(part.intersection(Polygon(corners)))
    return [strip for strip in strips if strip.area > 0]


def gauss_points(part: Any) -> tuple[np.ndarray, np.ndarray]:
    """Points (g, 2) m and weights (g,) m2 that integrate cubics over a polygon in plan."""
    from shapely import constrained_delaunay_triangles

    found = constrained_delaunay_triangles(part)
    triangles = np.array([one.exterior.coords[:3] for one in found.geoms]).reshape(-1, 3, 2)
    points, weights = [np.empty((0, 2))], [np.empty(0)]
    for corner in triangles.reshape(-1, 3, 2):
        # four parts each, so that products of biquadratics are met to many digits
        for trio in _quarter(corner):
            step = trio[1:] - trio[0]
            points.append(trio[0] + TRIANGLE @ step)
            weights.append(WEIGHTS * abs(np.linalg.det(step)) / 2)
    return np.concatenate(points), np.concatenate(weights)


def _quarter(corner: np.ndarray) -> np.ndarray:
    a, b, c = corner
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    return np.array([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]])


def vary(variation: Variation | None, points: np.ndarray) -> np.ndarray:
    """The factor of a variation at points (g, 3) m, (g,)."""
    if variation is None:
        return np.ones(len(points))
    return np.interp(points[:, variation.axis], variation.places, variation.factors)


def locate(grid: Discretisation, facet: int, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (g, 9) in a facet and shape functions (g, 9) of points (g, 3) m on it.

    The nine nodes of an element lie where the bilinear map of its corners puts them.
    """
    start = grid.mesh.nodes[grid.mesh.facet_nodes[facet, 0]]
    local = (points - start) @ grid.axes[facet, :2].T
    nodes = grid.elements.reshape(-1, 9)
    coordinates = grid.coordinates[facet].reshape(-1, 9, 2)
    corner = coordinates[:, [0, 2, 8, 6]]
    natural = _invert(corner[:, None], local[None])
    shape = _corner_shape(natural[..., :1], natural[..., 1:])
    gap = np.abs(np.einsum("egk,ekx->egx", shape, corner) - local).max(axis=2)
    near = gap < 1e-9 * (1 + np.abs(corner).max())  # elsewhere the search has not ended
    outside = np.where(near, np.abs(natural).max(axis=2), np.inf)
    best = outside.argmin(axis=0)
    rows = np.arange(len(points))
    if not (outside[best, rows] < 1 + 1e-6).all():
        raise CrosscheckError("model: load_cases: a point of a load lies on no facet")
    r, s = natural[best, rows].T
    return nodes[best], evaluate_shape(r, s)[0]


SIGN = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)


def _corner_shape(r: np.ndarray, s: np.ndarray) -> np.ndarray:
    """The four bilinear shape functions, (..., 4) for r and s (..., 1)."""
    return (1 + SIGN[:, 0] * r) * (1 + SIGN[:, 1] * s) / 4


def _invert(corner: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Natural coordinates of points (1, g, 2) in quadrilaterals (e, 1, 4, 2), by Newton's method:
    (e, g, 2)."""
    found = np.zeros((*np.broadcast_shapes(corner.shape[:2], point.shape[:2]), 2))
    for _ in range(12):
        r, s = found[..., :1], found[..., 1:]
        by_r = SIGN[:, 0] * (1 + SIGN[:, 1] * s) / 4
        by_s = SIGN[:, 1] * (1 + SIGN[:, 0] * r) / 4
        gap = point - np.einsum("...k,...kx->...x", _corner_shape(r, s), corner)
        slope = np.stack(
            [np.einsum("...k,...kx->...x", by, corner) for by in (by_r, by_s)], axis=-1
        )
        step = np.linalg.solve(slope, gap[..., None])[..., 0]
        found = np.clip(found + step, -4, 4)
    return found
