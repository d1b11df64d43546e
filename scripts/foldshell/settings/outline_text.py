"""Outlines and openings as texts of the table of designs: polygons in plan, or files of them."""

from foldshell.settings.regions import POLYGON, Point, read_region

OUTLINE_FORMATS = (".csv", ".tsv", ".txt", ".json", ".geojson", ".dxf", ".svg")
"""Suffixes of files that may hold outlines, in small letters."""
OUTLINE_ALLOWED = (
    "none, `box x_min y_min x_max y_max`, `polygon x y, x y, x y` (m), or a file "
    f"({', '.join(OUTLINE_FORMATS)})"
)


def is_outline_file(text: str) -> bool:
    """Tell whether a text names a file of outlines."""
    return text.lower().endswith(OUTLINE_FORMATS)


def read_loops(text: str) -> tuple[tuple[Point, ...], ...]:
    """Return the polygons of a text, one or several with ; between, corners in m.

    Raises `ValueError`, which says what is wrong in some words.
    """
    return tuple(read_region(_drop_doubled(part.strip())).corners for part in text.split(";"))


def _drop_doubled(text: str) -> str:
    """Return the text of a polygon without corners that the next one repeats, such as the last one
    of a ring that ends where it began."""
    kind, _, rest = text.partition(" ")
    if kind != POLYGON:
        return text
    corners = [" ".join(corner.split()) for corner in rest.split(",")]
    following = [*corners[1:], corners[0]]
    kept = [one for one, other in zip(corners, following, strict=True) if one != other]
    return f"{kind} {', '.join(kept or corners)}"
