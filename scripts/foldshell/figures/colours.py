"""Colour scales that stay readable for the colour-blind and in grey, and round tick values."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

MISSING = (205, 205, 205)
ABOVE = (190, 0, 40)
TENSION = (230, 120, 0)
COMPRESSION = (0, 70, 150)
CUTS = {"viridis": (0.12, 1.0), "cividis": (0.1, 1.0), "YlGnBu": (0.04, 0.9)}
"""Shares of maps in use: black lines and the white paper stay apart from their colours."""


@dataclass(frozen=True)
class ColourScale:
    """A perceptually uniform map over [low, high]; values above `limit` get one strong colour.

    `limit` is None or equals `high`: lightness jumps there from the map's light end to a dark
    red, so the border shows in grey too.
    """

    low: float
    high: float
    map_name: str = "viridis"
    limit: float | None = None

    def colour(self, values: np.ndarray) -> np.ndarray:
        """Return (..., 3) uint8 of values (...); nan is grey."""
        values = np.asarray(values, dtype=float)
        share = (values - self.low) / (self.high - self.low)
        finite = np.isfinite(share)
        row = np.clip(np.where(finite, share, 0) * 255, 0, 255).astype(int)
        colours = colour_table(self.map_name)[row]
        if self.limit is not None:
            colours[finite & (values > self.limit)] = ABOVE
        colours[~finite] = MISSING
        return colours


@lru_cache
def colour_table(name: str) -> np.ndarray:
    """Return the 256 colours (256, 3) uint8 of a matplotlib map, less its darkest and lightest."""
    from matplotlib import colormaps

    share = np.linspace(*CUTS.get(name, (0.0, 1.0)), 256)
    return (colormaps[name](share)[:, :3] * 255).round().astype(np.uint8)


def make_scale(
    values: np.ndarray, map_name: str = "viridis", zero: bool = False, least: float = 0.0
) -> ColourScale:
    """Return a scale between round numbers that holds all finite values; `zero` starts at 0.

    Its range is `least` or more, so that rounding errors about 0 do not look like a field.
    """
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    low = min(low, 0.0) if zero else low
    high = max(high, low + least)
    if high - low <= 1e-9 * max(abs(high), abs(low), 1e-300):
        margin = 0.5 * abs(high) or 0.5
        low, high = (low if zero else low - margin), high + margin
    step = round_step((high - low) / 8)
    low, high = math.floor(low / step + 1e-9) * step, math.ceil(high / step - 1e-9) * step
    return ColourScale(low, high, map_name)


def make_limit_scale(values: np.ndarray, limit: float) -> ColourScale:
    """Return a scale from 0 to `limit`, or to less than half of it where nothing comes near."""
    finite = values[np.isfinite(values)]
    if finite.size and finite.max() < limit / 2:
        return make_scale(finite, zero=True)
    return ColourScale(0.0, limit, limit=limit)


def round_step(size: float) -> float:
    """Return the least of 1, 2, 2.5, 5 times a power of ten that is not below `size` > 0."""
    power = 10.0 ** math.floor(math.log10(size))
    return next(k * power for k in (1, 2, 2.5, 5, 10) if k * power >= size * (1 - 1e-9))


def find_ticks(low: float, high: float, count: int = 6) -> list[float]:
    """Return round values in [low, high], about `count` of them."""
    step = round_step((high - low) / count)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [float(f"{k * step:.12g}") for k in range(first, last + 1)]


def format_tick(value: float, step: float) -> str:
    """Write a tick with as many decimals as its step needs."""
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    if abs(step * 10**decimals - round(step * 10**decimals)) > 1e-6:
        decimals += 1
    return f"{value + 0.0:.{decimals}f}"
