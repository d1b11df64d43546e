"""One mesh in the middle of a thin sheet: bars at z = 0, concrete in two blocks at +-z."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.membrane import concrete_forces, design_membrane
from foldshell.checks.concrete.sandwich import Levels, split_between_covers


@dataclass(frozen=True)
class CentralMeshDesign:
    """What one mesh needs.

    Attributes
    ----------
    steel : (..., 2) kN/m, bars along x and y
    strut : (..., 2) kN/m, largest compression of the bottom and the top block
    strut_use : (..., 2) its share of what half the sheet carries
    force : (..., 2, 3) kN/m of the two blocks
    """

    steel: np.ndarray
    strut: np.ndarray
    strut_use: np.ndarray
    force: np.ndarray


def design_central_mesh(
    force: np.ndarray, moment: np.ndarray, thickness: np.ndarray, ratio: float, levels: Levels
) -> CentralMeshDesign:
    """f = max of Annex F on n + m / z and on n - m / z, with z = `ratio` t.

    The mesh carries f; the blocks carry c = (n - f +- m / z) / 2, which has no tension since
    n +- m / z - f has none: mesh and blocks are in equilibrium with n and m. Own derivation, by the
    lower-bound theorem as Annex F itself.

    Parameters
    ----------
    force, moment : (..., 3) kN/m and kNm/m as xx, yy, xy in the axes of the bars
    thickness : (...) m
    """
    z = ratio * np.broadcast_to(np.asarray(thickness, float), np.shape(force)[:-1])[..., None]
    bent = [design_membrane(force + sign * moment / z) for sign in (1, -1)]
    steel = np.maximum(bent[0].steel, bent[1].steel)
    lever = np.repeat(z, 2, axis=-1)
    block = split_between_covers(concrete_forces(force, steel), moment, lever)
    strut = _largest_compression(block)
    cracked = (bent[0].cracked | bent[1].cracked)[..., None]
    strength = np.where(cracked, levels.strut_strength, levels.strength)
    use = strut / (np.asarray(thickness, float)[..., None] / 2 * strength)
    return CentralMeshDesign(steel, strut, use, block)


def _largest_compression(force: np.ndarray) -> np.ndarray:
    """Return -min principal value (...) of forces (..., 3) kN/m."""
    x, y, xy = np.moveaxis(force, -1, 0)
    return (np.hypot((x - y) / 2, xy) - (x + y) / 2).clip(min=0.0)
