"""The course of a sizing loop as inline SVG: one panel per quantity over the iterations."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from foldshell.report.markup import render
from foldshell.results.colour_scales import find_ticks, format_tick

WIDTH, HEIGHT, LEFT, RIGHT, TOP, GAP = 620, 128, 58, 100, 22, 14
NUMBERS_MAX = 12


@dataclass(frozen=True)
class Series:
    """A quantity over the iterations: title with unit, values (None: unknown), limits by name."""

    title: str
    values: Sequence[float | None]
    limits: Mapping[str, float]


@dataclass(frozen=True)
class Panel:
    """Where things stand in one panel, in units of the SVG; ticks and limits with their words."""

    title: str
    top: float
    ticks: Sequence[tuple[float, str]] = ()
    limits: Sequence[tuple[float, str]] = ()
    points: Sequence[tuple[float, float]] = ()


def draw_history(series: Sequence[Series]) -> Markup:
    """Return one SVG with a panel each; limits are dashed and named."""
    count = max((len(one.values) for one in series), default=0)
    panels = [_place_panel(one, count, k * (HEIGHT + GAP)) for k, one in enumerate(series)]
    step = max(1, math.ceil(count / NUMBERS_MAX))
    numbers = [(_across(k, count), k) for k in range(0, count, step)]
    height = len(series) * (HEIGHT + GAP)
    return render("history.svg", panels=panels, numbers=numbers, width=WIDTH, height=height + 30,
                  left=LEFT, right=WIDTH - RIGHT, base=height - GAP)  # fmt: skip


def _across(number: int, count: int) -> float:
    """Return the place of an iteration across the chart."""
    return round(LEFT + (WIDTH - RIGHT - LEFT) * number / max(count - 1, 1), 1)


def _place_panel(one: Series, count: int, top: float) -> Panel:
    known = [v for v in one.values if v is not None and math.isfinite(v)]
    if not known:
        return Panel(one.title, top)
    shown = {name: limit for name, limit in one.limits.items()
             if limit <= 3 * max(known) or max(known) == 0}  # fmt: skip
    high = 1.06 * max([*known, *shown.values()]) or 1.0

    def down(value: float) -> float:
        """Place of a value down the chart."""
        return round(top + HEIGHT - (HEIGHT - TOP) * value / high, 1)

    ticks = find_ticks(0.0, high, 4)
    step = ticks[1] - ticks[0] if len(ticks) > 1 else high
    return Panel(
        one.title,
        top,
        [(down(tick), format_tick(tick, step)) for tick in ticks],
        [(down(limit), name) for name, limit in shown.items()],
        [(_across(k, count), down(v)) for k, v in enumerate(one.values)
         if v is not None and math.isfinite(v)],
    )  # fmt: skip
