"""Strengths of concrete and bars, EN 1992-1-1:2004 section 3; kPa."""

from dataclasses import dataclass

import numpy as np

MPA = 1e3
FCK_RANGE = (12.0, 90.0)
"""f_ck in MPa of Table 3.1."""
FYK_RANGE = (400.0, 600.0)
"""f_yk in MPa to which the code applies, 3.2.2 (3)."""
NORMAL_TO = 50.0
"""f_ck in MPa up to which f_ctm = 0.3 f_ck^(2/3), Table 3.1."""


@dataclass(frozen=True)
class Strengths:
    """Strengths in kPa, moduli in kPa.

    `fck`, `fcd`, `strut` (nu f_cd), `fctm`, `fctd` of concrete; `fyk`, `fyd` of the bars; `ecm`,
    `es` moduli.
    """

    fck: float
    fcd: float
    strut: float
    fctm: float
    fctd: float
    fyk: float
    fyd: float
    ecm: float
    es: float


def find_strengths(
    fck: float,
    fyk: float,
    gamma_c: float = 1.5,
    gamma_s: float = 1.15,
    alpha_cc: float = 1.0,
    es: float = 200e6,
) -> Strengths:
    """f_cd = alpha_cc f_ck / gamma_c, nu = 0.6 (1 - f_ck / 250), f_ctd = 0.7 f_ctm / gamma_c.

    Parameters
    ----------
    fck, fyk, es : kPa

    EN 1992-1-1:2004 3.1.6 (3.15, 3.16), F.1 (4) with 6.2.2 (6.6N), Table 3.1.
    """
    mpa = fck / MPA
    fctm = tension_strength(fck)
    fcd = alpha_cc * fck / gamma_c
    nu = 0.6 * (1 - mpa / 250)
    ecm = 22e6 * ((mpa + 8) / 10) ** 0.3
    return Strengths(fck, fcd, nu * fcd, fctm, 0.7 * fctm / gamma_c, fyk, fyk / gamma_s, ecm, es)


def tension_strength(fck: float) -> float:
    """f_ctm = 0.30 f_ck^(2/3) up to C50/60, above 2.12 ln(1 + f_cm / 10); kPa in and out.

    EN 1992-1-1:2004 Table 3.1.
    """
    mpa = fck / MPA
    if mpa <= NORMAL_TO:
        return float(0.30 * mpa ** (2 / 3) * MPA)
    return float(2.12 * np.log(1 + (mpa + 8) / 10) * MPA)


def refuse_strength(fck: float, fyk: float, kind: str) -> str:
    """Return a sentence where the code does not hold for a strength (kPa), else nothing."""
    low, high = FCK_RANGE
    if not low <= fck / MPA <= high:
        return f"fck of {fck / MPA:g} MPa is outside {low:g} to {high:g} MPa of EN 1992-1-1 3.1.2"
    low, high = FYK_RANGE
    if kind != "textile" and not low <= fyk / MPA <= high:
        return f"fyk of {fyk / MPA:g} MPa is outside {low:g} to {high:g} MPa of EN 1992-1-1 3.2.2"
    return ""
