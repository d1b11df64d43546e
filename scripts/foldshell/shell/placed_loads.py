"""Loads placed on a mesh: surface loads at quadrature points, imposed strains, settlements.

A load that jumps or is concentrated within an element is represented by the polynomial of the
element's order with the same integrals against all its shape functions: nodal forces, resultant
and moment are those of the load itself.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foldshell.loads.cases import (
    LINE,
    PRESSURE,
    SETTLEMENT,
    TEMPERATURE,
    WEIGHT,
    SurfaceLoad,
    area_factor,
    list_cases,
)
from foldshell.loads.extent import (
    Extent,
    SheetElements,
    find_extent,
    find_lines,
    find_point,
    is_spread,
    mask_panels,
)
from foldshell.loads.pieces import Pieces, barycentric
from foldshell.pattern.regions import mask_region
from foldshell.settings.zones import Variation
from foldshell.shell.reference import edge_quadrature, lagrange_basis, triangle_quadrature
from foldshell.shell.stiffness import ShellOperators


@dataclass(frozen=True)
class PlacedLoads:
    """The loads of C cases on a mesh of E elements.

    Attributes
    ----------
    names : of the cases
    fixed : (E, Q, 3, C) kN per m2 of mesh at quadrature points, what thickness does not change; Q
        is 1 where all loads are uniform over elements
    weight : (E, 3, C) kN/m3, what is in proportion to thickness
    temperature : (E, 2, C) K, mean and the upper side's less the lower side's
    settled : (N, 3, C) m, displacements of supported nodes
    """

    names: tuple[str, ...]
    fixed: np.ndarray
    weight: np.ndarray
    temperature: np.ndarray | None = None
    settled: np.ndarray | None = None

    def at(self, thickness: np.ndarray) -> np.ndarray:
        """Return the loads (E, Q, 3, C) kN per m2 of mesh of a thickness (E,) m."""
        return self.fixed + (self.weight * thickness[:, None, None])[:, None]

    def strains(self, thickness: np.ndarray, expansion: float) -> np.ndarray | None:
        """Return imposed strain and curvature (E, 2, C), - and 1/m, None for none.

        The upper side warmer by T bends the sheet by -a T / t: kappa is + grad grad w. thickness
        (E,) m, expansion a 1/K.
        """
        if self.temperature is None:
            return None
        scale = np.stack([np.full(len(thickness), expansion), -expansion / thickness], axis=1)
        return self.temperature * scale[..., None]


@lru_cache(maxsize=8)
def quadrature_table(order: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return weights (Q,) that sum to one, shape functions (Q, n) at the points, and the values
    (Q, n) there of the polynomials whose integrals against N_j, per area, are 1 for one j and else
    0. Without unit.
    """
    points, weights = triangle_quadrature(2 * order)
    shape = lagrange_basis(order, points)[0]
    mass = (shape * weights[:, None]).T @ shape
    return weights, shape, np.linalg.solve(mass, shape.T).T


def describe_sheet(operators: ShellOperators, self_weight_only: np.ndarray) -> SheetElements:
    """Return the elements of a mesh as loads see them; self_weight_only (E,) bool."""
    mesh, geometry = operators.mesh, operators.geometry
    corners, normal = mesh.nodes[mesh.corners], geometry.frame[:, 2]
    return SheetElements(
        corners, normal, geometry.area, mesh.facet, mesh.panel, ~np.asarray(self_weight_only)
    )


def place_loads(
    operators: ShellOperators,
    self_weight_only: np.ndarray,
    cases: Sequence[SurfaceLoad],
    held: Callable[[], np.ndarray] | None = None,
) -> PlacedLoads:
    """Place the loads of cases on a mesh.

    Parameters
    ----------
    operators : of the mesh
    self_weight_only : (E,) bool, elements that carry nothing but their own weight
    cases : loads, of which a case may have several
    held : returns which translations supports hold, (N, 3) bool; only settlements ask

    Raises
    ------
    ValueError
        in one sentence, for a load whose zone meets no panel, or no support.
    """
    sheet = describe_sheet(operators, self_weight_only)
    fixed, weight = place_on_sheet(sheet, operators.mesh.order, cases)
    names = list_cases(cases)
    return PlacedLoads(
        names,
        fixed,
        weight,
        _place_temperatures(cases, names, sheet),
        _place_settlements(cases, names, sheet, operators, held),
    )


def place_on_sheet(
    sheet: SheetElements, order: int, cases: Sequence[SurfaceLoad]
) -> tuple[np.ndarray, np.ndarray]:
    """Return `fixed` (E, Q, 3, C) kN/m2 and `weight` (E, 3, C) kN/m3 of `PlacedLoads`.

    `order` is that of the elements. Raises `ValueError`.
    """
    names, shape = list_cases(cases), sheet.normal.shape
    placed = [_place(load, sheet, order) for load in cases]
    points = max((len(size[0]) for size in placed if size is not None), default=1)
    fixed = np.zeros((len(sheet.area), points, 3, len(names)))
    weight = np.zeros((*shape, len(names)))
    for load, size in zip(cases, placed, strict=True):
        column, along = names.index(load.case), _direct(load, sheet)
        if load.kind == WEIGHT:
            chosen = np.ones(len(sheet.area), dtype=bool)
            chosen = mask_panels(sheet.panel, load.zone) if load.zone.panels else chosen
            weight[chosen, :, column] += load.value * along[chosen]
        elif size is not None:
            fixed[..., column] += (load.value * size)[:, :, None] * along[:, None]
    return fixed, weight


def _direct(load: SurfaceLoad, sheet: SheetElements) -> np.ndarray:
    """Return the direction of a load on each element, (E, 3) unit."""
    if load.direction is None:
        return -sheet.normal
    return np.broadcast_to(np.array(load.direction), sheet.normal.shape)


def _place(load: SurfaceLoad, sheet: SheetElements, order: int) -> np.ndarray | None:
    """Return the size (E, Q) 1/m2 of a load of unit value at the quadrature points, (E, 1) where
    it is uniform over elements, None where it is no surface load."""
    if load.kind == WEIGHT or load.kind in (TEMPERATURE, SETTLEMENT):
        return None
    if load.kind == LINE:
        return _refuse_nothing(_spread_line(load, sheet, order), load)
    if not is_spread(load):
        return _refuse_nothing(_spread_point(load, sheet, order), load)
    size = spread(find_extent(load, sheet), sheet, order, load.variation)
    size = _refuse_nothing(size * area_factor(load.area, sheet.normal)[:, None], load)
    if load.kind == PRESSURE:
        return size
    return size / (sheet.area * _average(size, order)).sum()


def _average(size: np.ndarray, order: int) -> np.ndarray:
    """Return the mean over each element of values (E, Q) or (E, 1)."""
    return size[:, 0] if size.shape[1] == 1 else size @ quadrature_table(order)[0]


def _refuse_nothing(size: np.ndarray, load: SurfaceLoad) -> np.ndarray:
    if not np.abs(size).max(initial=0) > 0:
        place = f"zone {load.where!r}" if load.where else "the whole sheet"
        area = f" with an area {load.area}" if load.area != "sheet" else ""
        raise ValueError(
            f"load case {load.case}: {place} meets no panel{area}: a zone on the sheet is allowed, "
            "in m from the middle of the plan"
        )
    return size


def spread(
    extent: Extent, sheet: SheetElements, order: int, variation: Variation | None = None
) -> np.ndarray:
    """Return 1 where a load acts and 0 elsewhere, times its variation: (E, Q), or (E, 1) where
    that is uniform over elements. Without unit."""
    if not len(extent.pieces):
        return extent.whole[:, None].astype(float)
    weights, _, to_points = quadrature_table(order)
    size = np.broadcast_to(extent.whole[:, None], (len(extent.whole), len(weights))).astype(float)
    integral = integrate_pieces(extent.pieces, sheet, order, variation)
    return size + integral @ to_points.T


def integrate_pieces(
    pieces: Pieces, sheet: SheetElements, order: int, variation: Variation | None
) -> np.ndarray:
    """Return the integrals of N_j times the variation over the pieces, per area of the element:
    (E, n) without unit."""
    points, weights = triangle_quadrature(order + 1)
    place = np.einsum("qc,tcx->tqx", barycentric(points), pieces.corners)
    shape = lagrange_basis(order, place.reshape(-1, 2))[0]
    shape = shape.reshape(*place.shape[:2], shape.shape[1])
    weight = pieces.share[:, None] * weights
    if variation is not None:
        own = sheet.corners[pieces.owner][..., variation.axis]
        where = np.einsum("tqc,tc->tq", barycentric(place), own)
        weight = weight * np.interp(where, variation.places, variation.factors)
    values = np.einsum("tq,tqn->tn", weight, shape)
    return sum_rows(pieces.owner, values, len(sheet.area))


def sum_rows(owner: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Return sums of rows (T, n) by their owner (T,), (count, n) in the same unit."""
    total = np.zeros((count, values.shape[1]))
    np.add.at(total, owner, values)
    return total


def _spread_line(load: SurfaceLoad, sheet: SheetElements, order: int) -> np.ndarray:
    lines = find_lines(load, sheet)
    xi, weights = edge_quadrature(order + 1)
    place = lines.ends[:, None, 0] + xi[:, None] * (lines.ends[:, 1] - lines.ends[:, 0])[:, None]
    shape = lagrange_basis(order, place.reshape(-1, 2))[0]
    shape = shape.reshape(*place.shape[:2], shape.shape[1])
    values = lines.length[:, None] * np.einsum("q,tqn->tn", weights, shape)
    integral = sum_rows(lines.owner, values, len(sheet.area)) / sheet.area[:, None]
    return integral @ quadrature_table(order)[2].T


def _spread_point(load: SurfaceLoad, sheet: SheetElements, order: int) -> np.ndarray:
    to_points = quadrature_table(order)[2]
    size = np.zeros((len(sheet.area), len(to_points)))
    found = find_point(load, sheet)
    if found is not None:
        owner, place = found
        shape = lagrange_basis(order, place[None])[0][0]
        size[owner] = to_points @ shape / sheet.area[owner]
    return size


def _place_temperatures(
    cases: Sequence[SurfaceLoad], names: Sequence[str], sheet: SheetElements
) -> np.ndarray | None:
    own = [load for load in cases if load.kind == TEMPERATURE]
    if not own:
        return None
    values = np.zeros((len(sheet.area), 2, len(names)))
    for load in own:
        panels = load.zone.kind == "panels"
        on = mask_panels(sheet.panel, load.zone) if panels else np.ones(len(sheet.area), dtype=bool)
        values[on, int(load.direction is None), names.index(load.case)] += load.value
    return values


def _place_settlements(
    cases: Sequence[SurfaceLoad],
    names: Sequence[str],
    sheet: SheetElements,
    operators: ShellOperators,
    held: Callable[[], np.ndarray] | None,
) -> np.ndarray | None:
    """Return displacements of the held translations in the zone of each settlement."""
    own = [load for load in cases if load.kind == SETTLEMENT]
    if not own or held is None:
        return None
    nodes, fixed = operators.mesh.nodes, held()
    values = np.zeros((*nodes.shape, len(names)))
    for load in own:
        move = load.value * np.array(load.direction)
        acts = mask_nodes(load, nodes, sheet)[:, None] & fixed & (np.abs(move) > 0)
        if not acts.any():
            place = load.where or "the whole sheet"
            raise ValueError(
                f"load case {load.case}: zone {place!r} meets no support that is held along the "
                "settlement: a zone with supported nodes is allowed"
            )
        values[..., names.index(load.case)] += np.where(acts, move, 0.0)
    return values


def mask_nodes(load: SurfaceLoad, nodes: np.ndarray, sheet: SheetElements) -> np.ndarray:
    """Return whether nodes (N, 3) m lie in the zone of a load, (N,) bool."""
    if load.zone.kind == "region":
        return mask_region(nodes, load.zone.region)
    if load.zone.kind == "side":
        axis, sign = "xy".index(load.zone.side[0]), -1 if load.zone.side[1] == "-" else 1
        own = sheet.corners[sheet.loaded][..., axis]
        return sign * (nodes[:, axis] - (own.min() + own.max()) / 2) >= -sheet.near
    return np.ones(len(nodes), dtype=bool)
