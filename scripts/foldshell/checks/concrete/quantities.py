"""Masses, emissions and cost of a reinforced shell."""

from dataclasses import dataclass

import numpy as np

from foldshell.settings.reinforcement import Co2, Prices


@dataclass(frozen=True)
class Quantities:
    """What a shell takes: `concrete` m3, `steel` kg, `creases` m, `area` m2; `textile` says that
    its steel are grids."""

    concrete: float
    steel: float
    creases: float
    area: float
    textile: bool = False


def sum_steel(area: np.ndarray, panel_area: np.ndarray, density: float) -> float:
    """M = density sum of a_s A over panels, layers and directions, kg.

    area (P, 2, 2) m2/m, panel_area (P,) m2, density kg/m3.
    """
    return float(density * (area.sum(axis=(1, 2)) @ panel_area))


def sum_emissions(found: Quantities, co2: Co2) -> tuple[float, float, float]:
    """Return kg of CO2 equivalent: as set, at the lower and at the upper end of both factors."""
    creases = found.creases * co2.crease_kg_m
    concretes = co2.concrete_kg_m3, co2.concrete_low_kg_m3, co2.concrete_high_kg_m3
    bars = co2.steel_kg_kg, co2.steel_low_kg_kg, co2.steel_high_kg_kg
    grids = co2.grid_kg_kg, co2.grid_low_kg_kg, co2.grid_high_kg_kg
    pairs = zip(concretes, grids if found.textile else bars, strict=True)
    middle, low, high = (a * found.concrete + b * found.steel + creases for a, b in pairs)
    return middle, low, high


def sum_cost(found: Quantities, prices: Prices) -> tuple[float, float, float] | None:
    """Return cost with its range, None where no price is given."""
    steel = prices.grid_kg if found.textile else prices.steel_kg
    if not (prices.concrete_m3 or steel or prices.crease_m):
        return None
    total = (
        prices.concrete_m3 * found.concrete + steel * found.steel + prices.crease_m * found.creases
    )
    return total, total * (1 - prices.range_share), total * (1 + prices.range_share)
