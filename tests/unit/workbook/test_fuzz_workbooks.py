"""Random edits and random damage: a clear refusal or exactly what stands in the cells.

The oracle reads the edited workbook with openpyxl and its own few lines, so that a thickness is
accepted only where one row names the panel and its cell holds that number.
"""

import datetime
import re

import numpy as np
import openpyxl
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from foldshell.files.errors import InputError
from foldshell.sizing.rounding import round_thickness
from foldshell.workbook.read_thickness import read_thickness
from workbook_cases import GRID, LARGEST, LEAST, THICKNESS, write_case

# openpyxl warns of dates far in the future that an edit has made.
pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")

WORDS = [
    "0.125",
    "0,125",
    "120 mm",
    "12%",
    "1e-1",
    " 0.2 ",
    "-0.1",
    ".5",
    "5.",
    "1_0",
    "0x1",
    "nan",
    "inf",
    "#REF!",
    "#N/A",
    "=0.1",
    "=A3",
    "thickness",
    "panel",
    "m",
    "mm",
    "-",
    "\u0660.\u0661",
    "0.1\u00a0",
    "1 000",
    "panel 3",
    "1e999",
    "-1e999",
    "9" * 5000,
    "1e400",
    "",
]
VALUES = st.one_of(
    st.none(),
    st.booleans(),
    st.floats(LEAST, LARGEST),
    st.floats(allow_nan=False, allow_infinity=False),
    st.integers(-3, 14),
    st.integers(-(10**12), 10**12),
    st.dates(datetime.date(1990, 1, 1), datetime.date(2050, 1, 1)),
    st.sampled_from(WORDS),
    st.text(st.characters(codec="utf-8", exclude_categories=["Cs", "Cc"]), min_size=1, max_size=8),
)
FORMATS = st.sampled_from([None, None, None, "General", "0.0%", "yyyy-mm-dd", "[h]:mm", "0.000"])
POSITIONS = st.tuples(st.integers(1, 17), st.integers(1, 9))
THICKNESS_CELLS = st.tuples(st.integers(3, 14), st.just(4))
EDITS = st.one_of(
    st.tuples(st.just("set"), st.one_of(THICKNESS_CELLS, POSITIONS), VALUES, FORMATS),
    st.tuples(st.sampled_from(["insert_rows", "delete_rows"]), st.integers(1, 15)),
    st.tuples(st.sampled_from(["insert_cols", "delete_cols"]), st.integers(1, 9)),
    st.tuples(st.just("swap_rows"), st.integers(1, 14), st.integers(1, 14)),
    st.tuples(st.just("swap_columns"), st.integers(1, 8), st.integers(1, 8)),
    st.tuples(st.just("copy_row"), st.integers(1, 14), st.integers(1, 20)),
)


@pytest.fixture(scope="module")
def original(tmp_path_factory):
    return write_case(
        tmp_path_factory.mktemp("fuzz") / "thickness.xlsx",
        previous=THICKNESS,
        utilization=5 * THICKNESS,
        change=0 * THICKNESS,
        note=("grow",) * 12,
    )


def apply(sheet, edit):
    kind, *rest = edit
    if kind == "set":
        (row, column), value, number_format = rest
        cell = sheet.cell(row, column)
        try:
            cell.value = value
        except openpyxl.utils.exceptions.IllegalCharacterError:
            return
        if number_format:
            cell.number_format = number_format
    elif kind == "swap_rows":
        swap(sheet[rest[0]], sheet[rest[1]])
    elif kind == "swap_columns":
        first, second = ([sheet.cell(row, column) for row in range(1, 15)] for column in rest)
        swap(first, second)
    elif kind == "copy_row":
        for column in range(1, 9):
            sheet.cell(rest[1], column).value = sheet.cell(rest[0], column).value
    else:
        getattr(sheet, kind)(rest[0])


def swap(first, second):
    for one, other in zip(first, second, strict=False):
        one.value, other.value = other.value, one.value


def find_thickness(sheet) -> dict[int, list[float | None]]:
    """Return for each panel id the thickness of every row that names it, None if no number."""
    rows = list(sheet.iter_rows())
    texts = [[str(cell.value).strip().casefold() for cell in row] for row in rows]
    headers = [row for row, words in enumerate(texts) if {"panel", "thickness"} <= set(words)]
    found: dict[int, list[float | None]] = {}
    for row in rows[headers[0] + 2 :] if headers else []:
        words = texts[headers[0]]
        panel, value = row[words.index("panel")], row[words.index("thickness")]
        key = as_number(panel)
        if key is not None:
            found.setdefault(int(key), []).append(as_number(value))
    return found


def as_number(cell) -> float | None:
    """Return a number, also one typed as text, which no number format touches."""
    value = cell.value
    if isinstance(value, str):
        return float(value) if re.fullmatch(r"\s*[-+.0-9][.0-9]*(e-?\d+)?\s*", value) else None
    if isinstance(value, bool) or cell.is_date or "%" in cell.number_format:
        return None
    return float(value) if isinstance(value, int | float) else None


def check_edits(original, path, edits):
    book = openpyxl.load_workbook(original)
    for edit in edits:
        apply(book["thickness"], edit)
    book.save(path)
    try:
        result = read_thickness(path, GRID, LEAST, LARGEST)
    except InputError as error:
        assert str(error).startswith(str(path)) and "\n" not in str(error)
        return
    found = find_thickness(openpyxl.load_workbook(path)["thickness"])
    assert sorted(found) == list(range(12)) and all(len(values) == 1 for values in found.values())
    due = round_thickness([found[panel][0] for panel in range(12)])
    assert np.array_equal(result, due)
    assert ((result >= LEAST) & (result <= LARGEST)).all()


FUZZ = {
    "deadline": None,
    "suppress_health_check": [HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
}


@settings(max_examples=60, **FUZZ)
@given(edits=st.lists(EDITS, min_size=1, max_size=3))
def test_random_edits(original, tmp_path, edits):
    check_edits(original, tmp_path / "thickness.xlsx", edits)


@pytest.mark.slow
@settings(max_examples=2000, **FUZZ)
@given(edits=st.lists(EDITS, min_size=1, max_size=5))
def test_random_edits_at_length(original, tmp_path, edits):
    check_edits(original, tmp_path / "thickness.xlsx", edits)


DAMAGE = st.lists(
    st.tuples(st.floats(0, 1, exclude_max=True), st.integers(0, 255)), min_size=1, max_size=20
)


@settings(max_examples=200, **FUZZ)
@given(damage=DAMAGE, part=st.floats(0.5, 1.0))
def test_random_damage(original, tmp_path, damage, part):
    """Bytes changed and the end cut off: a refusal, or the very same thicknesses."""
    data = bytearray(original.read_bytes())
    for position, value in damage:
        data[int(position * len(data))] = value
    path = tmp_path / "thickness.xlsx"
    path.write_bytes(data[: int(part * len(data)) if part < 0.99 else None])
    try:
        result = read_thickness(path, GRID, LEAST, LARGEST)
    except InputError as error:
        assert str(error).startswith(str(path)) and "\n" not in str(error)
    else:
        assert np.array_equal(result, round_thickness(THICKNESS))


@settings(max_examples=200, **FUZZ)
@given(text=st.text(max_size=60), position=st.floats(0, 1))
def test_random_xml(original, tmp_path, text, position):
    """Text put anywhere into the sheet's XML raises nothing but a refusal."""
    from workbook_cases import SHEET_PART, rewrite_part

    path = tmp_path / "thickness.xlsx"
    path.write_bytes(original.read_bytes())

    def change(data: bytes) -> bytes:
        at = int(position * len(data))
        return data[:at] + text.encode("utf-8", "surrogatepass") + data[at:]

    rewrite_part(path, SHEET_PART, change)
    try:
        read_thickness(path, GRID, LEAST, LARGEST)
    except InputError as error:
        assert "\n" not in str(error)


NUMBERS = [
    "1e999",
    "-1e999",
    "9" * 5000,
    "1_0",
    "\u0663",
    "nan",
    "-inf",
    "0x1",
    "1e",
    " 1 ",
    "+1",
    "1.",
]


def write_number(path, reference, text):
    """Put `text` into the number of one cell, as the file holds it."""
    import re

    from workbook_cases import SHEET_PART, rewrite_part

    cell = re.compile(rf'(<c r="{reference}"[^>]*><v>)[^<]*(</v>)'.encode())

    def change(data: bytes) -> bytes:
        changed, count = cell.subn(lambda m: m[1] + text.encode() + m[2], data)
        assert count == 1
        return changed

    return rewrite_part(path, SHEET_PART, change)


@pytest.mark.parametrize("text", NUMBERS)
@pytest.mark.parametrize("reference", ["A4", "D4"])
def test_numbers_that_are_none(tmp_path, reference, text):
    """A panel's id and a thickness that no spreadsheet writes: a sentence with the cell."""
    path = write_case(tmp_path / "thickness.xlsx")
    write_number(path, reference, text)
    try:
        found = read_thickness(path, GRID, LEAST, LARGEST)
    except InputError as error:
        assert f"cell {reference}: " in str(error) and "\n" not in str(error)
        assert len(str(error)) < 400
    else:
        assert text in (" 1 ", "+1", "1.")
        assert found[1] == (1.0 if reference == "D4" else round_thickness(THICKNESS)[1])


@pytest.mark.parametrize("name", ["UTF-7", "utf-16", "latin-1", "klingon"])
def test_sheets_in_other_encodings(tmp_path, name):
    from workbook_cases import SHEET_PART, rewrite_part

    path = write_case(tmp_path / "thickness.xlsx")

    def change(data: bytes) -> bytes:
        assert b'encoding="UTF-8"' in data
        return data.replace(b'encoding="UTF-8"', f'encoding="{name}"'.encode())

    rewrite_part(path, SHEET_PART, change)
    with pytest.raises(InputError, match=f"sheet2.xml: encoding '{name}': UTF-8 is allowed"):
        read_thickness(path, GRID, LEAST, LARGEST)
