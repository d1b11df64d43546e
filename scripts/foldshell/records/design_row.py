"""The columns of designs.tsv as they stand in tables of results."""

from dataclasses import dataclass

from foldshell.records.entry import COUNT, entries, entry
from foldshell.settings.design import Row


@dataclass(frozen=True, kw_only=True)
class DesignRow:
    """One design of the table, its defaults filled in."""

    design: str = entry("name of the design")
    tags: str = entry("tags of the design, comma-separated")
    pattern: str = entry("crease pattern")
    surface: str = entry("target surface, or the mesh file that holds it")
    span_m: float = entry("side of the square plan", "m", form="general")
    height_m: float = entry("height of the surface", "m", form="general")
    zigzag: int = entry("zig-zag polylines of the pattern", COUNT, "zig-zags")
    strip: int = entry("strip polylines of the pattern", COUNT, "strips")
    support: str = entry("edges that are supported", words="supported")
    fold_mode: str = entry("how the pattern is folded")
    edge_beam_depth_m: float | None = entry(
        "depth of the edge beam", "m", form="general", default=None
    )
    edge_beam_thickness_m: float | None = entry(
        "thickness of the edge beam", "m", form="general", default=None
    )

    @property
    def panels(self) -> int:
        """Panels between the polylines."""
        return (self.zigzag - 1) * (self.strip - 1)


def make_design_row(columns: Row) -> DesignRow:
    """Return the row of plain columns; sizes of an edge beam of 0, which is none, become None."""
    known = {key: columns[key] for key in entries(DesignRow) if key in columns}
    sizes = ("edge_beam_depth_m", "edge_beam_thickness_m")
    return DesignRow(**known | {key: columns.get(key) or None for key in sizes})
