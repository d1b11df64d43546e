"""A row of the table of loads, and its way through Snakemake as one text."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

from foldshell.settings.combination_rules import ACTIONS
from foldshell.settings.zones import Zone, number_panels, read_number, read_zone

SELF_WEIGHT, PRESSURE, FORCE, LINE = "self_weight", "pressure", "force", "line"
TEMPERATURE, SETTLEMENT = "temperature", "settlement"
KINDS = (SELF_WEIGHT, PRESSURE, FORCE, LINE, TEMPERATURE, SETTLEMENT)

VALUE_COLUMNS = {
    "value_kn_m3": SELF_WEIGHT,
    "value_kn_m2": PRESSURE,
    "value_kn": FORCE,
    "value_kn_m": LINE,
    "value_k": TEMPERATURE,
    "value_mm": SETTLEMENT,
}
"""The column, with its unit, in which the value of each kind stands."""

UNITS = {
    SELF_WEIGHT: "kN/m3", PRESSURE: "kN/m2", FORCE: "kN", LINE: "kN/m", TEMPERATURE: "K",
    SETTLEMENT: "mm",
}  # fmt: skip

AREAS = ("sheet", "plan_abs", "plan_net", "plan_up", "footprint")
SIGNS = ("given", "both")
_SEPARATOR = " | "

NORMAL, AGAINST_NORMAL = "normal", "-normal"
AXES = {
    "x": (1.0, 0.0, 0.0), "-x": (-1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "-y": (0.0, -1.0, 0.0),
    "z": (0.0, 0.0, 1.0), "-z": (0.0, 0.0, -1.0),
}  # fmt: skip
DIRECTION_ALLOWED = "x, y, z, -x, -y, -z, normal, -normal or a vector such as `0.6 0 -0.8`"

ZONES_OF_KIND = {
    SELF_WEIGHT: ("all", "zigzag", "strip", "panels"),
    PRESSURE: ("all", "region", "side", "zigzag", "strip", "panels"),
    FORCE: ("all", "region", "side", "zigzag", "strip", "panels", "point"),
    LINE: ("line",),
    TEMPERATURE: ("all", "zigzag", "strip", "panels"),
    SETTLEMENT: ("all", "region", "side"),
}
"""Kinds of zones that each kind of load may have."""

NAMED_ACTIONS = {"SW": "permanent", "SDL": "permanent", "LL": "imposed", "WX": "wind", "WY": "wind"}
"""Kinds of actions of the paper's cases, by name, where a table does not say them."""


@dataclass(frozen=True)
class LoadRow:
    """One load: it belongs to a case, which may have several.

    Attributes
    ----------
    case, kind : name of the load case, one of KINDS
    value : in the unit of the kind, mm for settlements; None for the material's own unit weight
    direction : a word of AXES, "normal" or "-normal" of each facet, or three numbers; "normal" of a
        temperature is the difference between upper and lower side, "" the mean
    area : what a pressure refers to, one of AREAS
    zone, variation : texts that `read_zone` and `read_variation` take
    sign : "both" where combination rules turn the case round too
    action : kind of action, one of ACTIONS
    """

    case: str
    kind: str
    value: float | None
    direction: str
    area: str = "sheet"
    zone: str = "all"
    variation: str = ""
    sign: str = "given"
    action: str = "imposed"

    def to_text(self) -> str:
        """Return the row as one text, from which `from_text` makes the same row."""
        value = "" if self.value is None else repr(self.value)
        cells = (self.case, self.kind, value, self.direction, self.area, self.zone,
                 self.variation, self.sign, self.action)  # fmt: skip
        return _SEPARATOR.join(cells)

    @classmethod
    def from_text(cls, text: str) -> "LoadRow":
        """Return the row of such a text."""
        cells = text.split(_SEPARATOR)
        value = float(cells[2]) if cells[2] else None
        return cls(cells[0], cells[1], value, *cells[3:])


def default_action(case: str, kind: str) -> str:
    """Return the kind of action of a load whose table does not say it."""
    if kind in (TEMPERATURE, SETTLEMENT):
        return kind
    return "permanent" if kind == SELF_WEIGHT else NAMED_ACTIONS.get(case, ACTIONS[1])


def read_direction(text: str) -> tuple[float, float, float] | None:
    """Return a unit vector, or None for the facets' normals with either sign.

    Raises `ValueError` for a text that is no direction.
    """
    if text in AXES:
        return AXES[text]
    if text in (NORMAL, AGAINST_NORMAL):
        return None
    words = text.replace(",", " ").split()
    if len(words) != 3:
        raise ValueError(f"{text!r} is no direction")
    vector = [read_number(word) for word in words]
    length = math.hypot(*vector)
    if length < 1e-9:
        raise ValueError("the vector has no length")
    return vector[0] / length, vector[1] / length, vector[2] / length


def place_rows(rows: Iterable[LoadRow], zigzag_count: int, strip_count: int) -> tuple[LoadRow, ...]:
    """Return the rows of a design, with ranges of polylines as panels.

    Raises `ValueError` for polylines and panels that the sheet has not.
    """
    placed = []
    for row in rows:
        try:
            zone = number_panels(read_zone(row.zone), zigzag_count, strip_count)
        except ValueError as error:
            raise ValueError(f"case {row.case}: zone: {row.zone!r}: {error}") from None
        placed.append(replace(row, zone=_write_panels(zone) or row.zone))
    return tuple(placed)


def _write_panels(zone: Zone) -> str:
    ranges = ", ".join(f"{first}-{last}" for first, last in zone.panels)
    return f"panels {ranges}" if ranges else ""
