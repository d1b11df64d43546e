"""Reinforcement of cracked concrete, on this code's own moments: EN 1992-1-1 Annex F on two covers.

Written from the code's text for this package alone. Forces in kN/m, moments in kNm/m, tension
positive; a positive moment here is tension at the bottom. Bars run along x and y of a panel.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Bars:
    """What lies in a sheet: `level` m from a face to the middle of crossing bars, `two_from` m of
    thickness from which there are two layers, `mesh_lever` of one mesh over the thickness, `yield_`
    and `crush` kPa, `density` kg/m3."""

    level: float = 0.021
    two_from: float = 0.054
    mesh_lever: float = 0.45
    yield_: float = 500e3 / 1.15
    crush: float = 25e3 / 1.5
    density: float = 7850.0


def reinforce_membrane(nx: np.ndarray, ny: np.ndarray, nxy: np.ndarray) -> tuple:
    """Forces of bars along x and y and of the strut, (k,) kN/m each, of a membrane (k,) kN/m.

    With tan(a) = |n_xy| / max(|n_xy|, -n of the more compressed direction), bars carry
    n + |n_xy| tan(a) and n + |n_xy| / tan(a).
    """
    shear = np.abs(nxy)
    least = np.minimum(nx, ny)
    steep = np.maximum(shear, -least)
    slope = np.divide(shear, steep, out=np.ones_like(shear), where=steep > 0)
    add = np.divide(shear, slope, out=np.zeros_like(shear), where=slope > 0)
    along_x = np.where(nx <= ny, nx + add, nx + shear * slope)
    along_y = np.where(nx <= ny, ny + shear * slope, ny + add)
    middle, radius = (nx + ny) / 2, np.sqrt(((nx - ny) / 2) ** 2 + nxy**2)
    pressed = middle + radius <= 0
    strut = np.where(pressed, radius - middle, add + shear * slope)
    fx, fy = (np.where(pressed, 0.0, np.maximum(one, 0.0)) for one in (along_x, along_y))
    return fx, fy, strut


def reinforce_two_layers(n: np.ndarray, m: np.ndarray, t: np.ndarray, bars: Bars) -> np.ndarray:
    """Forces of bars (k, 4) kN/m, bottom x, y, top x, y; n, m (k, 3), t (k,) m."""
    low = high = t / 2 - bars.level
    for again in (True, True, True, False):
        total = (low + high)[:, None]
        bottom = reinforce_membrane(*((n * high[:, None] + m) / total).T)
        top = reinforce_membrane(*((n * low[:, None] - m) / total).T)
        if again:
            low, high = (_place(found, t, bars) for found in (bottom, top))
    return np.stack([bottom[0], bottom[1], top[0], top[1]], axis=1)


def _place(found: tuple, t: np.ndarray, bars: Bars) -> np.ndarray:
    """Where a cover acts: at its bars, else at half the depth that it needs, from the middle; that
    depth is 0.98 t at most."""
    depth = np.minimum(found[2] / bars.crush, 0.98 * t)
    return np.where(found[0] + found[1] > 0, t / 2 - bars.level, (t - depth) / 2)


def reinforce_mesh(n: np.ndarray, m: np.ndarray, t: np.ndarray, bars: Bars) -> np.ndarray:
    """The same (k, 4) kN/m of one mesh in the middle, in the columns of the bottom; n, m (k, 3)."""
    bent = m / (bars.mesh_lever * t)[:, None]
    sides = [np.stack(reinforce_membrane(*(n + sign * bent).T)[:2], axis=1) for sign in (1, -1)]
    steel = np.maximum(*sides)
    return np.concatenate([steel, np.zeros_like(steel)], axis=1)


def reinforce(n: np.ndarray, m: np.ndarray, t: np.ndarray, bars: Bars) -> np.ndarray:
    """Two layers where they fit, else one mesh: (k, 4) kN/m; n, m (k, 3), t (k,) m."""
    steel, two = np.empty((len(t), 4)), t >= bars.two_from
    for chosen, design in ((two, reinforce_two_layers), (~two, reinforce_mesh)):
        if chosen.any():
            steel[chosen] = design(n[chosen], m[chosen], t[chosen], bars)
    return steel
