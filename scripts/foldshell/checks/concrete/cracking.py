"""Least steel and crack width, EN 1992-1-1:2004 7.3.2 and 7.3.4; kN, m, kPa.

Arrays (k,) may have any number of axes.
"""

import numpy as np

K3, K4 = 3.4, 0.425
"""Of equation 7.11, recommended values."""
BOND = 0.8
"""k_1 of equation 7.11: ribbed bars."""
LONG = 0.4
"""k_t of equation 7.9 for lasting loads (0.6 for short ones)."""
TENSION, BENDING = 1.0, 0.5
"""k_2 of equation 7.11: strains of one sign through the section, or bending."""


def least_steel_area(thickness: np.ndarray, fct: float, stress: float) -> np.ndarray:
    """A_s,min = k_c k f_ct,eff A_ct / sigma_s (k,) m2/m of one direction, all layers together.

    k_c = 1 (pure tension); k = 1 up to 300 mm, 0.65 from 800 mm, linear between.

    Parameters
    ----------
    thickness : (k,) m
    fct, stress : kPa, strength of the concrete when it cracks and of the steel after

    EN 1992-1-1:2004 7.3.2 (7.1).
    """
    k = np.interp(thickness, [0.3, 0.8], [1.0, 0.65])
    return k * fct * thickness / stress


def effective_depth_in_tension(
    thickness: np.ndarray, steel_distance: np.ndarray, compressed: np.ndarray | float = 0.0
) -> np.ndarray:
    """h_c,ef = min(2.5 (h - d), (h - x) / 3, h / 2) (k,) m, 7.3.2 (3); x = 0 has no second bound.

    thickness h, steel_distance h - d and compressed x (k,) m.
    """
    depth = np.minimum(2.5 * np.asarray(steel_distance), np.asarray(thickness) / 2)
    bent = (np.asarray(thickness) - compressed) / 3
    return np.where(np.asarray(compressed) > 0, np.minimum(depth, bent), depth)


def mean_strain(
    stress: np.ndarray, ratio: np.ndarray, fct: float, es: float, ecm: float, kt: float = LONG
) -> np.ndarray:
    """eps_sm - eps_cm = (s - k_t f_ct (1 + alpha_e rho) / rho) / E_s, at least 0.6 s / E_s.

    stress (k,) kPa of the steel in the crack, ratio (k,) rho_p,eff; returns (k,) without unit.
    EN 1992-1-1:2004 7.3.4 (7.9).
    """
    stiffened = stress - kt * fct / ratio * (1 + es / ecm * ratio)
    return np.maximum(stiffened, 0.6 * stress) / es


def largest_spacing(
    cover: np.ndarray, diameter: float, ratio: np.ndarray, k2: float = TENSION
) -> np.ndarray:
    """s_r,max = k_3 c + k_1 k_2 k_4 phi / rho_p,eff (k,) m, 7.3.4 (7.11); cover, diameter m."""
    return K3 * cover + BOND * k2 * K4 * diameter / ratio


def inclined_spacing(spacing: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """s_r,max = 1 / (cos a / s_x + sin a / s_y) (k,) m, 7.3.4 (7.15): cracks across both bars.

    spacing (..., 2) m along the bars of x and y; angle (k,) rad, 0 to pi/2, between the bars of x
    and the principal tension.
    """
    return 1 / (np.cos(angle) / spacing[..., 0] + np.sin(angle) / spacing[..., 1])


def crack_width(
    stress: np.ndarray,
    ratio: np.ndarray,
    cover: np.ndarray,
    diameter: float,
    fct: float,
    es: float,
    ecm: float,
    k2: float = TENSION,
    kt: float = LONG,
) -> np.ndarray:
    """w_k = s_r,max (eps_sm - eps_cm) (k,) m, EN 1992-1-1:2004 7.3.4 (7.8).

    stress (k,) kPa, ratio (k,) rho_p,eff, cover (k,) m, diameter m.
    """
    return largest_spacing(cover, diameter, ratio, k2) * mean_strain(
        stress, ratio, fct, es, ecm, kt
    )
