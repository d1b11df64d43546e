"""Rows of the load table for wind and snow on vaults and domes, and for live load on half a span.

Lengths in m, pressures in kN/m2; the middle of the plan is the origin. Wind and snow go along x,
over a crown that runs along y, unless `axis` says "y". What the sources are, and what of them could
not be checked against the printed codes, stands in docs/loads.md.
"""

from collections.abc import Sequence

import numpy as np

from foldshell.settings.load_rows import PRESSURE, LoadRow

FAR = 10
"""Zones reach so many spans to the sides."""

STEEPEST = np.tan(np.radians(60))
"""Slope beyond which no snow lies on a vault (EN 1991-1-3, 5.3.5)."""

_STEPS = 16


def vault_pressure_coefficients(rise: float, span: float, wall: float) -> tuple[float, ...]:
    """c_pe,10 of zones A, B, C of a vaulted roof, as of EN 1991-1-4, Figure 7.11.

    A = 1.6 f/d at h/d = 0 and (f/d - 0.2) / 0.375 from h/d = 0.5 on, linear between;
    B = -(0.7 + f/d); C = -0.4. Lines fitted to one published example, not the figure itself.

    rise f, span d, wall h: height of the springing above the ground, m.

    Raises
    ------
    ValueError
        for f/d outside of 0.2 to 0.5, where the fit does not hold.
    """
    slender, tall = rise / span, min(wall / span, 0.5)
    if not 0.2 <= slender <= 0.5:
        raise ValueError(f"rise over span {slender:.3g}: 0.2 to 0.5 is allowed")
    low, high = 1.6 * slender, (slender - 0.2) / 0.375
    return low + (high - low) * tall / 0.5, -(0.7 + slender), -0.4


def quarter_points(rise: float, span: float) -> np.ndarray:
    """Return the places (5,) m along the span that quarter the developed length of a parabola."""
    x = np.linspace(-span / 2, span / 2, 20001)
    slope = np.hypot(1, 8 * rise * x / span**2)
    length = np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(x))])
    return np.interp(np.linspace(0, 1, 5) * length[-1], length, x)


def make_vault_wind(
    name: str, rise: float, span: float, wall: float, pressure: float, axis: str = "x"
) -> list[LoadRow]:
    """Return wind across a vault from either side: quarters of the developed length A, B, B, C.

    pressure : peak velocity pressure q_p, kN/m2; name : of the cases, with P and M for the wind
    along the axis and against it. Internal pressure is not among them.
    """
    windward, middle, lee = vault_pressure_coefficients(rise, span, wall)
    cuts = quarter_points(rise, span)
    far = FAR * span
    edges = [-far, cuts[1], cuts[3], far]
    rows = []
    for suffix, values in (("P", (windward, middle, lee)), ("M", (lee, middle, windward))):
        rows += [
            _pressure(f"{name}{suffix}", pressure * value, "-normal", "sheet",
                      _strip(low, high, far, axis), "", "wind")
            for low, high, value in zip(edges[:-1], edges[1:], values, strict=True)
        ]  # fmt: skip
    return rows


def make_dome_wind(
    name: str, rise: float, diameter: float, pressure: float, coefficients: Sequence[float],
    axis: str = "x",
) -> list[LoadRow]:  # fmt: skip
    """Return wind over a dome along an axis and against it (EN 1991-1-4, Figure 7.12).

    c_pe is constant on planes across the wind, and linear along the arc through the crown between A
    (windward springing), B (crown) and C (leeward). `coefficients` (3,) are those of A, B, C, to be
    read from the figure for f/d and h/d.
    """
    radius = (diameter**2 / 4 + rise**2) / (2 * rise)
    most = np.arcsin(min(diameter / 2 / radius, 1.0))
    most = np.pi - most if rise > radius else most
    angle = np.linspace(-min(most, np.pi / 2), min(most, np.pi / 2), 2 * _STEPS + 1)
    value = np.interp(angle, [-most, 0, most], coefficients)
    rows = []
    for suffix, factors in (("P", value), ("M", value[::-1])):
        pairs = zip(radius * np.sin(angle), factors, strict=True)
        variation = f"{axis} " + ", ".join(f"{place:.9g}:{factor:.9g}" for place, factor in pairs)
        rows.append(
            _pressure(f"{name}{suffix}", pressure, "-normal", "sheet", "all", variation, "wind")
        )
    return rows


def make_vault_snow(
    name: str, rise: float, span: float, snow: float, axis: str = "x"
) -> list[LoadRow]:
    """Return snow on a vault: 0.8 s evenly, and drifted to either side (EN 1991-1-3, 5.3.5).

    Where the vault rises by 60 degrees at most: case (i) 0.8, case (ii) triangles of 0.5 mu_3 and
    mu_3 with their peaks at the quarters, mu_3 = 0.2 + 10 h/b <= 2. snow : C_e C_t s_k, kN/m2. Snow
    lies on what faces up, by plan.
    """
    steep = min(span / 2, STEEPEST * span**2 / (8 * rise))
    drift = min(2.0, 0.2 + 10 * rise / span)
    far = FAR * span
    zone = "all" if steep == span / 2 else _strip(-steep, steep, far, axis)
    rows = [_pressure(name, 0.8 * snow, "-z", "plan_up", zone, "", "snow")]
    places = steep * np.array([-1, -0.5, 0, 0.5, 1])
    right = np.array([0, 0.5, 0, 1, 0]) * drift
    for suffix, factors in (("P", right), ("M", right[::-1])):
        pairs = zip(places, factors, strict=True)
        variation = f"{axis} " + ", ".join(f"{place:.9g}:{factor:.9g}" for place, factor in pairs)
        rows.append(_pressure(f"{name}_{suffix}", snow, "-z", "plan_up", "all", variation, "snow"))
    return rows


def make_half_span(name: str, live: float, area: str = "plan_up", axis: str = "x") -> list[LoadRow]:
    """Return live load on all of the sheet, and on either side of the crown; kN/m2."""
    sides = (("", "all"), ("_M", f"side {axis}-"), ("_P", f"side {axis}+"))
    return [_pressure(name + end, live, "-z", area, zone, "", "imposed") for end, zone in sides]


def _strip(low: float, high: float, far: float, axis: str) -> str:
    corners = (low, -far, high, far) if axis == "x" else (-far, low, far, high)
    return "box " + " ".join(f"{value:.9g}" for value in corners)


def _pressure(
    case: str, value: float, direction: str, area: str, zone: str, variation: str, action: str
) -> LoadRow:
    value = float(f"{value:.9g}")
    return LoadRow(case, PRESSURE, value, direction, area, zone, variation, "given", action)
