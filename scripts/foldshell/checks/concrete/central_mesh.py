"""One mesh in the middle of a thin sheet: bars at z = 0, concrete in two blocks at +-z."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.membrane import resolve_membrane
from foldshell.checks.concrete.sandwich import Levels


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
    n, m = (np.ascontiguousarray(np.moveaxis(one, -1, 0)) for one in (force, moment))
    half = np.broadcast_to(np.asarray(thickness, float) / 2, n.shape[1:])
    found = resolve_central_mesh(n, m, half, ratio, levels)
    return CentralMeshDesign(
        np.stack(found.steel, axis=-1),
        np.stack(found.strut, axis=-1),
        np.stack(found.strut_use, axis=-1),
        np.stack([np.moveaxis(one, 0, -1) for one in found.force], axis=-2),
    )


@dataclass(frozen=True)
class Mesh:
    """The same with pairs of (k,) arrays: `steel` along x and y, `strut` and `strut_use` of the
    bottom and the top block, whose `force` is a pair of (3, k)."""

    steel: tuple[np.ndarray, np.ndarray]
    strut: tuple[np.ndarray, np.ndarray]
    strut_use: tuple[np.ndarray, np.ndarray]
    force: tuple[np.ndarray, np.ndarray]


def resolve_central_mesh(
    n: np.ndarray, m: np.ndarray, half: np.ndarray, ratio: float, levels: Levels
) -> Mesh:
    """The same for components that stand apart.

    n, m (3, k) kN/m and kNm/m, half (k,) m of the thickness; k of any number of axes.
    """
    bent = m / (2 * ratio * half)
    sides = [(force, resolve_membrane(*force)) for force in (n + bent, n - bent)]
    bars = [pull.bars(*force[:2]) for force, pull in sides]
    steel = tuple(np.maximum(*one) for one in zip(*bars, strict=True))
    strength = np.where(
        sides[0][1].cracked | sides[1][1].cracked, levels.strut_strength, levels.strength
    )
    blocks, struts, uses = [], [], []
    for sign in (1, -1):
        block = (n + sign * bent) / 2
        block[0] -= steel[0] / 2
        block[1] -= steel[1] / 2
        strut = _largest_compression(block)
        blocks.append(block)
        struts.append(strut)
        uses.append(strut / (half * strength))
    return Mesh(steel, tuple(struts), tuple(uses), tuple(blocks))


def _largest_compression(force: np.ndarray) -> np.ndarray:
    """Return -min principal value (k,) of forces (3, k) kN/m."""
    x, y, xy = force
    return np.maximum(np.sqrt(((x - y) / 2) ** 2 + xy**2) - (x + y) / 2, 0.0)
