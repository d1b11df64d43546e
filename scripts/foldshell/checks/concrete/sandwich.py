"""A shell as two covers in plane stress, whose levers follow what each cover needs.

Marti, P. (1990), Design of concrete slabs for transverse shear, ACI Struct. J. 87(2), 180-190;
EN 1992-2:2005 Annex LL. Forces in kN/m, moments in kNm/m, tension positive; a positive moment is
tension at the bottom. The bottom stands before the top.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.membrane import Pull, design_membrane, resolve_membrane

PASSES = 3
"""Times that levers are found anew; the third moves that of a slab by less than 0.1 %."""


@dataclass(frozen=True)
class Levels:
    """Where covers may act and how strong they are.

    `steel` m from the surface to the middle of a layer's two directions, (...) or one for all;
    `strength` f_cd and `strut_strength` nu f_cd in kPa.
    """

    steel: np.ndarray | float
    strength: float
    strut_strength: float


@dataclass(frozen=True)
class SandwichDesign:
    """What the two layers need.

    Attributes
    ----------
    steel : (..., 2, 2) kN/m, bottom and top layer, bars along x and y
    strut : (..., 2) kN/m, largest compression of each cover
    strut_use : (..., 2) its share of what half the thickness carries: where a strut needs more than
        twice the level of its bars, its distance from them is left out
    lever : (..., 2) m, distance of each cover from the middle surface
    force : (..., 2, 3) kN/m, force of each cover
    """

    steel: np.ndarray
    strut: np.ndarray
    strut_use: np.ndarray
    lever: np.ndarray
    force: np.ndarray


def split_between_covers(force: np.ndarray, moment: np.ndarray, lever: np.ndarray) -> np.ndarray:
    """n_bottom = (z_top n + m) / z, n_top = (z_bottom n - m) / z, with z = z_bottom + z_top.

    force, moment (..., 3) kN/m and kNm/m; lever (..., 2) m; returns (..., 2, 3) kN/m.
    """
    bottom, top = lever[..., 0, None], lever[..., 1, None]
    return (
        np.stack([top * force + moment, bottom * force - moment], axis=-2)
        / ((bottom + top)[..., None])
    )


def design_sandwich(
    force: np.ndarray, moment: np.ndarray, thickness: np.ndarray, levels: Levels
) -> SandwichDesign:
    """Annex F on each cover: at its steel where it needs steel, else at half the depth it needs.

    Parameters
    ----------
    force, moment : (..., 3) kN/m and kNm/m as xx, yy, xy in the axes of the bars
    thickness : (...) m, more than twice `levels.steel`
    """
    n, m = (np.ascontiguousarray(np.moveaxis(one, -1, 0)) for one in (force, moment))
    half = np.broadcast_to(np.asarray(thickness, float) / 2, n.shape[1:])
    at_steel = half - levels.steel
    bottom = top = at_steel
    for _ in range(PASSES):
        total = bottom + top
        below = resolve_membrane(*((n * top + m) / total))
        above = resolve_membrane(*((n * bottom - m) / total))
        bottom, top = (_find_lever(one, half, at_steel, levels) for one in (below, above))
    lever = np.stack([bottom, top], axis=-1)
    shared = split_between_covers(force, moment, lever)
    found = design_membrane(shared)
    strength = np.where(found.cracked, levels.strut_strength, levels.strength)
    use = found.strut / (half[..., None] * strength)
    return SandwichDesign(found.steel, found.strut, use, lever, shared)


def _find_lever(found: Pull, half: np.ndarray, at_steel: np.ndarray, levels: Levels) -> np.ndarray:
    """Return the lever (...) m of a cover that needs what was found; `half` is t / 2."""
    depth = np.minimum(found.strut / levels.strength, half)
    return np.where(found.cracked, at_steel, half - depth / 2)
