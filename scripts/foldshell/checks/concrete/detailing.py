"""Cover by exposure, bars that fit, ratio of steel; EN 1992-1-1:2004 4.4.1, 8.2, 9.3.1; m.

Arrays (k,) may have any number of axes.
"""

import numpy as np

EXPOSURES = ("X0", "XC1", "XC2", "XC3", "XC4", "XD1", "XD2", "XD3", "XS1", "XS2", "XS3")
CLASSES = ("S1", "S2", "S3", "S4", "S5", "S6")
_COLUMN = dict(
    X0=0, XC1=1, XC2=2, XC3=2, XC4=3, XD1=4, XS1=4, XD2=5, XS2=5, XD3=6, XS3=6
)  # fmt: skip
_DURABLE_MM = np.array(
    [
        [10, 10, 10, 15, 20, 25, 30],
        [10, 10, 15, 20, 25, 30, 35],
        [10, 10, 20, 25, 30, 35, 40],
        [10, 15, 25, 30, 35, 40, 45],
        [15, 20, 30, 35, 40, 45, 50],
        [20, 25, 35, 40, 45, 50, 55],
    ]
)
"""c_min,dur of Table 4.4N, structural classes S1 to S6 down, exposure across."""
LEAST_MM = 10
CRACK_MM = {"X0": 0.4, "XC1": 0.4}
"""w_max of Table 7.1N under quasi-permanent loads where it is not 0.3 mm."""


def least_cover(
    exposure: str, structural_class: str, diameter: float, deviation: float = 0.0
) -> float:
    """c_nom = max(c_min,b, c_min,dur, 10 mm) + dc_dev in m; c_min,b is the diameter.

    EN 1992-1-1:2004 4.4.1.1 (4.1), 4.4.1.2 (4.2), Tables 4.2 and 4.4N. dc_dev is 10 mm (4.4.1.3
    (1)), less down to 0 where precast elements are measured and rejected (4.4.1.3 (3)).
    """
    row, column = CLASSES.index(structural_class), _COLUMN[exposure]
    return max(diameter, float(_DURABLE_MM[row, column]) / 1e3, LEAST_MM / 1e3) + deviation


def crack_limit(exposure: str) -> float:
    """w_max in m of Table 7.1N, quasi-permanent loads, bars without prestress."""
    return CRACK_MM.get(exposure, 0.3) / 1e3


def least_thickness_of_layers(cover: float, diameter: float, clear: float = 0.0) -> float:
    """t = 2 c + 4 d + clear: two layers of bars in two directions, `clear` between them; m."""
    return 2 * cover + 4 * diameter + clear


def least_clear_distance(diameter: float, aggregate: float) -> float:
    """max(phi, d_g + 5 mm, 20 mm) in m between bars, EN 1992-1-1:2004 8.2 (2)."""
    return max(diameter, aggregate + 0.005, 0.020)


def bar_spacing(area: np.ndarray, diameter: float) -> np.ndarray:
    """s = (pi d^2 / 4) / a_s (k,) m of bars of one diameter; inf where there are none.

    area (k,) m2/m.
    """
    with np.errstate(divide="ignore"):
        return np.pi * diameter**2 / 4 / np.asarray(area, dtype=float)


def largest_bar_spacing(thickness: np.ndarray) -> np.ndarray:
    """s_max,slabs = min(2 h, 250 mm) (k,) m, EN 1992-1-1:2004 9.3.1.1 (3), at concentrated loads.

    thickness (k,) m.
    """
    return np.minimum(2 * np.asarray(thickness), 0.25)
