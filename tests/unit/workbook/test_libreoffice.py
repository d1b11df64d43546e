"""What LibreOffice itself makes of a workbook and of what people type into its cells.

Needs `soffice` and its Python bridge (Debian: libreoffice-calc, python3-uno); skipped without.
"""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.read_thickness import read_thickness
from workbook_cases import GRID, LARGEST, LEAST, THICKNESS, write_case

PYTHON = "/usr/bin/python3"
DRIVER = Path(__file__).with_name("libreoffice_typing.py")


def has_libreoffice() -> bool:
    if not shutil.which("soffice") or not Path(PYTHON).exists():
        return False
    return subprocess.run([PYTHON, "-c", "import uno"], capture_output=True).returncode == 0


pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not has_libreoffice(), reason="no LibreOffice with its Python bridge"),
]

# What is typed into D5, the thickness of panel 2, and the thickness or the words that follow.
TYPED: dict[str, float | str] = {
    "0.2": 0.2,
    ".3": 0.3,
    "1e-1": 0.1,
    "'0.2": 0.2,
    "=0.1+0.05": 0.15,
    "0,125": "cell D5: 125.*looks like mm",
    "120": "cell D5: 120.*looks like mm",
    "120 mm": "cell D5: '120 mm'.*write 0.12 without a unit",
    "3/4": "cell D5: .*looks like a date",
    "2026-03-04": "cell D5: 46085.*looks like a date",
    "TRUE": "cell D5: True",
    "=1/0": "cell D5: the error #DIV/0!",
    "=NA()": "cell D5: the error #N/A",
    "thin": "cell D5: 'thin'",
    "": "row 5: the thickness of panel 2 is empty",
}
# Other edits, and the words or None where nothing changes.
EDITS: list[tuple[list, str | None]] = [
    ([], None),
    ([["insert_column", "thickness", 2]], None),
    ([["insert_column", "thickness", 1], ["insert_column", "thickness", 5]], None),
    ([["type", "summary", "B3", "another name"]], None),
    ([["type", "thickness", "K7", "agreed on site"]], None),
    ([["delete_row", "thickness", 6]], "panel 3: the row is missing"),
    ([["delete_row", "thickness", 2]], "row of units is missing"),
    ([["delete_row", "thickness", 1]], "no header row"),
    ([["rename", "thickness", "Thickness1"]], "sheet 'thickness' is missing, the nearest is"),
    ([["type", "thickness", "D2", "mm"]], "the unit 'm' is due"),
    ([["type", "thickness", "A6", "2"]], "cell A6: 2: the panel stands twice"),
]


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """Every edit in one LibreOffice session; returns the folder with 0.xlsx, 1.xlsx, ..."""
    folder = tmp_path_factory.mktemp("office")
    source = write_case(
        folder / "thickness.xlsx",
        previous=THICKNESS,
        utilization=5 * THICKNESS,
        change=0 * THICKNESS,
        note=("grow",) * 12,
    )
    cases = [[["type", "thickness", "D5", text]] for text in TYPED]
    (folder / "edits.json").write_text(json.dumps(cases + [edit for edit, _ in EDITS]))
    (folder / "out").mkdir()
    command = [PYTHON, str(DRIVER), str(source), str(folder / "out"), str(folder / "edits.json")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=180)
    assert done.returncode == 0, done.stderr
    return folder / "out"


def check(path, expected, due):
    if isinstance(expected, str):
        with pytest.raises(InputError, match=expected):
            read_thickness(path, GRID, LEAST, LARGEST)
    else:
        assert np.array_equal(read_thickness(path, GRID, LEAST, LARGEST), due)


@pytest.mark.parametrize("text", TYPED)
def test_what_is_typed_into_a_thickness(saved, text):
    due = round_thickness(THICKNESS)
    if isinstance(TYPED[text], float):
        due[2] = TYPED[text]
    check(saved / f"{list(TYPED).index(text)}.xlsx", TYPED[text], due)


@pytest.mark.parametrize("number", range(len(EDITS)))
def test_other_edits(saved, number):
    """Saving alone rounds to 15 digits, which 12 survive exactly."""
    path = saved / f"{len(TYPED) + number}.xlsx"
    check(path, EDITS[number][1], round_thickness(THICKNESS))
