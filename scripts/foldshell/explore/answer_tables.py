"""The tables of the answer: every roof with what was found, the table's lightest, the smooth shell.

Each function returns the lines of one Markdown table, none where nothing is known.
"""

from collections.abc import Sequence

from foldshell.explore.answer import KINDS, Point, Searched, choose_point, find_front
from foldshell.records.rivals import FOUND, SMOOTH, TABLE, JudgedRow
from foldshell.records.summary import SummaryRow

WORDS = {FOUND: "found", TABLE: "base in the table", SMOOTH: "smooth shell"}
CHECKS = {
    "stability": "stability", "stability_characteristic": "stability",
    "displacement_vertical": "deflection", "displacement_long_term": "creep",
    "displacement_long_term_cracked": "creep", "displacement_horizontal": "sway",
    "reinforced_strut": "struts", "reinforced_ratio": "steel ratio",
    "reinforced_shear": "shear", "reinforced_fit": "room for bars",
    "reinforced_crack": "cracks", "reinforced_punching": "punching",
}  # fmt: skip
"""Checks of the engineering verdict in a word."""


def make_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of a Markdown table, none without rows."""
    if not rows:
        return []
    lines = [f"| {' | '.join(header)} |", "|" + "---|" * len(header)]
    return [*lines, *(f"| {' | '.join(row)} |" for row in rows), ""]


def say(value: float | None, digits: int = 1, factor: float = 1.0) -> str:
    """Return a number, a dash where there is none or no end to it."""
    return "–" if value is None or value == float("inf") else f"{factor * value:.{digits}f}"


def say_failed(row: JudgedRow) -> str:
    """Return the engineering verdict in words: what fails."""
    if row.engineering != "fails":
        return (row.engineering or "–").replace("_", " ")
    names = (row.failed or "").split(", ")
    return "fails: " + ", ".join(dict.fromkeys(CHECKS.get(name, name) for name in names))


def tabulate_judged(searched: Sequence[Searched], measure: str) -> list[str]:
    """Return what each shell comes to by the ordinary rules, sized by one measure."""
    header = ["roof", "shell", "concrete [m³]", "mean thickness [mm]", "buckling factor",
              "displacement [mm]", "mesh error [%]", "second code", "sizing",
              "engineering verdict"]  # fmt: skip
    rows = []
    for one in searched:
        for kind in KINDS:
            if row := one.judged_as(measure, kind):
                rows.append([
                    one.title, WORDS[kind], say(row.volume_m3), say(row.volume_per_area_m, 1, 1e3),
                    say(row.buckling_factor_min), say(row.displacement_vertical_max_m, 0, 1e3),
                    say(row.mesh_error, 1, 100), row.crosscheck or "–",
                    row.state.replace("_", " "), say_failed(row),
                ])  # fmt: skip
    return make_table(header, rows)


def tabulate_steel(searched: Sequence[Searched]) -> list[str]:
    """Return steel, greenhouse gases, shear and stiffness of the shells sized with steel."""
    header = ["roof", "shell", "concrete [m³]", "steel [t]", "steel [kg/m²]", "CO₂ [t] (range)",
              "panels over v_Rd,c [%]", "stability (due)",
              "after creep [mm] (allowed)"]  # fmt: skip
    rows = []
    for one in searched:
        for kind in KINDS:
            if row := one.judged_as("reinforced", kind):
                span = f"{say(row.co2_low_kg, 0, 1e-3)} to {say(row.co2_high_kg, 0, 1e-3)}"
                rows.append([
                    one.title, WORDS[kind], say(row.volume_m3), say(row.steel_kg, 1, 1e-3),
                    say(row.steel_kg_m2), f"{say(row.co2_kg, 0, 1e-3)} ({span})",
                    say(row.shear_share, 0, 100),
                    f"{say(row.stability)} ({say(row.stability_due)})",
                    f"{say(row.displacement_long_term_m, 0, 1e3)} "
                    f"({say(row.displacement_due_m, 0, 1e3)})",
                ])  # fmt: skip
    return make_table(header, rows)


def tabulate_geometry(searched: Sequence[Searched]) -> list[str]:
    """Return what is folded: area, depth, panels, length of folds, strain, planarity."""
    header = ["roof", "shell", "zig-zag x strip lines", "panels", "sheet [m²]", "depth [m]",
              "folds [m]", "edge strain [%]", "planarity [%]", "plan covered [%]"]  # fmt: skip
    rows = []
    for one in searched:
        for kind in KINDS:
            if point := choose_point(one, kind):
                rows.append([
                    one.title, WORDS[kind], _say_layout(point), str(point.panels),
                    say(point.area, 0), say(point.depth, 2), say(point.creases, 0),
                    *(say(None if kind == SMOOTH else value, 1, 100)
                      for value in (point.strain, point.planarity)),
                    say(point.coverage, 1, 100),
                ])  # fmt: skip
    return make_table(header, rows)


def tabulate_factors(searched: Sequence[Searched]) -> list[str]:
    """Return the concrete of each shell by the buckling factor that it was sized for."""
    header = ["roof", "factor of at least", "lightest that was tried [m³]",
              *(f"{WORDS[kind]} [m³]" for kind in KINDS)]  # fmt: skip
    rows = []
    for one in searched:
        for factor in sorted({row.factor_due for row in one.resized}):
            tried, cells = one.lightest(factor), [one.resized_for(kind, factor) for kind in KINDS]
            rows.append([
                one.title, f"{factor:g}", f"{say(tried.volume)} ({say(tried.factor)})" if tried
                else "none",
                *(f"{say(row.volume_m3)} ({say(row.buckling_factor_min)})" if row
                  else "not kept" if one.was_sized(kind, factor) else "not sized"
                  for kind, row in zip(KINDS, cells, strict=True)),
            ])  # fmt: skip
    return make_table(header, rows)


def tabulate_front(searched: Sequence[Searched]) -> list[str]:
    """Return the designs that no other beats in concrete and in panels, those of the table too."""
    rows = []
    for one in searched:
        found = find_front(one.of(FOUND), lambda point: -point.panels)
        words = ", ".join(f"{point.panels}: {say(point.volume)}" for point in found)
        table = find_front(one.of(TABLE), lambda point: -point.panels)
        other = ", ".join(f"{point.panels}: {say(point.volume)}" for point in table)
        rows.append([one.title, words or "–", other or "–"])
    header = ["roof", "found, panels: concrete [m³]", "rows of the table, panels: concrete [m³]"]
    return make_table(header, rows)


def tabulate_rows(searched: Sequence[Searched], summary: Sequence[SummaryRow]) -> list[str]:
    """Return the rows of the table like each roof: as searched, and by the study of the table."""
    header = ["roof", "zig-zag x strip lines", "panels", "on the search's mesh [m³] (factor)",
              "by the study of the table [m³] (factor)", "steel [kg/m²]", "second code",
              "engineering verdict"]  # fmt: skip
    rows = []
    for one in searched:
        for point in one.of(TABLE):
            row = _find_row(one, point, summary)
            study = f"{say(row.volume_m3)} ({say(row.buckling_factor_min)})" if row else "–"
            rows.append([
                one.title, _say_layout(point), str(point.panels),
                f"{say(point.volume)} ({say(point.factor)})", study,
                say(row and row.steel_kg_m2), (row and row.crosscheck) or "–",
                (row and row.engineering) or "–",
            ])  # fmt: skip
    return make_table(header, rows)


def _find_row(one: Searched, point: Point, summary: Sequence[SummaryRow]) -> SummaryRow | None:
    base = one.about.get("exploration", {}).get("base", {})
    alike = ("surface", "span_m", "height_m", "support", "fold_mode")
    return next(
        (row for row in summary if (row.zigzag, row.strip) == point.layout
         and bool(row.edge_beam_depth_m) == point.edge_beam
         and row.pattern == "miura" and all(getattr(row, key) == base.get(key) for key in alike)
         and not (row.rest_fold_angle_deg or row.sector_angle_deg or row.settings)),
        None,
    )  # fmt: skip


def _say_layout(point: Point) -> str:
    words = f"{point.layout[0]} x {point.layout[1]}" if point.layout else point.name
    return f"{words}, edge beam" if point.edge_beam else words


def tabulate_confirmed(searched: Sequence[Searched]) -> list[str]:
    """Return the confirmed designs by the search and by the ordinary rules."""
    rows = []
    for one in searched:
        for row in one.confirmed:
            point = one.point_of(row.design)
            both = row.volume_m3 and point and 100 * (row.volume_m3 / point.volume - 1)
            rows.append([
                row.design, say(point and point.volume), say(row.volume_m3),
                f"{both:+.1f}" if both is not None else "–", say(row.buckling_factor_min),
                row.crosscheck or "–", (row.engineering or "–").replace("_", " "),
            ])  # fmt: skip
    header = ["design", "in the search [m³]", "confirmed [m³]", "difference [%]",
              "buckling factor", "second code", "engineering verdict"]  # fmt: skip
    return make_table(header, rows)
