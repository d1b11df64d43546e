"""Shear of a plate without and with links, EN 1992-1-1:2004 6.2 and EN 1992-2:2005 Annex LL.

kN, m, kPa; tension positive, so the code's compressive sigma_cp is minus the membrane stress.
Arrays (k,) may have any number of axes.
"""

import numpy as np

MPA = 1e3
K1 = 0.15
"""k_1 of equation 6.2, recommended value."""
RATIO_MAX = 0.02
"""Largest rho_l in equation 6.2."""


def principal_shear(shear: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """v_0 = sqrt(v_x^2 + v_y^2) and its direction as (cos, sin): (k,) kN/m and (..., 2).

    shear (..., 2) kN/m. EN 1992-2:2005 Annex LL (LL.121, LL.122).
    """
    size = np.hypot(shear[..., 0], shear[..., 1])
    safe = np.where(size > 0, size, 1.0)[..., None]
    direction = np.where(size[..., None] > 0, shear / safe, [1.0, 0.0])
    return size, direction


def along_direction(force: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """n_a = n_x cos^2 + n_y sin^2 + 2 n_xy sin cos (k,) kN/m.

    force (..., 3) kN/m, direction (..., 2).
    """
    cos, sin = direction[..., 0], direction[..., 1]
    return force[..., 0] * cos**2 + force[..., 1] * sin**2 + 2 * force[..., 2] * sin * cos


def ratio_along(ratio: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """rho_l = rho_x cos^2 + rho_y sin^2 (k,); ratio (..., 2). EN 1992-2:2005 (LL.123)."""
    return ratio[..., 0] * direction[..., 0] ** 2 + ratio[..., 1] * direction[..., 1] ** 2


def resistance_without_links(
    depth: np.ndarray,
    ratio: np.ndarray,
    stress: np.ndarray,
    fck: float,
    fcd: float,
    gamma_c: float = 1.5,
) -> np.ndarray:
    """v_Rd,c = (max(C k (100 rho f_ck)^(1/3), v_min) + k_1 sigma_cp) d, at least 0; (k,) kN/m.

    C = 0.18 / gamma_c, k = 1 + sqrt(200 / d) <= 2 with d in mm, v_min = 0.035 k^1.5 f_ck^0.5,
    k_1 = 0.15, sigma_cp < 0.2 f_cd: membrane tension lowers it.

    Parameters
    ----------
    depth : (k,) d in m
    ratio : (k,) rho_l of the bars in tension, taken as 0.02 at most
    stress : (k,) kPa of the membrane, tension positive
    fck, fcd : kPa

    EN 1992-1-1:2004 6.2.2 (6.2a, 6.2b, 6.3N).
    """
    return stress_without_links(depth, ratio, stress, fck, fcd, gamma_c, K1) * depth


def stress_without_links(depth, ratio, stress, fck, fcd, gamma_c, k1) -> np.ndarray:
    """Return v_Rd,c (k,) kPa of 6.2.2 or, with k_1 = 0.1, of 6.4.4; see there for shapes."""
    size = np.minimum(1 + np.sqrt(0.2 / np.asarray(depth)), 2.0)
    fraction = np.clip(ratio, 0.0, RATIO_MAX)
    bars = 0.18 / gamma_c * size * np.cbrt(100 * fraction * fck / MPA)
    least = 0.035 * size**1.5 * np.sqrt(fck / MPA)
    pressed = np.minimum(-np.asarray(stress), 0.2 * fcd)
    return (np.maximum(bars, least) * MPA + k1 * pressed).clip(min=0.0)


def forces_of_links(shear: np.ndarray, cot_theta: float) -> np.ndarray:
    """n_ij = v_i v_j cot(theta) / v_0 (..., 3) kN/m as xx, yy, xy: what shear with links pulls.

    Half of it goes to each cover. shear (..., 2) kN/m. EN 1992-2:2005 Annex LL (LL.127 on).
    """
    size, direction = principal_shear(shear)
    x, y = direction[..., 0], direction[..., 1]
    return (size * cot_theta)[..., None] * np.stack([x * x, y * y, x * y], axis=-1)


def links_per_area(
    shear: np.ndarray, lever: np.ndarray, fyd: float, cot_theta: float
) -> np.ndarray:
    """a_sw = v_0 / (z f_ywd cot(theta)) (k,) m2 of links per m2 of shell.

    shear (k,) v_0 in kN/m, lever (k,) z in m, fyd kPa. EN 1992-1-1:2004 6.2.3 (6.8).
    """
    return shear / (lever * fyd * cot_theta)


def resistance_of_struts(
    lever: np.ndarray, stress: np.ndarray, fck: float, fcd: float, cot_theta: float
) -> np.ndarray:
    """v_Rd,max = alpha_cw z nu_1 f_cd / (cot(theta) + tan(theta)) (k,) kN/m.

    nu_1 = 0.6 (1 - f_ck / 250); alpha_cw = 1 in tension, 1 + s / f_cd up to s = 0.25 f_cd, 1.25 up
    to 0.5 f_cd, 2.5 (1 - s / f_cd) beyond.

    lever (k,) m, stress (k,) kPa of the membrane, tension positive; EN 1992-1-1:2004 6.2.3
    (6.9, 6.11N).
    """
    pressed = np.clip(-np.asarray(stress) / fcd, 0.0, 1.0)
    alpha = np.interp(pressed, [0, 0.25, 0.5, 1.0], [1.0, 1.25, 1.25, 0.0])
    nu = 0.6 * (1 - fck / MPA / 250)
    return alpha * lever * nu * fcd / (cot_theta + 1 / cot_theta)
