"""A shell as two covers in plane stress, whose levers follow what each cover needs.

Marti, P. (1990), Design of concrete slabs for transverse shear, ACI Struct. J. 87(2), 180-190;
EN 1992-2:2005 Annex LL. Forces in kN/m, moments in kNm/m, tension positive; a positive moment is
tension at the bottom. The bottom stands before the top.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.membrane import Pull, resolve_membrane

PASSES = 3
"""Times that levers are found anew; the third moves that of a slab by less than 0.1 %.
Where concrete crushes 3 % may be left."""
DEPTH_MOST = 0.98
"""Of the thickness that compression of one cover may fill. Beyond half of it concrete crushes, but
the lever goes on falling with the depth: held at that of half the sheet, the steel of panels that
crush is too little, and the largest strut hangs on which points of a mesh pass that bound."""


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
    covers = resolve_covers(n, m, half, levels)
    steel = np.stack([np.stack(one.pull.bars(*one.force[:2]), axis=-1) for one in covers], axis=-2)
    strut, use, lever = (
        np.stack([getattr(one, name) for one in covers], axis=-1)
        for name in ("strut", "strut_use", "lever")
    )
    shared = np.stack([np.moveaxis(one.force, 0, -1) for one in covers], axis=-2)
    return SandwichDesign(steel, strut, use, lever, shared)


@dataclass(frozen=True)
class Cover:
    """One cover of k states: `force` (3, k) kN/m, `pull` what it needs, `lever` (k,) m,
    `strut_use` (k,) share of what half the thickness carries."""

    force: np.ndarray
    pull: Pull
    lever: np.ndarray
    strut_use: np.ndarray

    @property
    def strut(self) -> np.ndarray:
        """Largest compression (k,) kN/m."""
        return self.pull.strut


def resolve_covers(
    n: np.ndarray, m: np.ndarray, half: np.ndarray, levels: Levels
) -> tuple[Cover, Cover]:
    """The same for components that stand apart: bottom and top of k states.

    n, m (3, k) kN/m and kNm/m, half (k,) m of the thickness; k of any number of axes.
    """
    at_steel = half - levels.steel
    bottom = top = at_steel
    for _ in range(PASSES):
        below, above = (resolve_membrane(*one) for one in split_between_covers(n, m, bottom, top))
        bottom, top = (_find_lever(one, half, at_steel, levels) for one in (below, above))
    found = []
    forces = split_between_covers(n, m, bottom, top)
    for force, lever in zip(forces, (bottom, top), strict=True):
        pull = resolve_membrane(*force)
        strength = np.where(pull.cracked, levels.strut_strength, levels.strength)
        found.append(Cover(force, pull, lever, pull.strut / (half * strength)))
    return found[0], found[1]


def split_between_covers(
    n: np.ndarray, m: np.ndarray, bottom: np.ndarray, top: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """n_bottom = (z_top n + m) / z, n_top = (z_bottom n - m) / z, with z = z_bottom + z_top.

    n, m (3, k) kN/m and kNm/m, levers `bottom` and `top` (k,) m; returns two (3, k) kN/m.
    """
    total = 1 / (bottom + top)
    turned = m * total
    return n * (top * total) + turned, n * (bottom * total) - turned


def _find_lever(found: Pull, half: np.ndarray, at_steel: np.ndarray, levels: Levels) -> np.ndarray:
    """Return the lever (k,) m of a cover that needs what was found; `half` is t / 2."""
    depth = np.minimum(found.strut / levels.strength, 2 * DEPTH_MOST * half)
    return np.where(found.cracked, at_steel, half - depth / 2)
