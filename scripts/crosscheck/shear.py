"""What transverse shear adds: the first-order state once more, with the plate's true rigidity.

The thin limit leaves it out in both codes. K_true = K_thin - D, where D is the integral of the
products of shear strains times the rigidity that the true plate lacks. K_true u = F is solved by
conjugate gradients with the factor of K_thin that is there: the sweeps that the other searches
make serve this one as well, and no second factor is needed.
Source: Golub and Van Loan, Matrix Computations (2013), algorithm 11.5.1.
"""

from collections.abc import Callable

import numpy as np

from crosscheck.element import compute_tied_shear, integrate_tied_shear
from crosscheck.search import NotSettled, Steps
from crosscheck.second_order import sum_elements
from crosscheck.system import Response, System, compute_shear_rigidity, place_state

TRUE_SHEAR_FACTOR = 5 / 6
"""Of a homogeneous plate (Reissner)."""
LAST_PART = 0.01
"""Of the work that shear adds, what the last of two steps in a row may add at most: the share is
then known to 1 or 2 % of itself."""
STEPS = 60


def search_sheared_state(system: System, first: Response) -> Steps:
    """K_true u = F for the forces F of each column of `first`, which is thin.

    Returns a State, raises NotSettled.
    """
    soften = _make_softening(system)
    local = first.local.copy()
    residual = soften(local)  # F - K_true u
    direction = image = np.zeros_like(local)  # p, and K_thin p
    length, added, small = np.ones(local.shape[-1]), 0.0, 0
    for step in range(STEPS):
        solved = (yield residual).local
        new = _multiply(residual, solved)
        direction = solved + (new / length if step else 0.0) * direction
        image = residual + (new / length if step else 0.0) * image
        length = new
        product = image - soften(direction)
        pace = length / np.maximum(_multiply(direction, product), 1e-300)
        local += pace * direction
        residual = residual - pace * product
        gain = pace * length
        added = added + gain
        small = small + 1 if (gain <= LAST_PART * added).all() else 0
        if small == 2:
            return place_state(system, local)
    raise NotSettled(f"after {STEPS} steps the state with shear is not found")


def _multiply(force: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Work of forces (F, R, 5, c) on displacements of the same shape: (c,)."""
    return np.einsum("frdc,frdc->c", force, local)


def _make_softening(system: System) -> Callable[[np.ndarray], np.ndarray]:
    """D u as forces on the facets' own nodes, (F, R, 5, c) from (F, R, 5, c)."""
    grid, section = system.grid, system.section
    lack = compute_shear_rigidity(grid, section, section.shear_factor)
    lack -= compute_shear_rigidity(grid, section, TRUE_SHEAR_FACTOR)
    tied = compute_tied_shear(grid.coordinates)
    middle = integrate_tied_shear(grid.quadrature) * lack[..., None, None]

    def soften(local: np.ndarray) -> np.ndarray:
        """D u."""
        plate = np.take(local[:, :, 2:], grid.elements, axis=1)
        shear = middle @ (tied @ plate.reshape(*tied.shape[:3], 27, -1))
        force = (np.swapaxes(tied, -1, -2) @ shear).reshape(*tied.shape[:3], 9, -1)
        result = np.zeros_like(local)
        result[:, :, 2:] = sum_elements(grid, force).reshape(result[:, :, 2:].shape)
        return result

    return soften
