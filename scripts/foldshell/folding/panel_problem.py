"""The folding problem of any crease pattern: what is attracted, sides of the plan, start, terms."""

import math

import numpy as np
from scipy.spatial import ConvexHull

from foldshell.folding.net import FoldNet
from foldshell.folding.problem import STEEP
from foldshell.folding.terms import Attraction, Hinge, PlanEdge, Stretch, Target, Term
from foldshell.pattern.unfold import fit_turn, lay_level, rotate_about
from foldshell.settings.fold import FoldWeights

SAME_BOX = 0.999  # of the area of the box along the axes: a smaller one turns the pattern
CURLED = 0.05  # rise over size of the surface through a rest state, from which it is no plane
FREE_BORDER = "free_border"
"""Name of the set by which a pattern says that its border follows no side of the plan."""
GENTLY = 0.01  # of the weight of plan edges, for a border that is only kept from sliding away
ATTRACT = "attract"
"""Name of the set of vertices by which a file says what is attracted."""


def choose_attracted(net: FoldNet, shape: np.ndarray, attract: str) -> np.ndarray:
    """Row numbers (N,) of the vertices drawn to the target.

    Those of the set `attract` of the pattern, where it has one; else the lowest or highest about
    the quadric surface through a folded state `shape` (V, 3) m, or all.
    """
    if ATTRACT in net.mesh.sets:
        return np.unique(net.mesh.sets[ATTRACT])
    used = np.unique(net.mesh.panels.corners)
    if attract == "all":
        return used
    if attract not in ("lowest", "highest"):
        raise ValueError(f"attract {attract!r}: must be lowest, highest or all")
    height = shape[used, 2] - fit_quadric(shape[used])
    middle = 0.5 * (height.min() + height.max())
    return used[(height < middle) == (attract == "lowest")]


def fit_quadric(points: np.ndarray) -> np.ndarray:
    """Height (N,) m of the surface c + a x + b y + p x2 + q y2 + r x y nearest to points (N, 3)."""
    plan = points[:, :2] - points[:, :2].mean(axis=0)
    x, y = plan.T / (np.abs(plan).max() or 1.0)
    terms = np.column_stack([np.ones(len(x)), x, y, x * x, y * y, x * y])
    return terms @ np.linalg.lstsq(terms, points[:, 2], rcond=None)[0]


def measure_curl(points: np.ndarray) -> float:
    """Rise of the quadric surface through points (N, 3) m, over their size, without unit."""
    return float(np.ptp(fit_quadric(points)) / np.ptp(points[:, :2], axis=0).max())


def align_plan(flat: np.ndarray) -> np.ndarray:
    """Turn a sheet (V, 3) m about z so that the least box around it lies along the axes.

    By 45 deg at most; where its own box is as small as any it stays.
    """
    hull = flat[ConvexHull(flat[:, :2]).vertices, :2]
    sides = np.roll(hull, -1, axis=0) - hull
    angles = np.arctan2(sides[:, 1], sides[:, 0])
    angles = np.append((angles + math.pi / 4) % (math.pi / 2) - math.pi / 4, 0.0)

    def turn(points: np.ndarray, angle: float) -> np.ndarray:
        """Points (N, 2) m after a turn by minus an angle in rad."""
        cosine, sine = math.cos(angle), math.sin(angle)
        return points @ np.array([[cosine, -sine], [sine, cosine]])

    areas = np.array([np.prod(np.ptp(turn(hull, angle), axis=0)) for angle in angles])
    if areas[-1] * SAME_BOX <= areas.min():
        return flat
    near = np.flatnonzero(areas <= areas.min() / SAME_BOX)
    best = angles[near[np.abs(angles[near]).argmin()]]
    return np.column_stack([turn(flat[:, :2], best), flat[:, 2]])


def lay_rest(net: FoldNet, rest: np.ndarray, level_by: np.ndarray | None = None) -> np.ndarray:
    """Lay a rest state level, along the axes as its flat sheet lies. Both (V, 3) m.

    Level is the mean of its facets, or the plane nearest to the vertices `level_by` (N,).
    """
    level = lay_level(rest, net.facets.facets)
    if level_by is not None:
        level = turn_level(level, level[level_by])
    middle = level.mean(axis=0)
    flat = align_plan(net.flat)
    plan = (level - middle) * [1, 1, 0]
    turn = fit_turn(plan, (flat - flat.mean(axis=0)) * [1, 1, 0])
    return align_plan(np.column_stack([(plan @ turn)[:, :2], level[:, 2]]))


def turn_level(points: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Turn points (V, 3) so that the plane nearest to some (N, 3) of them lies level. In m."""
    normal = np.linalg.svd(chosen - chosen.mean(axis=0), full_matrices=False)[2][2]
    normal *= np.sign(normal[2]) or 1.0
    axis = np.cross(normal, [0.0, 0.0, 1.0])
    sine = float(np.linalg.norm(axis))
    if sine == 0:
        return points
    turn = rotate_about(axis / sine, np.arctan2(sine, normal[2]))
    return (points - points.mean(axis=0)) @ turn.T + points.mean(axis=0)


def find_plan_corners(net: FoldNet, plan: np.ndarray) -> list[int]:
    """Return the vertices of the border nearest to the corners of the box of a plan (V, 2) m.

    In the order of the border, from low x and low y on, counter-clockwise. Vertices of one panel
    come first, where there are four.
    """
    border = net.border
    candidates = [k for k in border if k in net.corners]
    candidates = candidates if len(candidates) >= 4 else border
    points = plan[candidates]
    low, high = plan[border].min(axis=0), plan[border].max(axis=0)
    found = []
    for corner in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])):
        away = np.linalg.norm((points - corner) / (high - low), axis=1)
        found.append(candidates[int(away.argmin())])
    return found


def list_plan_sides(net: FoldNet, plan: np.ndarray) -> list[tuple[int, int, np.ndarray]]:
    """Return axis, sign and vertices (k,) of the border along each side of a plan (V, 2) m."""
    corners = find_plan_corners(net, plan)
    border = net.border
    place = {vertex: k for k, vertex in enumerate(border)}
    sides = []
    for k, (axis, sign) in enumerate(((1, -1), (0, 1), (1, 1), (0, -1))):
        start, end = place[corners[k]], place[corners[(k + 1) % 4]]
        count = (end - start) % len(border)
        rows = [border[(start + n) % len(border)] for n in range(count + 1)]
        sides.append((axis, sign, np.array(rows)))
    return sides


def hold_plan_sides(
    net: FoldNet, plan: np.ndarray, spans: tuple[float, float], weight: float
) -> PlanEdge:
    """Hold every border vertex near its edge of the plan of size `spans` m; corners near both.

    A border that is free of the plan's sides is held near its own place in `plan` (V, 2) m.
    """
    if FREE_BORDER in net.mesh.sets:
        rows = np.tile(net.border, 2)
        axes = np.repeat([0, 1], len(net.border))
        return PlanEdge(rows, axes, plan[rows, axes], net.reference, GENTLY * weight)
    sides = list_plan_sides(net, plan)
    vertices = [rows for _, _, rows in sides]
    axes = [np.full(len(rows), axis) for axis, _, rows in sides]
    positions = [np.full(len(rows), sign * spans[axis] / 2) for axis, sign, rows in sides]
    return PlanEdge(
        np.concatenate(vertices), np.concatenate(axes), np.concatenate(positions), net.reference,
        weight,
    )  # fmt: skip


def find_spans(target: Target) -> tuple[float, float]:
    """Return the sides of the plan along x and y, m."""
    return target.sides


def place_on_target(placed: np.ndarray, attracted: np.ndarray, target: Target) -> np.ndarray:
    """Lay a planar rest state (V, 3) m on the target, as arc lengths of its central sections.

    Heights above the attracted vertices are set off along the surface normal.
    """
    rest = placed - 0.5 * (placed.min(axis=0) + placed.max(axis=0))
    x, y = target.walk_section(0, rest[:, 0]), target.walk_section(1, rest[:, 1])
    height = placed[:, 2] - placed[attracted, 2].mean()
    base = np.column_stack([x, y, target.evaluate_height(x, y)])
    return base + height[:, None] * target.find_normals(x, y)


def lay_planar(shape: np.ndarray, target: Target) -> np.ndarray:
    """Lay a planar rest state (V, 3) m over the plan at the mean height of the target."""
    centred = shape - 0.5 * (shape.min(axis=0) + shape.max(axis=0))
    half = np.array(target.sides) / 2
    inside = np.clip(centred[:, :2], -half, half)
    return centred + np.array([0.0, 0.0, target.evaluate_height(*inside.T).mean()])


def build_net_terms(
    net: FoldNet,
    target: Target,
    attracted: np.ndarray,
    plan: np.ndarray,
    rest: np.ndarray,
    weights: FoldWeights,
) -> list[Term]:
    """Stretch, crease hinges, neutral folds, attraction, plan edges; in that order.

    attracted (N,) rows, plan (V, 2) m that tells sides of the border, rest (H,) rad.
    """
    steep = target.height >= STEEP * min(target.sides)
    hinges, crease, ell = net.hinges.vertices, net.creases, net.reference
    return [
        Stretch(net.facets.edges, net.lengths, weights.stretch),
        Hinge(hinges[crease], rest[crease], weights.hinge_steep if steep else weights.hinge),
        Hinge(
            hinges[~crease], np.zeros((~crease).sum()),
            weights.neutral_fold_steep if steep else weights.neutral_fold,
        ),
        Attraction(attracted, target, ell, weights.attraction),
        hold_plan_sides(
            net, plan, find_spans(target),
            weights.plan_edge_steep if steep else weights.plan_edge,
        ),
    ]  # fmt: skip
