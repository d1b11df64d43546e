"""explore.xlsx: the sheets, the numbers that the candidates have, endings by their colour."""

import openpyxl
from test_proposals import candidate

from foldshell.records.candidate import MEASURES
from foldshell.settings.exploration import Exploration, Search, SearchLimits, Variable
from foldshell.workbook.explored import write_explored_workbook

VARIABLES = (Variable("sector_angle_deg", 48.0, 75.0), Variable("rest_fold_angle_deg", 30.0, 62.0))


def test_numbers_and_colours(tmp_path):
    given = Exploration("t", {}, VARIABLES, ("volume_m3",), SearchLimits(), Search())
    sized, fallen = (
        candidate("01-00", (0.1, 0.2), volume=41.5),
        candidate("01-01", (0.3, 0.4), volume=80.0, state="unstable"),
    )
    for one in (sized, fallen):
        one.columns["pattern"] = "miura"
    write_explored_workbook(tmp_path / "a.xlsx", given, [sized, fallen], [sized])
    book = openpyxl.load_workbook(tmp_path / "a.xlsx")
    assert book.sheetnames[:2] == ["best", "candidates"]
    sheet = book["candidates"]
    header = [cell.value for cell in sheet[1]]
    assert set(MEASURES) <= set(header)
    rows = [dict(zip(header, row, strict=True)) for row in sheet.iter_rows(min_row=3)]
    assert [row["volume_m3"].value for row in rows] == [41.5, 80.0]
    good, bad = (row["state"].fill.fgColor.rgb for row in rows)
    assert good != bad and book["best"].max_row == 3
