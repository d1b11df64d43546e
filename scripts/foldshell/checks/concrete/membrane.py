"""Steel and concrete of a cracked membrane, EN 1992-1-1:2004 Annex F; tension positive."""

from dataclasses import dataclass

import numpy as np

ROUND_OFF = 1e-10
"""Tension over compression up to which a membrane counts as compressed in all directions."""


@dataclass(frozen=True)
class MembraneDesign:
    """What a membrane needs; all in the unit of the forces it was found for.

    Attributes
    ----------
    steel : (..., 2) forces of the bars along x and y, none below zero
    strut : (...) largest principal compression of the concrete, none below zero
    cracked : (...) bool, whether the concrete is cracked, so that its strut has the strength
        nu f_cd (F.1 (4)) and not f_cd
    """

    steel: np.ndarray
    strut: np.ndarray
    cracked: np.ndarray


def design_membrane(force: np.ndarray) -> MembraneDesign:
    """f_x = |n_xy| + n_x, f_y = |n_xy| + n_y, strut 2 |n_xy|; with n_x < -|n_xy| f_x = 0,
    f_y = n_xy^2 / |n_x| + n_y, strut |n_x| (1 + (n_xy / n_x)^2).

    x is the direction with the more compressive force; the other order is exchanged. No steel
    where both forces are compressive and n_x n_y >= n_xy^2.

    Parameters
    ----------
    force : (..., 3) kN/m as xx, yy, xy

    EN 1992-1-1:2004 Annex F, F.1 (2) to (4), equations F.2 to F.7.
    """
    x, y, xy = np.moveaxis(np.asarray(force, dtype=float), -1, 0)
    pull = resolve_membrane(x, y, xy)
    return MembraneDesign(np.stack(pull.bars(x, y), axis=-1), pull.strut, pull.cracked)


@dataclass(frozen=True)
class Pull:
    """Of a membrane, all (k,): `first`, the force of the bars along the more compressed direction,
    `second`, that of the others; `strut`; `cracked` bool."""

    first: np.ndarray
    second: np.ndarray
    strut: np.ndarray
    cracked: np.ndarray

    def bars(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the forces (k,) kN/m of the bars along x and y; x, y (k,) those of the membrane.

        EN 1992-1-1:2004 Annex F, F.1 (2): the other order is exchanged.
        """
        exchanged = x > y
        return (
            np.where(exchanged, self.second, self.first),
            np.where(exchanged, self.first, self.second),
        )


def resolve_membrane(x: np.ndarray, y: np.ndarray, xy: np.ndarray) -> Pull:
    """With s = max(|n_xy|, -n of the more compressed direction): the other bars carry
    n + n_xy^2 / s, the strut s + n_xy^2 / s, which is every case of Annex F; where those bars get
    nothing, all is compressed and the strut is the principal force.

    x, y, xy (k,) kN/m, of any number of axes.
    """
    shear = np.abs(xy)
    low, high = np.minimum(x, y), np.maximum(x, y)
    steep = np.maximum(shear, -low)
    add = shear * shear / np.where(steep > 0, steep, 1.0)
    second = high + add
    cracked = second > ROUND_OFF * steep
    principal = np.sqrt(((high - low) / 2) ** 2 + shear**2) - (low + high) / 2
    strut = np.where(cracked, steep + add, principal)
    first = np.where(cracked, np.maximum(shear + low, 0.0), 0.0)
    return Pull(first, np.where(cracked, second, 0.0), strut, cracked)
