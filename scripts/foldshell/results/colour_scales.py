"""Colour scales that stay readable for the colour-blind and in grey, and round tick values."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foldshell.files.whole import Json

MISSING = (205, 205, 205)
ABOVE = (190, 0, 40)
TENSION = (230, 120, 0)
COMPRESSION = (0, 70, 150)
KNOTS = {
    "viridis": (
        "472a7a46337f443b844144873e4c8a3a548c365c8d33638d306a8e2d718e2a778e"
        "277e8e25848e228b8d20928c1f988b1f9f8820a48625ac822db27d37b87842be71"
        "50c46a5ec9626ece587fd34e90d743a2da37b5de2bc8e020dae319ece51bfde725"
    ),
    "cividis": (
        "0833701a386f273e6e31436d39486c404c6c47516c4f576c555c6d5c616e62656f"
        "696b716f70737575757b7a788280798985788f8a78958f779d9576a49b74aba072"
        "b3a670baac6dc2b369c9b965d1bf61d9c55ce1cc55e9d34ef1d945f9e03afee838"
    ),
    "YlGnBu": (
        "f9fdccf5fbc4f1fabbeef8b3e7f6b1dff2b2d6efb3ceecb3c4e8b4b4e2b6a5dcb7"
        "95d5b985cfba76cabc6bc6be5dc0c050bbc244b7c43bb0c333a7c22b9fc22397c1"
        "1d8ebf1e83ba1f78b4216daf2163aa2259a62350a124479d243d982534941f2f87"
    ),
}
"""Matplotlib's maps at 33 equal steps, less the ends that black lines and white paper are too near:
viridis from 0.12, cividis from 0.1, YlGnBu from 0.04 to 0.9."""


RATIO_RANGE_MIN = 0.01
"""Least range of the colours of planarity and strain, %."""
DISPLACED_SHARE = 0.06
"""The largest displacement is drawn about this share of the span long."""


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
        """Return (..., 3) uint8 of values (...); nan is grey. Values in the unit of the scale."""
        values = np.asarray(values, dtype=float)
        share = (values - self.low) / (self.high - self.low)
        finite = np.isfinite(share)
        row = np.clip(np.where(finite, share, 0) * 255, 0, 255).astype(int)
        colours = colour_table(self.map_name)[row]
        if self.limit is not None:
            colours[finite & (values > self.limit)] = ABOVE
        colours[~finite] = MISSING
        return colours

    def describe(self, count: int) -> Json:
        """Return range, limit, `count` colours (hexadecimal) and ticks as plain data."""
        ticks = find_ticks(self.low, self.high)
        step = ticks[1] - ticks[0] if len(ticks) > 1 else self.high - self.low
        values = np.linspace(self.low, self.high, count)
        colours = ColourScale(self.low, self.high, self.map_name).colour(values)
        return {
            "low": self.low,
            "high": self.high,
            "limit": self.limit,
            "colours": colours.tobytes().hex(),
            "ticks": [[tick, format_tick(tick, step)] for tick in ticks],
        }


@lru_cache
def colour_table(name: str) -> np.ndarray:
    """Return the 256 colours (256, 3) uint8 of a map in `KNOTS`."""
    knots = np.frombuffer(bytes.fromhex(KNOTS[name]), dtype=np.uint8).reshape(-1, 3)
    place = np.linspace(0, 255, len(knots)).round()
    rows = np.arange(256)
    channels = [np.interp(rows, place, knots[:, k]) for k in range(3)]
    return np.stack(channels, axis=1).round().astype(np.uint8)


def make_scale(
    values: np.ndarray, map_name: str = "viridis", zero: bool = False, least: float = 0.0
) -> ColourScale:
    """Return a scale between round numbers that holds all finite values; `zero` starts at 0.

    Its range is `least` or more, so that rounding errors about 0 do not look like a field.

    values (N,) or of other shape, in the unit that the scale then has.
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
    """Return a scale from 0 to `limit`, or to less than half of it where nothing comes near.

    values (N,) or of other shape, in the unit of the limit.
    """
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


def exaggeration(moved: np.ndarray, span: float) -> float:
    """Return a round factor that draws the largest of (N, 3) m at about 6 % of the span."""
    largest = float(np.linalg.norm(moved, axis=1).max())
    return round_step(DISPLACED_SHARE * span / largest) if largest > 0 else 1.0
