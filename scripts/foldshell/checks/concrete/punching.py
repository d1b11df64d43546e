"""Punching at fold vertices, EN 1992-1-1:2004 6.4; kN, m, kPa; tension positive.

Arrays (k,) may have any number of axes.
"""

import numpy as np

from foldshell.checks.concrete.shear import stress_without_links

K1 = 0.1
"""k_1 of equation 6.47, recommended value."""
PERIMETER = 2.0
"""Distance of the basic control perimeter in effective depths, 6.4.2 (1)."""


def punching_resistance(
    depth: np.ndarray,
    ratio: np.ndarray,
    stress: np.ndarray,
    fck: float,
    fcd: float,
    gamma_c: float = 1.5,
) -> np.ndarray:
    """v_Rd,c = (max(C k (100 rho f_ck)^(1/3), v_min) + k_1 sigma_cp) d (k,) kN/m of perimeter.

    rho = sqrt(rho_x rho_y) <= 0.02; sigma_cp the mean of both directions.

    depth (k,) m, ratio (..., 2), stress (..., 2) kPa of the membrane. EN 1992-1-1:2004 6.4.4
    (6.47).
    """
    both = np.sqrt(np.clip(ratio[..., 0] * ratio[..., 1], 0, None))
    mean = stress.mean(axis=-1)
    return stress_without_links(depth, both, mean, fck, fcd, gamma_c, K1) * depth


def face_resistance(depth: np.ndarray, fck: float, fcd: float) -> np.ndarray:
    """v_Rd,max = 0.4 nu f_cd d (k,) kN/m at the face, 6.4.5 (6.53 as corrected in 2014)."""
    return 0.4 * 0.6 * (1 - fck / 1e3 / 250) * fcd * depth
