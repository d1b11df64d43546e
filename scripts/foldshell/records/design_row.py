"""The columns of designs.tsv as they stand in tables of results."""

from dataclasses import dataclass
from typing import Any

from foldshell.records.entry import COUNT, entries, entry
from foldshell.settings.design import NONE, SILENT_AT_ZERO, DesignColumns, Row
from foldshell.settings.field import list_settings
from foldshell.settings.load_table import PAPER

_KNOWN = {known.key: known for known in list_settings(DesignColumns).values()}


def _column(key: str, words: str = "", **more: Any) -> Any:
    """Return a column of the table with the unit and the meaning that the settings give it."""
    known = _KNOWN[key]
    meaning = known.meaning[0].lower() + known.meaning[1:].rstrip(".")
    unit = {"degrees": "deg"}.get(known.unit, known.unit)
    return entry(meaning, COUNT if known.kind is int else unit, words, **more)


@dataclass(frozen=True, kw_only=True)
class DesignRow:
    """One design of the table, its defaults filled in."""

    design: str = entry("name of the design")
    tags: str = entry("tags of the design, comma-separated")
    pattern: str = _column("pattern")
    surface: str = _column("surface")
    span_m: float = _column("span_m", form="general")
    height_m: float = _column("height_m", form="general")
    zigzag: int = _column("zigzag", "zig-zags")
    strip: int = _column("strip", "strips")
    support: str = _column("support", "supported")
    fold_mode: str = _column("fold_mode")
    edge_beam_depth_m: float | None = _column("edge_beam_depth_m", form="general", default=None)
    edge_beam_thickness_m: float | None = _column(
        "edge_beam_thickness_m", form="general", shown="mm", default=None
    )
    sector_angle_deg: float | None = _column("sector_angle_deg", form="general", default=None)
    rest_fold_angle_deg: float | None = _column("rest_fold_angle_deg", form="general", default=None)
    strip_grading: float | None = _column("strip_grading", form="general", default=None)
    span_x_m: float | None = _column("span_x_m", form="general", default=None)
    span_y_m: float | None = _column("span_y_m", form="general", default=None)
    outline: str | None = _column("outline", default=None)
    openings: str | None = _column("openings", default=None)
    opening_angle_deg: float | None = _column("opening_angle_deg", form="general", default=None)
    take_up: float | None = _column("take_up", form="general", default=None)
    folded: str | None = _column("folded", default=None)
    file_unit: str | None = _column("file_unit", default=None)
    loads: str | None = _column("loads", default=None)
    settings: str | None = _column("settings", default=None)

    @property
    def panels(self) -> int:
        """Panels between the polylines, 0 where there are none."""
        return max(self.zigzag - 1, 0) * max(self.strip - 1, 0)


def make_design_row(columns: Row) -> DesignRow:
    """Return the row of plain columns; what is none at 0 becomes None there, and so does a file
    that there is none of, and loads that are the paper's."""
    known = {key: columns[key] for key in entries(DesignRow) if key in columns}
    sizes = ("edge_beam_depth_m", "edge_beam_thickness_m", *SILENT_AT_ZERO)
    plain = {"folded": NONE, "file_unit": "m", "loads": PAPER, "outline": NONE, "openings": NONE}
    plain |= {"settings": NONE}
    none = {key: None for key, value in plain.items() if columns.get(key) == value}
    return DesignRow(**known | {key: columns.get(key) or None for key in sizes} | none)
