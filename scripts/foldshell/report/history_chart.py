"""The course of a sizing loop as inline SVG: one panel a quantity over the iterations."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from foldshell.report.markup import escape
from foldshell.results.colour_scales import find_ticks, format_tick

WIDTH, HEIGHT, LEFT, RIGHT, TOP, GAP = 620, 128, 58, 100, 22, 14
INK, SOFT, CURVE, LIMIT = "#1c1c1c", "#d4d4d4", "#00518a", "#be0028"


@dataclass(frozen=True)
class Series:
    """A quantity over the iterations: title with unit, values (None: unknown), limits by name."""

    title: str
    values: Sequence[float | None]
    limits: Mapping[str, float]


def draw_history(series: Sequence[Series]) -> str:
    """Return one SVG with a panel each; limits are dashed and named, the last value is written."""
    count = max((len(one.values) for one in series), default=0)
    parts = [
        _draw_panel(one, count, k * (HEIGHT + GAP), k == len(series) - 1)
        for k, one in enumerate(series)
    ]
    height = len(series) * (HEIGHT + GAP) + 30
    return (
        f'<svg class="chart" viewBox="0 0 {WIDTH} {height}" role="img" '
        f'aria-label="history of the sizing loop" font-size="12.5" fill="{INK}">'
        f"{''.join(parts)}</svg>"
    )


def _draw_panel(one: Series, count: int, top: float, last: bool) -> str:
    known = [v for v in one.values if v is not None and math.isfinite(v)]
    base, right = top + HEIGHT, WIDTH - RIGHT
    parts = [f'<text x="{LEFT}" y="{top + 13}" font-weight="600">{escape(one.title)}</text>']
    if not known:
        words = f'<text x="{LEFT + 8}" y="{top + 60}">no values</text>'
        return "".join([*parts, words])
    shown = [limit for limit in one.limits.values() if limit <= 3 * max(known) or max(known) == 0]
    high = 1.06 * max([*known, *shown]) or 1.0

    def x(number: float) -> float:
        """Place of an iteration across the chart."""
        return LEFT + (right - LEFT) * (number / max(count - 1, 1))

    def y(value: float) -> float:
        """Place of a value down the chart."""
        return base - (base - top - TOP) * value / high

    parts += _draw_grid(high, y, right)
    for name, limit in one.limits.items():
        if limit in shown:
            parts.append(_line(LEFT, y(limit), right, y(limit), LIMIT, 'stroke-dasharray="6 4"'))
            parts.append(f'<text x="{right + 6}" y="{y(limit) + 4:.1f}" fill="{LIMIT}">'
                         f"{escape(name)}</text>")  # fmt: skip
    points = [(x(k), y(v)) for k, v in enumerate(one.values) if v is not None]
    path = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
    parts.append(f'<polyline points="{path}" fill="none" stroke="{CURVE}" stroke-width="2"/>')
    parts += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.6" fill="{CURVE}"/>' for a, b in points]
    return "".join([*parts, *_draw_numbers(count, x, base, last)])


def _draw_grid(high: float, y, right: float) -> list[str]:
    ticks = find_ticks(0.0, high, 4)
    step = ticks[1] - ticks[0] if len(ticks) > 1 else high
    parts = []
    for tick in ticks:
        parts.append(_line(LEFT, y(tick), right, y(tick), SOFT))
        parts.append(f'<text x="{LEFT - 7}" y="{y(tick) + 4:.1f}" text-anchor="end">'
                     f"{format_tick(tick, step)}</text>")  # fmt: skip
    return parts


def _draw_numbers(count: int, x, base: float, last: bool) -> list[str]:
    """Return the numbers of iterations below the lowest panel."""
    if not last:
        return []
    step = max(1, math.ceil(count / 12))
    parts = [
        f'<text x="{x(k):.1f}" y="{base + 16}" text-anchor="middle">{k}</text>'
        for k in range(0, count, step)
    ]
    return [*parts, f'<text x="{WIDTH - RIGHT + 12}" y="{base + 16}">iteration</text>']


def _line(x1: float, y1: float, x2: float, y2: float, colour: str, more: str = "") -> str:
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
            f'stroke="{colour}" {more}/>')  # fmt: skip
