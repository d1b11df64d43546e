"""The columns fixed, least, largest and group: what is read back, and what is refused."""

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.settings.sizing import Sizing
from foldshell.sizing.panel_limits import PanelLimits, no_limits
from foldshell.workbook.panels import make_panel_grid, mirror_panels
from foldshell.workbook.read_thickness import read_panel_input
from workbook_cases import GRID, THICKNESS, edit_with_openpyxl, write_case

SIZING = Sizing()
COLUMN = {"thickness": "D", "fixed": "E", "least": "F", "largest": "G", "group": "H"}


def change(path, **cells):
    """Change cells of the sheet: `fixed_3=...` is that of panel 3, in row 6."""

    def edit(book):
        for name, value in cells.items():
            column, panel = name.split("_")
            book["thickness"][f"{COLUMN[column]}{int(panel) + 3}"] = value

    return edit_with_openpyxl(path, edit)


def read(path):
    return read_panel_input(path, GRID, SIZING)


def test_empty_columns_ask_for_nothing(tmp_path):
    found = read(write_case(tmp_path / "t.xlsx"))
    assert found.limits is None and np.allclose(found.thickness, THICKNESS, rtol=1e-12)


def test_limits_come_back_as_they_were_written(tmp_path):
    limits = no_limits(12)
    limits.fixed[2] = True
    limits.least[3], limits.largest[3] = 0.0725, 0.2
    limits.group[4:6] = 7
    path = write_case(tmp_path / "t.xlsx", limits=limits)
    found = read(path).limits
    again = read(write_case(tmp_path / "u.xlsx", limits=found)).limits
    for name, values in vars(limits).items():
        assert np.array_equal(getattr(again, name), values, equal_nan=name in ("least", "largest"))


def test_what_a_person_types_is_taken(tmp_path):
    """A panel below its own least thickness is analysed at that, a group at its largest."""
    path = change(
        write_case(tmp_path / "t.xlsx"), fixed_0="Yes", fixed_1=1, fixed_2=True, fixed_3="no",
        least_4=0.15, largest_11="0.2", group_6=3, group_7="3",
    )  # fmt: skip
    found = read(path)
    assert found.limits.fixed.tolist() == [True] * 3 + [False] * 9
    assert found.thickness[4] == 0.15 and found.thickness[11] == 0.2
    assert found.thickness[6] == found.thickness[7] == pytest.approx(THICKNESS[7])
    assert found.thickness[:4] == pytest.approx(THICKNESS[:4], rel=1e-12)


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ({"fixed_0": "maybe"}, r"cell E3: 'maybe': yes, no or an empty cell"),
        ({"least_1": 60}, r"cell F4: 60: .*looks like mm: write 0.06"),
        ({"largest_1": 0.01}, r"cell G4: 0.01: a number in m from 0.04 to 1 or an empty cell"),
        ({"group_2": 1.5}, r"cell H5: 1.5: a whole number from 1 to 9999"),
        ({"group_2": -1}, r"cell H5: -1: a whole number"),
        ({"least_3": 0.2, "largest_3": 0.1}, r"panel 3: least 0.2 m is above largest 0.1 m"),
        ({"fixed_3": "yes", "least_3": 0.5}, r"panel 3: it is fixed at .* outside of its own"),
        ({"fixed_3": "yes", "fixed_4": "yes", "group_3": 1, "group_4": 1},
         r"group 1: panels 3, 4 cannot be alike"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_one_sentence(tmp_path, cells, words):
    path = change(write_case(tmp_path / "t.xlsx"), **cells)
    with pytest.raises(InputError, match=words) as raised:
        read(path)
    assert "\n" not in str(raised.value)


def test_columns_may_be_missing(tmp_path):
    """A workbook of an earlier version has none of them."""
    path = edit_with_openpyxl(
        write_case(tmp_path / "t.xlsx"), lambda book: book["thickness"].delete_cols(5, 4)
    )
    assert read(path).limits is None


def test_mirrored_panels_of_a_grid_are_one_group():
    """3 x 4 panels: about the middle of x columns 0 and 3, 1 and 2 of a row; about both, two rows
    as well, so that the middle row has its own."""
    grid = make_panel_grid(4, 5)
    along = mirror_panels(grid, "x").group.reshape(3, 4)
    assert (along == along[:, ::-1]).all() and len(np.unique(along)) == 6
    both = mirror_panels(grid, "both").group.reshape(3, 4)
    assert (both == both[::-1]).all() and (both == both[:, ::-1]).all()
    assert len(np.unique(both)) == 4
    across = mirror_panels(grid, "y").group.reshape(3, 4)
    assert (across[0] == across[2]).all() and (across[1] == 0).all()  # the middle has no partner
    assert mirror_panels(grid, "none") is None


def test_limits_are_a_plain_record():
    assert not no_limits(3).given
    assert PanelLimits(np.array([True]), *np.full((2, 1), np.nan), np.zeros(1, int)).given
