"""Loads in words, for pages, workbooks and drawings."""

from foldshell.loads.cases import (
    AREA_WORDS,
    DOWN,
    FORCE,
    GLOBAL_X,
    GLOBAL_Y,
    LINE,
    PRESSURE,
    SETTLEMENT,
    TEMPERATURE,
    WEIGHT,
    SurfaceLoad,
)

DIRECTIONS = {
    None: ("against the normal of each facet", "normal"),
    DOWN: ("down", "down"),
    GLOBAL_X: ("along x", "x"),
    GLOBAL_Y: ("along y", "y"),
}
"""Directions in words, and how their arrows point in a sketch."""

UNITS = {WEIGHT: "kN/m3", PRESSURE: "kN/m2", FORCE: "kN", LINE: "kN/m", TEMPERATURE: "K",
         SETTLEMENT: "m"}  # fmt: skip


def unit_of(load: SurfaceLoad) -> str:
    """Return the unit of a load's value."""
    return UNITS[load.kind]


def describe_direction(load: SurfaceLoad) -> str:
    """Return the direction of a load in words."""
    if load.kind == TEMPERATURE:
        return "of the upper side less the lower" if load.direction is None else "of the sheet"
    if load.direction in DIRECTIONS:
        return DIRECTIONS[load.direction][0]
    return "along ({:.3g}, {:.3g}, {:.3g})".format(*load.direction)


def describe_load(load: SurfaceLoad) -> str:
    """Return what a load is, its direction, what it refers to and where it acts."""
    parts = [f"{load.case}: {load.words}", describe_direction(load)]
    if load.kind == PRESSURE:
        parts.append(f"per m2 {AREA_WORDS[load.area]}")
    if load.where:
        parts.append(f"on {load.where}")
    if load.variation is not None:
        pairs = zip(load.variation.places, load.variation.factors, strict=True)
        words = ", ".join(f"{place:g}: {factor:g}" for place, factor in pairs)
        parts.append(f"times {words} along {'xyz'[load.variation.axis]}")
    return ", ".join(parts)
