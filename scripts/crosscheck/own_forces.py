"""Forces on facet nodes, and means over facets, of load cases that a model states one by one."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from crosscheck.discretisation import Discretisation
from crosscheck.errors import CrosscheckError
from crosscheck.loads import compute_node_areas
from crosscheck.model import Model
from crosscheck.own_loads import OwnLoad
from crosscheck.spreading import (
    Sheet,
    area_share,
    cut_strips,
    gauss_points,
    list_parts,
    locate,
    make_sheet,
    vary,
)

PARTS = 16  # of a line across a facet, each with two Gauss points

Points = tuple[int, np.ndarray | None, np.ndarray]
"""A facet, points on it (g, 3) m, None for all of it, and what each counts (g,) m2, m or 1."""


def list_even_facets(model: Model, load: OwnLoad) -> np.ndarray:
    """The facets that an even load acts on, (F,) bool."""
    chosen = np.ones(len(model.facets), dtype=bool)
    if load.zone.panels is not None:
        chosen = np.isin(model.facet_panel, load.zone.panels)
    return chosen if load.kind == "weight" else chosen & ~model.self_weight_only


def list_points(model: Model, sheet: Sheet, load: OwnLoad) -> Iterator[Points]:
    """The points that stand for a load which is not even, facet by facet."""
    if load.kind == "line":
        yield from _line_points(sheet, load)
    elif load.kind == "force" and load.zone.points is not None:
        yield _find_point(sheet, load)
    else:
        share = area_share(load, sheet.normal)
        for facet, part in list_parts(model, sheet, load):
            if part is None and load.variation is None:
                yield facet, None, sheet.area[[facet]] * share[facet]
                continue
            if part is None and abs(sheet.normal[facet, 2]) < 1e-9:
                points, weights = _upright_points(sheet, facet)
                factor = vary(load.variation, points)
                yield facet, points, weights * factor * share[facet]
                continue
            whole = sheet.polygons[facet] if part is None else part
            for strip in cut_strips(whole, load.variation, sheet, facet):
                plan, weights = gauss_points(strip)
                points = _lift(sheet, facet, plan)
                weights = weights / abs(sheet.normal[facet, 2])
                yield facet, points, weights * vary(load.variation, points) * share[facet]


def _upright_points(sheet: Sheet, facet: int) -> tuple[np.ndarray, np.ndarray]:
    a, b, c = sheet.corners[facet]
    return np.array([(a + b) / 2, (b + c) / 2, (c + a) / 2]), np.full(3, sheet.area[facet] / 3)


def _lift(sheet: Sheet, facet: int, plan: np.ndarray) -> np.ndarray:
    """Points (g, 3) of a facet above points (g, 2) in plan."""
    start, normal = sheet.corners[facet, 0], sheet.normal[facet]
    height = start[2] - (plan - start[:2]) @ normal[:2] / normal[2]
    return np.column_stack([plan, height])


def _line_points(sheet: Sheet, load: OwnLoad) -> Iterator[Points]:
    """Points along a line on each facet that it crosses; along a common edge on one of the two."""
    from shapely import LineString

    seen: set[tuple[float, ...]] = set()
    corners = load.zone.points
    for a, b in pairwise(corners):
        line = LineString([a, b])
        for facet in np.flatnonzero(sheet.loaded).tolist():
            if abs(sheet.normal[facet, 2]) < 1e-9:
                continue
            common = sheet.polygons[facet].intersection(line)
            if common.length < 1e-9:
                continue
            ends = _lift(sheet, facet, np.array(common.coords)[[0, -1]])
            key = tuple(np.round(ends.mean(axis=0), 6))
            if key in seen:
                continue
            seen.add(key)
            place = (np.arange(PARTS)[:, None] + 0.5 + np.array([-1, 1]) / np.sqrt(12)) / PARTS
            points = ends[0] + place.reshape(-1, 1) * (ends[1] - ends[0])
            length = np.linalg.norm(ends[1] - ends[0])
            yield facet, points, np.full(len(points), length / len(points))


def _find_point(sheet: Sheet, load: OwnLoad) -> Points:
    """The topmost facet over a point in plan."""
    from shapely import Point

    plan, best = load.zone.points[:1], None
    for facet in np.flatnonzero(sheet.loaded).tolist():
        if abs(sheet.normal[facet, 2]) < 1e-9:
            continue
        if sheet.polygons[facet].distance(Point(plan[0])) < 1e-9:
            place = _lift(sheet, facet, plan)
            if best is None or place[0, 2] > best[1][0, 2] + 1e-6:
                best = facet, place, np.ones(1)
    if best is None:
        raise CrosscheckError(f"model: load_cases: {load.case}: the point lies on no facet")
    return best


def mean_own_loads(model: Model) -> np.ndarray:
    """Mean load on a square metre of each facet in each case: (F, 3, C) kN/m2."""
    return _collect(model, make_sheet(model), None)[0]


def distribute_own_loads(model: Model, grid: Discretisation) -> tuple[np.ndarray, np.ndarray]:
    """The same, and the forces on facet nodes (F, R, 3, C) in kN."""
    return _collect(model, make_sheet(model), grid)


def _collect(
    model: Model, sheet: Sheet, grid: Discretisation | None
) -> tuple[np.ndarray, np.ndarray | None]:
    mean = np.zeros((len(model.facets), 3, len(model.cases)))
    forces = None
    if grid is not None:
        node_area = compute_node_areas(grid)
        forces = np.zeros((*node_area.shape, 3, len(model.cases)))
    for load in model.own_loads:
        case = model.cases.index(load.case)
        along = -sheet.normal if load.direction is None else np.tile(load.direction, (len(mean), 1))
        if load.is_even and load.kind in ("weight", "pressure"):
            size = load.value * area_share(load, sheet.normal) * list_even_facets(model, load)
            if load.kind == "weight":
                size = size * model.thickness
            mean[..., case] += size[:, None] * along
            if forces is not None:
                forces[..., case] += node_area[..., None] * (size[:, None] * along)[:, None]
            continue
        points = list(list_points(model, sheet, load))
        scale = load.value
        if load.kind == "force":
            scale = load.value / sum(weights.sum() for _, _, weights in points)
        for facet, where, weights in points:
            mean[facet, :, case] += scale * weights.sum() / sheet.area[facet] * along[facet]
            if forces is not None:
                each = scale * _share_nodes(grid, node_area, (facet, where, weights))
                forces[facet, :, :, case] += each[:, None] * along[facet]
    return mean, forces


def _share_nodes(grid: Discretisation, node_area: np.ndarray, points: Points) -> np.ndarray:
    """What each node of a facet takes of a unit load at points: (R,)."""
    facet, where, weights = points
    if where is None:
        return weights[0] * node_area[facet] / node_area[facet].sum()
    place, shape = locate(grid, facet, where)
    each = np.zeros(node_area.shape[1])
    np.add.at(each, place, weights[:, None] * shape)
    return each
