"""Names of candidates, and the designs that every search is compared with."""

from collections.abc import Iterable

from foldshell.settings.design import SILENT_AT_ZERO, Design
from foldshell.settings.exploration import Exploration
from foldshell.settings.field import Plain

SAME = ("surface", "span_m", "height_m", "support", "fold_mode", "loads", "settings")
"""Columns in which a row of the table is like the base, but where they are variables."""


def name_candidate(number: int, place: int) -> str:
    """Return the name of a candidate: round and place in it."""
    return f"{number:02d}-{place:02d}"


def list_references(exploration: Exploration, designs: Iterable[Design]) -> list[Plain]:
    """Return the rows of round 0: designs of the table like the base, then the smooth shell."""
    free = {variable.name for variable in exploration.variables}
    varied = [v.choices for v in exploration.variables if v.name == "pattern"]
    patterns = {"miura", "smooth", str(exploration.base["pattern"]), *(varied[0] if varied else ())}
    rows, seen = [], set()
    for design in designs:
        row = {key: value for key, value in design.to_row().items() if key != "tags"}
        same = all(row[key] == exploration.base[key] for key in SAME if key not in free)
        key = tuple(value for name, value in row.items() if name != "design")
        if same and key not in seen and design.pattern in patterns:
            seen.add(key)
            rows.append(row)
    if not any(row["pattern"] == "smooth" for row in rows):
        plain = {key: 0.0 for key in SILENT_AT_ZERO if key not in ("span_x_m", "span_y_m")}
        rows.append(exploration.make_row("smooth", {**plain, "pattern": "smooth"}))
    return [row | {"design": name_candidate(0, place)} for place, row in enumerate(rows)]
