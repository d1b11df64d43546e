"""One design of the study: the columns of the table of designs; lengths in m."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass

from foldshell.files.formats import FOLDED_FORMATS, PATTERN_FORMATS
from foldshell.files.units import FACTORS
from foldshell.settings.field import Group, Plain, list_settings, setting, settings_group
from foldshell.settings.load_table import PAPER
from foldshell.settings.outline_text import OUTLINE_FORMATS, is_outline_file
from foldshell.settings.support_row import SUPPORTS, PlainRow, SupportRow

Row = dict[str, str | int | float]
"""One design by the columns of designs.tsv, as Snakemake's `params` and files hold it."""
NAMING = ("design", "tags")
"""Columns that say nothing of the design itself."""

SURFACES = ("paraboloid", "hypar", "hypar_twist", "arch", "arch_strip")
"""Target surfaces that are known by name; others are mesh files."""

GRID_PATTERNS = ("miura", "arc_miura", "smooth", "flat")
"""Patterns of zig-zags and strips."""
PATTERNS = (*GRID_PATTERNS, "yoshimura", "waterbomb", "resch", "accordion", "fan")
"""Crease patterns that are known by name; others are files."""
NONE = "none"
"""Stands for a file that is not given, and for the surface of a sheet that is folded already."""
FOLDED = "folded"
"""Pattern of a design whose folded sheet is a file."""
MIURA_COLUMNS = ("sector_angle_deg", "rest_fold_angle_deg", "strip_grading")
"""Columns of the Miura pattern."""
OTHER_PARAMETERS = ("opening_angle_deg", "take_up")
"""Columns of patterns that have no zig-zags and strips."""
PARAMETERS = {
    "miura": MIURA_COLUMNS,
    "flat": MIURA_COLUMNS,
    "accordion": ("rest_fold_angle_deg",),
    "fan": ("opening_angle_deg",),
    "yoshimura": ("take_up",),
    "waterbomb": ("take_up",),
    "resch": ("take_up",),
}
"""Columns that are parameters, by pattern."""
SILENT_AT_ZERO = (*MIURA_COLUMNS, *OTHER_PARAMETERS, "span_x_m", "span_y_m")
"""Columns that say nothing where they are 0, as if they were not there."""
FOLD_MODES = ("elastic", "isometric", "exact", "rigid")


@settings_group
class DesignColumns(Group):
    """Values of the columns that the table of designs leaves out."""

    pattern: str = setting(
        "miura",
        meaning=f"Crease pattern by name ({', '.join(PATTERNS)}) or a file of one "
        f"({', '.join(PATTERN_FORMATS)}). smooth is the target surface itself, flat the unfolded "
        "Miura sheet.",
    )  # fmt: skip
    surface: str = setting(
        "paraboloid",
        meaning=f"Target surface by name ({', '.join(SURFACES)}) or a mesh file in `file_unit`.",
    )
    span: float = setting(
        28, unit="m", minimum=0.1, maximum=500,
        meaning="Side of the square plan; tolerances of folding and mesh are made for buildings. "
        "Of a rectangle it becomes the shorter side, the span of the limit of displacement; "
        "distances to the target are measured over the longer one.",
    )  # fmt: skip
    height: float = setting(
        10, unit="m", above=0, maximum=500,
        meaning="Rise of the paraboloid or arch, total range of z of the hypar.",
    )  # fmt: skip
    zigzag: int = setting(
        15, unit="polylines", minimum=3, maximum=1000,
        meaning="Number of zig-zag polylines, the borders included.",
    )  # fmt: skip
    strip: int = setting(
        16, unit="polylines", minimum=3, maximum=1000,
        meaning="Number of strip polylines, the borders included.",
    )  # fmt: skip
    support: str = setting(
        "all",
        meaning=f"Pinned borders ({', '.join(SUPPORTS)}: all four, the two zig-zag edges, or the "
        "two strip edges), or a set of the table of supports; docs/supports.md says more.",
    )
    loads: str = setting(
        PAPER,
        meaning="Set of loads, `paper` with the values of the group `loads`, or one of the load "
        "table.",
    )
    settings: str = setting(
        NONE,
        meaning="A file of settings of the design's own, laid over those of the study: what it is "
        "sized for, and judged by (groups combinations, codes, sizing, checks, reinforcement, co2, "
        "prices).",
    )
    fold_mode: str = setting(
        "elastic", choices=FOLD_MODES,
        former={"paper": "elastic"},
        meaning="How the sheet is folded onto the surface.",
    )  # fmt: skip
    edge_beam_depth: float = setting(
        0, unit="m", ranges=((0.05, 5), (-5, -0.05)),
        meaning="Depth of the edge beam, whose panels hang from the unsupported borders or stand "
        "up from them where it is below 0; docs/edge_beams.md says more.",
    )  # fmt: skip
    edge_beam_thickness: float = setting(
        0, unit="m", ranges=((0.02, 2),),
        meaning="Thickness of the edge beam, which no sizing rule changes; both sizes are given or "
        "none.",
    )  # fmt: skip
    sector_angle_deg: float = setting(
        0, unit="degrees", ranges=((5, 88),),
        meaning="Acute angle of a panel of a Miura sheet; 0 takes that of the settings.",
    )  # fmt: skip
    rest_fold_angle_deg: float = setting(
        0, unit="degrees", ranges=((5, 85),),
        meaning="Angle of a panel to the plane in the rest state of a Miura sheet, 0 would be flat "
        "and 90 folded flat; 0 takes the one at which its Poisson's ratio is -1. Of an accordion "
        "the same, 0 takes 40.",
    )  # fmt: skip
    strip_grading: float = setting(
        0, minimum=-1.5, maximum=1.5,
        meaning="How much wider the strips of a Miura sheet are at the borders than in the middle, "
        "in mean widths; below 0 they are narrower there.",
    )  # fmt: skip
    span_x: float = setting(
        0, unit="m", ranges=((0.1, 500),),
        meaning="Side of a rectangular plan along x, across the strips; 0 takes span_m.",
    )  # fmt: skip
    span_y: float = setting(
        0, unit="m", ranges=((0.1, 500),),
        meaning="Side of a rectangular plan along y, across the zig-zags; 0 takes span_m.",
    )  # fmt: skip
    opening_angle_deg: float = setting(
        0, unit="degrees", ranges=((30, 300),),
        meaning="Angle that the flat sheet of pattern fan spans about its middle; 0 takes 120.",
    )  # fmt: skip
    take_up: float = setting(
        0, ranges=((0.4, 0.98),),
        meaning="Share of its size that is left of a yoshimura, waterbomb or resch sheet once it "
        "is folded; 0 takes 0.93, 0.85, 0.75.",
    )  # fmt: skip
    folded: str = setting(
        NONE,
        meaning=f"A sheet that is folded already, from a file ({', '.join(FOLDED_FORMATS)}), in "
        "place of pattern and surface; span_m is then the shorter side of its plan where the cell "
        "is empty.",
    )  # fmt: skip
    outline: str = setting(
        NONE,
        meaning="Polygon in plan that the folded sheet is cut to, such as `polygon x y, x y, x y` "
        f"in m, or a file of it ({', '.join(OUTLINE_FORMATS)}); docs/outlines.md says more.",
    )
    openings: str = setting(
        NONE,
        meaning="Polygons in plan that are cut out of the folded sheet, with ; between, or a file "
        "of them.",
    )
    file_unit: str = setting(
        "m", choices=tuple(FACTORS),
        meaning="Unit of the coordinates in the files of a design; a file that declares another "
        "one is refused. Where the cell is empty a unit that the file declares is taken.",
    )  # fmt: skip


@dataclass(frozen=True)
class Design(DesignColumns):
    """One design of the study; zigzag and strip are counts of polylines, 0 where the pattern is a
    file, both sizes of the edge beam are 0 where there is none; `support_rows` are those of the set
    that `support` names."""

    name: str = dataclasses.field(kw_only=True)
    tags: tuple[str, ...] = dataclasses.field(kw_only=True, default=())
    support_rows: tuple[SupportRow, ...] = dataclasses.field(kw_only=True, default=())

    @property
    def panels(self) -> int:
        """Number of panels, (zigzag - 1)(strip - 1); 0 where it is not known before a file is read.

        Patterns that are no grid of zig-zags and strips have some more or fewer.
        """
        return max(self.zigzag - 1, 0) * max(self.strip - 1, 0)

    @property
    def on_grid(self) -> bool:
        """Whether panels are those of zig-zags and strips, and whole."""
        return self.pattern in GRID_PATTERNS and not self.is_cut

    @property
    def is_cut(self) -> bool:
        """Whether an outline or openings cut the sheet."""
        return self.outline != NONE or self.openings != NONE

    @property
    def has_developable(self) -> bool:
        """Whether a pattern is drawn of the folded sheet: it is unfolded, or cut."""
        return self.fold_mode in ("exact", "rigid") or self.is_cut

    @property
    def files(self) -> tuple[str, ...]:
        """The files that the design is made of: surface, pattern, folded sheet, outlines."""
        named = ((self.surface, SURFACES), (self.pattern, (*PATTERNS, FOLDED)), (self.folded, ()))
        found = [name for name, known in named if name not in (NONE, *known)]
        cuts = (name for name in (self.outline, self.openings) if is_outline_file(name))
        return tuple(dict.fromkeys([*found, *cuts]))

    @property
    def sides(self) -> tuple[float, float]:
        """Sides of its plan along x and y, m; both are the span of a square."""
        return self.span_x or self.span, self.span_y or self.span

    @property
    def holding(self) -> str | list[PlainRow]:
        """Its supports as Snakemake's `params` and hashes hold them: a word, or the set's rows."""
        return [row.to_plain() for row in self.support_rows] or self.support

    def to_row(self) -> Row:
        """Return the design as a plain row with the columns of designs.tsv."""
        columns = {known.key: getattr(self, name) for name, known in _COLUMNS.items()}
        return {"design": self.name, **columns, "tags": ",".join(self.tags)}

    def decide(self) -> Row:
        """Return the columns that decide its final state: all but name, tags and the name of its
        settings, and but those of its pattern and files that say nothing."""
        row = self.to_row()
        silent = {key for key in SILENT_AT_ZERO if not row[key]} | {"settings"}
        silent |= set() if self.files else {"folded", "file_unit"}
        silent |= set() if self.is_cut else {"outline", "openings"}
        return {key: row[key] for key in row if key not in {*NAMING, *silent}}

    @classmethod
    def from_row(cls, row: Row) -> "Design":
        """Return the design of such a row, which may leave out what is silent at 0, and columns
        that a former version did not have."""
        values = {name: row[k.key] for name, k in _COLUMNS.items() if k.key in row}
        tags = tuple(filter(None, row["tags"].split(",")))
        return cls(name=row["design"], tags=tags, **values)


FILE_COLUMNS = ("surface", "pattern", "folded", "outline", "openings")
"""Columns that may name a file."""
_COLUMNS = list_settings(DesignColumns)
COLUMNS = ("design", *(known.key for known in _COLUMNS.values()), "tags")
"""Columns of designs.tsv."""


def leave_out_names(row: Mapping[str, object]) -> Plain:
    """Return the columns of a row but name and tags."""
    return {key: value for key, value in row.items() if key not in NAMING}
