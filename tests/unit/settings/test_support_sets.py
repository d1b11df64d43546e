"""The table of supports: rows of sets, and one sentence for each that is not allowed."""

import pytest

from foldshell.files.errors import InputError
from foldshell.settings.designs import read_designs
from foldshell.settings.stages import hash_decisions
from foldshell.settings.study import Settings
from foldshell.settings.support_row import SupportRow, from_plain
from foldshell.settings.supports import read_support_sets
from foldshell.settings.where import read_where

HEADER = "set\tname\twhere\tfix\tclamp\tspring_x\tspring_y\tspring_z"


def write(folder, *rows, header=HEADER):
    path = folder / "supports.tsv"
    path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    return path


def test_rows_of_a_set_in_their_order(tmp_path):
    path = write(
        tmp_path,
        "two\tleft\tzigzag=first\txyz\tyes\t\t\t",
        "one\tany\tborder\tz\t\t\t\t",
        "two\tright\tside=x_max\t-\tno\t10\t\t2e3",
    )
    sets = read_support_sets(path)
    left, right = sets["two"]
    assert left == SupportRow("left", "zigzag=first", "xyz", True)
    assert right == SupportRow("right", "side=x_max", "", False, (10.0, 0.0, 2000.0))
    assert sets["one"] == (SupportRow("any", "border", "z"),)
    assert from_plain([row.to_plain() for row in sets["two"]]) == sets["two"]


def test_a_table_without_the_column_fixes_all(tmp_path):
    path = write(tmp_path, "a\tpins\tcorners", header="set\tname\twhere")
    assert read_support_sets(path)["a"][0].fix == "xyz"


@pytest.mark.parametrize(
    ("row", "named"),
    [
        ("all\ta\tborder\txyz\t\t\t\t", "set: 'all'"),
        ("Big\ta\tborder\txyz\t\t\t\t", "set: 'Big'"),
        ("a\t\tborder\txyz\t\t\t\t", "name: ''"),
        ("a\ta\t\txyz\t\t\t\t", "where: '': a part of it is empty"),
        ("a\ta\tzigzag\txyz\t\t\t\t", "'zigzag' is no word"),
        ("a\ta\tzigzag=middle\txyz\t\t\t\t", "'middle' is neither first nor last"),
        ("a\ta\tside=left\txyz\t\t\t\t", "'left' is no side: x_min"),
        ("a\ta\tside=0\txyz\t\t\t\t", "'0' is no side"),
        ("a\ta\tbox 0 0 1\txyz\t\t\t\t", "3 numbers stand where 4 are due"),
        ("a\ta\tbox 0 0 1 nan\txyz\t\t\t\t", "'nan' is no plain number"),
        ("a\ta\tbox 1 0 0 1\txyz\t\t\t\t", "the box is empty"),
        ("a\ta\tbox 0 0 0 1 1 1\txyz\t\t\t\t", "add `& z low high`"),
        ("a\ta\tpolygon 0 0, 3 2, 3 0, 0 1\txyz\t\t\t\t", "meet"),
        ("a\ta\tedges 1\txyz\t\t\t\t", "'1' is no edge"),
        ("a\ta\tedges 1-1\txyz\t\t\t\t", "'1-1' is no edge"),
        ("a\ta\tvertices\txyz\t\t\t\t", "no number follows"),
        ("a\ta\tvertices -1\txyz\t\t\t\t", "'-1' is no whole number"),
        ("a\ta\tpoint 1\txyz\t\t\t\t", "1 numbers stand where 2 are due"),
        ("a\ta\tborder &\txyz\t\t\t\t", "a part of it is empty"),
        ("a\ta\tborder\tw\t\t\t\t", "fix: 'w': some of x, y, z"),
        ("a\ta\tborder\txx\t\t\t\t", "fix: 'xx'"),
        ("a\ta\tborder\txyz\tperhaps\t\t\t", "clamp: 'perhaps'"),
        ("a\ta\tborder\t\t\t\t\t", "holds nothing"),
        ("a\ta\tborder\t\t\t-5\t\t", "spring_x: -5"),
        ("a\ta\tborder\t\t\tinf\t\t", "spring_x: 'inf': 'inf' is no plain number"),
        ("a\ta\tborder\t\t\t1e13\t\t", "spring_x: 1e13"),
        ("a\ta\tborder\tx\t\t5\t\t", "spring_x: 5: x is fixed too"),
        ("a\ta\tborder\txyz", "4 cells: 8 are allowed"),
    ],
)
def test_a_bad_row_is_refused_with_its_place(tmp_path, row, named):
    path = write(tmp_path, "good\ta\tborder\txyz\t\t\t\t", row)
    with pytest.raises(InputError) as caught:
        read_support_sets(path)
    message = str(caught.value)
    assert named in message and message.startswith(f"{path}: line 3: ") and "\n" not in message


def test_a_name_stands_once_in_a_set(tmp_path):
    path = write(tmp_path, *["a\tsame\tborder\txyz\t\t\t\t"] * 2)
    with pytest.raises(InputError, match="'same': stands twice in the set a"):
        read_support_sets(path)


def test_terms_join():
    where = read_where("zigzag=first & z 0 2.5 | point 1 2 3, 4 5")
    assert [[term.kind for term in terms] for terms in where] == [["label", "z"], ["point"]]
    assert where[1][0].numbers == ((1.0, 2.0, 3.0), (4.0, 5.0))


def read_design(folder, support, supports):
    table = folder / "designs.tsv"
    table.write_text(f"design\tsupport\tloads\none\t{support}\tpaper\n", encoding="utf-8")
    settings = Settings().changed(designs=str(table), supports=str(supports))
    return read_designs(table, settings)[0], settings


def test_a_design_names_a_set_and_its_rows_decide_the_hash(tmp_path):
    path = write(tmp_path, "mine\ta\tborder\txyz\t\t\t\t")
    design, settings = read_design(tmp_path, "mine", path)
    assert design.holding == [SupportRow("a", "border").to_plain()]
    before = hash_decisions(settings, design)
    write(tmp_path, "mine\ta\tborder\txz\t\t\t\t")
    other, _ = read_design(tmp_path, "mine", path)
    assert hash_decisions(settings, other) != before
    pinned, _ = read_design(tmp_path, "zigzag", path)
    assert pinned.holding == "zigzag" and pinned.support_rows == ()


def test_an_unknown_set_is_named_with_the_nearest(tmp_path):
    path = write(tmp_path, "mine\ta\tborder\txyz\t\t\t\t")
    with pytest.raises(InputError, match=r"support: 'mime': one of all, zigzag, strip or a set of"):
        read_design(tmp_path, "mime", path)
    with pytest.raises(InputError, match="it has none"):
        read_design(tmp_path, "mime", tmp_path / "none.tsv")
