"""Sheet of reinforced concrete: what a shell takes, what governs its panels, the bars by class."""

from typing import Any

from foldshell.records.entry import COUNT, entries
from foldshell.records.reinforcement import BarsRecord, ReinforcementRecord
from foldshell.workbook.styles import Styles, add_sheet, write_value
from foldshell.workbook.tables import Column, make_column, write_table

TOTALS = (
    "kind", "concrete_m3", "steel_kg", "steel_bars_kg", "steel_kg_m2", "steel_kg_m3",
    "steel_needed_kg_m2", "creases_m", "two_layers_share", "co2_kg", "co2_low_kg", "co2_high_kg",
    "cost", "cost_low", "cost_high",
)  # fmt: skip
"""Fields of the record by line."""
LINE_COLUMNS = (
    Column("quantity", "", "text", 44.0),
    Column("value", "see unit", "decimal", 14.0),
    Column("unit", "", "text", 10.0),
    Column("meaning", "", "text", 66.0),
)
SHARE_COLUMNS = (
    Column("check", "", "text", 44.0),
    Column("used most in", "of panels", "percent", 14.0),
    Column("not met in", "of panels", "percent", 10.0),
)


def add_reinforcement(book: Any, styles: Styles, found: ReinforcementRecord | None) -> None:
    """Add the sheet `reinforcement`; nothing where none was designed.

    Mass by the schedule and mass over volume are formulas of the cells that they are made of.
    """
    if found is None:
        return
    sheet = add_sheet(book, "reinforcement")
    first = write_table(sheet, styles, 0, LINE_COLUMNS, [_list_total(found, k) for k in TOTALS])
    row = first + len(TOTALS) + 1
    shares = [[name, share, found.over_one_share[name]]
              for name, share in found.governing_share.items()]  # fmt: skip
    row = write_table(sheet, styles, row, SHARE_COLUMNS, shares) + len(shares) + 1
    columns = [make_column(about) for about in entries(BarsRecord).values()]
    # The first four columns keep the widths of the lines above.
    columns = [Column(c.key, c.unit, c.style, LINE_COLUMNS[k].width if k < 4 else c.width)
               for k, c in enumerate(columns)]  # fmt: skip
    bars = [list(vars(one).values()) for one in found.bars]
    start = write_table(sheet, styles, row, columns, bars)
    _write_formulas(sheet, styles, found, first, start)


def _list_total(found: ReinforcementRecord, key: str) -> list[Any]:
    """Return the cells of one line: words, value, unit, meaning."""
    about = entries(ReinforcementRecord)[key]
    unit = "" if about.unit in ("-", COUNT) else about.unit
    return [key.replace("_", " "), getattr(found, key), unit, about.meaning]


def _write_formulas(
    sheet: Any, styles: Styles, found: ReinforcementRecord, first: int, start: int
) -> None:
    cell = {key: f"B{first + k + 1}" for k, key in enumerate(TOTALS)}
    formulas = {"steel_kg_m3": f"={cell['steel_kg']}/{cell['concrete_m3']}"}
    if found.bars:
        mass = "ABCDEFGHIJ"[list(entries(BarsRecord)).index("mass_kg")]
        formulas["steel_bars_kg"] = f"=SUM({mass}{start + 1}:{mass}{start + len(found.bars)})"
    for key, formula in formulas.items():
        place = first + TOTALS.index(key), 1
        sheet.write_formula(*place, formula, styles["decimal"], getattr(found, key))
    write_value(sheet, first, 1, found.kind, styles["text"])
