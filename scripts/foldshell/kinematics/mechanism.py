"""What a folded Miura sheet can do: Poisson's ratios, mechanisms, isometries, soft modes.

All about the planar state of the standard sheet; small sheets, dense linear algebra.
Schenk and Guest, PNAS 110 (2013) 3276; Wei, Guo, Dudte, Liang and Mahadevan, PRL 110 (2013).
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh, null_space, svdvals

from foldshell.folding.terms import Hinge, Stretch, Term
from foldshell.pattern.grid import Grid, find_hinges
from foldshell.pattern.miura import Miura, fold_cell, folded_vertices, poissons_ratio

RANK_TOLERANCE = 1e-9  # of the largest singular value


@dataclass(frozen=True)
class Ratios:
    """In-plane Poisson's ratio by differences and in closed form; bending ratio found, exact."""

    in_plane: float
    in_plane_exact: float
    bending: float
    bending_exact: float
    bending_residual: float


@dataclass(frozen=True)
class Mechanisms:
    """Freedoms beyond the six rigid ones, and redundant constraints, of a bar-hinge sheet."""

    freedoms: int
    self_stresses: int


@dataclass(frozen=True)
class Mode:
    """A soft mode of the free sheet: stiffness over that of the softest, shape, agreement."""

    stiffness: float
    shape: str
    agreement: float


def build_jacobian(term: Term, vertices: np.ndarray) -> np.ndarray:
    """Dense derivatives (m, 3V) of a term's residual."""
    residual, values = term.evaluate(vertices)
    dense = np.zeros((len(residual), vertices.size))
    np.add.at(dense, (np.arange(len(residual))[:, None], term.columns), values)
    return dense


def build_compatibility(vertices: np.ndarray, grid: Grid) -> np.ndarray:
    """Strains of all edges, neutral folds too, by vertex motions: (E, 3V).

    vertices (V, 3) m; strains per m of motion, 1/m.
    """
    edge = vertices[grid.edges[:, 1]] - vertices[grid.edges[:, 0]]
    return build_jacobian(Stretch(grid.edges, np.linalg.norm(edge, axis=1), 1.0), vertices)


def count_mechanisms(vertices: np.ndarray, grid: Grid, rigid_panels: bool) -> Mechanisms:
    """Count freedoms and self-stresses; `rigid_panels` forbids bending at neutral folds too.

    vertices (V, 3) in any unit of length.
    """
    rows = build_compatibility(vertices, grid) * np.ptp(vertices)
    if rigid_panels:
        hinges = find_hinges(grid.facets, grid.edges)
        neutral = hinges.vertices[grid.assignments[hinges.edges] == "F"]
        bend = build_jacobian(Hinge(neutral, np.zeros(len(neutral)), 1.0), vertices)
        rows = np.vstack([rows, bend * np.ptp(vertices)])
    values = svdvals(rows)
    rank = int((values > RANK_TOLERANCE * values[0]).sum())
    return Mechanisms(rows.shape[1] - rank - 6, len(rows) - rank)


def find_lifts(vertices: np.ndarray, grid: Grid) -> np.ndarray:
    """Orthonormal basis (N, k) of the heights that isometries give the lowest vertices.

    vertices (V, 3) m; the basis has no unit.
    """
    motions = null_space(build_compatibility(vertices, grid) * np.ptp(vertices), rcond=1e-11)
    lifts = motions[2::3][grid.zigzag_index % 2 == 0]
    left, values, _ = np.linalg.svd(lifts, full_matrices=False)
    return left[:, values > RANK_TOLERANCE * values[0]]


def measure_isometry(vertices: np.ndarray, grid: Grid) -> dict[str, float]:
    """|f - P f| / |f| of target shapes f(x, y) on the lowest vertices, P the isometric lifts.

    0 says that the sheet follows the shape without stretching, to first order. The saddle is
    x2 - r y2 with the r that suits best.

    vertices (V, 3) m; shares without unit.
    """
    shapes, basis = sample_shapes(vertices, grid), find_lifts(vertices, grid)
    saddle, _ = find_saddle(vertices, grid)
    residuals = {name: _miss(basis, values) for name, values in shapes.items()}
    return {**residuals, "saddle": saddle}


def sample_shapes(vertices: np.ndarray, grid: Grid) -> dict[str, np.ndarray]:
    """Twist xy, dome x2 + y2, cylinders x2 and y2 at the lowest vertices, rigid part removed.

    vertices (V, 3) m; each shape (N,) m2.
    """
    x, y = _centred_plan(vertices, grid)
    shapes = {"twist": x * y, "dome": x**2 + y**2, "arch": x**2, "arch_strip": y**2}
    return {name: _without_plane(values, x, y) for name, values in shapes.items()}


def find_saddle(vertices: np.ndarray, grid: Grid) -> tuple[float, float]:
    """Smallest residual of x2 - r y2 over r, and that r: minus the bending Poisson's ratio.

    vertices (V, 3) in any unit of length; both results have none.
    """
    shapes, basis = sample_shapes(vertices, grid), find_lifts(vertices, grid)
    pair = np.column_stack([shapes["arch"], shapes["arch_strip"]])
    missed = pair - basis @ (basis.T @ pair)
    # The residual's square is a ratio of quadratic forms; taken by QR, no digits are squared.
    _, upper = np.linalg.qr(pair)
    _, values, right = np.linalg.svd(missed @ np.linalg.inv(upper))
    weights = np.linalg.solve(upper, right[-1])
    return float(values[-1]), float(-weights[1] / weights[0])


def measure_ratios(pattern: Miura, fold_angle: float) -> Ratios:
    """Poisson's ratios of the planar state, in plane and in bending, beside the closed forms."""
    step = 1e-5
    low, high = (fold_cell(pattern, fold_angle + side * step) for side in (-1, 1))
    lengthwise = math.log(high.across_zigzags / low.across_zigzags)
    crosswise = math.log(high.across_strips / low.across_strips)
    exact = poissons_ratio(pattern.sector_angle, fold_angle)
    residual, saddle = find_saddle(folded_vertices(pattern, fold_angle), pattern.grid)
    return Ratios(-lengthwise / crosswise, exact, saddle, -exact, residual)


def find_soft_modes(
    pattern: Miura, fold_angle: float, panel_over_crease: float, count: int = 4
) -> list[Mode]:
    """Softest modes of the free bar-and-hinge sheet, softest first.

    K = J_s^T J_s + J_h^T k J_h with bars 1e5 times stiffer than creases; hinge stiffness goes
    with the edge's length. The shape is the one whose heights agree best, by more than half.
    """
    vertices, grid = folded_vertices(pattern, fold_angle), pattern.grid
    hinges = find_hinges(grid.facets, grid.edges)
    lengths = np.linalg.norm(np.diff(vertices[grid.edges[hinges.edges]], axis=1)[:, 0], axis=1)
    stiffness = lengths * np.where(grid.assignments[hinges.edges] == "F", panel_over_crease, 1.0)
    bend = build_jacobian(Hinge(hinges.vertices, np.zeros(len(lengths)), 1.0), vertices)
    stretch = build_compatibility(vertices, grid)
    matrix = bend.T @ (stiffness[:, None] * bend) + 1e5 * stretch.T @ stretch
    values, vectors = eigh(matrix, subset_by_index=(0, 6 + count - 1))
    candidates = _name_shapes(pattern, fold_angle, vertices, grid)
    modes = []
    for value, vector in zip(values[6:], vectors.T[6:], strict=True):
        heights = _without_plane(
            vector[2::3][grid.zigzag_index % 2 == 0], *_centred_plan(vertices, grid)
        )
        agreement = {
            name: abs(heights @ shape) / (np.linalg.norm(heights) * np.linalg.norm(shape))
            for name, shape in candidates.items()
        }
        best = max(agreement, key=lambda name: agreement[name])
        name = best if agreement[best] > 0.5 else "other"
        modes.append(Mode(float(value / values[6]), name, float(agreement[best])))
    return modes


def _name_shapes(
    pattern: Miura, fold_angle: float, vertices: np.ndarray, grid: Grid
) -> dict[str, np.ndarray]:
    shapes = sample_shapes(vertices, grid)
    ratio = -poissons_ratio(pattern.sector_angle, fold_angle)
    saddle = shapes["arch"] - ratio * shapes["arch_strip"]
    return {"twist": shapes["twist"], "saddle": saddle, "dome": shapes["dome"]}


def _centred_plan(vertices: np.ndarray, grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    plan = vertices[grid.zigzag_index % 2 == 0][:, :2]
    x, y = (plan - plan.mean(axis=0)).T
    return x, y


def _without_plane(values: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Remove the best fitting plane, which rigid motions give."""
    plane = np.column_stack([np.ones_like(x), x, y])
    return values - plane @ np.linalg.lstsq(plane, values, rcond=None)[0]


def _miss(basis: np.ndarray, values: np.ndarray) -> float:
    return float(np.linalg.norm(values - basis @ (basis.T @ values)) / np.linalg.norm(values))
