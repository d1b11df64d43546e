"""The table of designs: Table 1 in our reading, and every way to spoil a table."""

from pathlib import Path

import pytest

from foldshell.files.errors import InputError
from foldshell.settings.design import COLUMNS
from foldshell.settings.designs import NAME, read_designs, select_designs
from foldshell.settings.make import make_settings
from foldshell.settings.schema import make_designs_schema
from foldshell.settings.stages import choose_subdivisions, hash_decisions

CONFIG_FOLDER = Path(__file__).parents[3] / "config"
SETTINGS = make_settings({})
HEADER = "\t".join(COLUMNS)
_GIVEN = {
    "design": "a", "pattern": "miura", "surface": "arch", "span_m": "28", "height_m": "10",
    "zigzag": "15", "strip": "16", "support": "strip", "fold_mode": "elastic",
    "edge_beam_depth_m": "0.5", "edge_beam_thickness_m": "0.15", "tags": "x,y",
}  # fmt: skip
GOOD = "\t".join(_GIVEN.get(column, "") for column in COLUMNS)


def read(tmp_path, text: str | bytes, settings=SETTINGS):
    path = tmp_path / "designs.tsv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_designs(path, settings)


@pytest.fixture(scope="module")
def designs():
    return read_designs(CONFIG_FOLDER / "designs.tsv", SETTINGS)


def test_columns_are_those_of_the_schema():
    assert tuple(make_designs_schema()["properties"]) == COLUMNS


def test_table_one_series(designs):
    """Paper, Table 1 as read in the docs: 5 + 5 span/heights, 30 densities, 3 on all edges, of
    which two coincide: 41 designs, and nine of them compare the supports (Fig. 6)."""
    table = select_designs(designs, "table1")
    assert len(table) == 41
    curvature = select_designs(designs, "curvature")
    pairs = {(28.0, 10.0), (13.0, 5.0), (5.0, 2.0), (28.0, 28.0), (28.0, 6.0)}
    for surface, support in (("paraboloid", "all"), ("arch", "strip")):
        series = [design for design in curvature if design.surface == surface]
        assert {(design.span, design.height) for design in series} == pairs
        assert {(design.support, design.zigzag, design.strip) for design in series} == {
            (support, 15, 16)
        }
    density = select_designs(designs, "density")
    counts = {(30, 16), (50, 16), (15, 16), (30, 32), (8, 32)}
    expected = {
        (surface, support, count)
        for surface in ("paraboloid", "hypar", "arch")
        for support in ("zigzag", "strip")
        for count in counts
    }
    assert {(d.surface, d.support, (d.zigzag, d.strip)) for d in density} == expected
    assert {(design.span, design.height) for design in density} == {(28.0, 10.0)}


def test_supports_designs_are_the_nine_of_fig_6(designs):
    chosen = select_designs(designs, "supports")
    assert len(chosen) == 9
    assert {(design.surface, design.support) for design in chosen} == {
        (surface, support)
        for surface in ("paraboloid", "hypar", "arch")
        for support in ("all", "zigzag", "strip")
    }
    assert {(d.span, d.height, d.zigzag, d.strip) for d in chosen} == {(28.0, 10.0, 15, 16)}


def test_names_say_what_a_design_is(designs):
    for design in select_designs(designs, "table1"):
        size = f"{design.span:g}-{design.height:g}-{design.zigzag}x{design.strip}"
        assert design.name == f"{design.surface}-{size}-{design.support}"
    assert len({design.to_row().values().__repr__() for design in designs}) == len(designs)


def test_baselines_and_demo(designs):
    assert {design.pattern for design in select_designs(designs, "baseline")} == {"smooth", "flat"}
    (demo,) = select_designs(designs, "demo")
    assert demo.panels < 100
    assert choose_subdivisions(SETTINGS, demo) == SETTINGS.analysis.subdivisions_demo
    assert choose_subdivisions(SETTINGS, designs[0]) == SETTINGS.analysis.subdivisions


def test_left_out_columns_and_empty_cells_take_defaults(tmp_path):
    settings = make_settings({"defaults": {"span_m": 13, "support": "strip"}})
    path = tmp_path / "designs.tsv"
    path.write_text("design\theight_m\nfirst\t\nsecond\t5\n", encoding="utf-8")
    first, second = read_designs(path, settings)
    assert (first.span, first.height, first.support, first.tags) == (13.0, 10.0, "strip", ())
    assert (second.height, second.panels) == (5.0, 14 * 15)


def test_an_edge_beam_has_both_sizes_or_none(tmp_path):
    second_row = GOOD.replace("a", "b", 1).replace("0.5\t0.15", "\t")
    first, second = read(tmp_path, f"{HEADER}\n{GOOD}\n{second_row}\n")
    assert (first.edge_beam_depth, first.edge_beam_thickness) == (0.5, 0.15)
    assert (second.edge_beam_depth, second.edge_beam_thickness) == (0.0, 0.0)
    assert first.to_row()["edge_beam_thickness_m"] == 0.15


def test_remarks_blank_lines_windows_lines_and_order_of_columns(tmp_path):
    text = "\ufeff# remark\r\n\r\nspan_m\tdesign\ttags\r\n5.5\tb\tx, y,x\r\n28\ta\t\r\n"
    first, second = read(tmp_path, text)
    assert (first.name, first.span, first.tags) == ("b", 5.5, ("x", "y"))
    assert second.name == "a"


@pytest.mark.parametrize("text", ["15", "15.0", "15.", "+15", "1.5e1", "1.5e+1"])
def test_a_whole_number_may_be_written_as_in_yaml(tmp_path, text):
    (design,) = read(tmp_path, cell("zigzag", text))
    assert design.zigzag == 15 and isinstance(design.zigzag, int)


def test_target_surface_file(tmp_path):
    mesh = tmp_path / "roof.vtu"
    mesh.write_text("anything")
    (design,) = read(tmp_path, f"design\tsurface\na\t{mesh}\n")
    assert design.surface == str(mesh)
    with pytest.raises(InputError, match="no such file"):
        read(tmp_path, f"design\tsurface\na\t{tmp_path}/none.vtu\n")


def test_whole_numbers_may_have_a_decimal_point_as_in_yaml(tmp_path):
    (design,) = read(tmp_path, "design\tzigzag\tstrip\tspan_m\na\t9.0\t1e1\t28.\n")
    assert (design.zigzag, design.strip, design.span) == (9, 10, 28.0)
    assert isinstance(design.zigzag, int)
    assert make_settings({"defaults": {"zigzag": 9.0}}).defaults.zigzag == 9


@pytest.mark.parametrize(
    ("value", "hint"),
    [('"28"', "without quotes"), ("28 m", "without m"), (".5", "before the point")],
)
def test_hints_speak_of_tables(tmp_path, value, hint):
    with pytest.raises(InputError, match=hint) as caught:
        read(tmp_path, f"design\tspan_m\na\t{value}\n")
    assert "YAML" not in str(caught.value)


def test_ten_thousand_designs_are_allowed_and_no_more(tmp_path):
    """The header is no design."""
    lines = ["design", *(f"d{number}" for number in range(10_000))]
    assert len(read(tmp_path, "\n".join(lines) + "\n")) == 10_000
    with pytest.raises(InputError, match="10001 designs: at most 10000"):
        read(tmp_path, "\n".join([*lines, "one_more"]) + "\n")


@pytest.mark.parametrize(
    ("column", "value", "pattern", "named"),
    [
        ("sector_angle_deg", "44", "miura", "above 45 is allowed where rest_fold_angle_deg"),
        ("sector_angle_deg", "2", "miura", "sector_angle_deg: 2: 0 for none or a number"),
        ("rest_fold_angle_deg", "30", "smooth", "pattern smooth has no such parameter"),
        ("strip_grading", "0.2", "arc_miura", "pattern arc_miura has no such parameter"),
        ("strip_grading", "2", "miura", "strip_grading: 2: a number"),
    ],
)
def test_columns_of_the_form_of_a_miura_sheet(tmp_path, column, value, pattern, named):
    text = f"design\tpattern\t{column}\na\t{pattern}\t{value}\n"
    with pytest.raises(InputError, match=named):
        read(tmp_path, text)


def test_columns_that_say_nothing_change_no_hash(tmp_path):
    """A design without them is what it was before there were such columns."""
    (plain,) = read(tmp_path, "design\na\n")
    (graded,) = read(tmp_path, "design\tstrip_grading\na\t0.2\n")
    assert set(plain.decide()) & {"sector_angle_deg", "strip_grading"} == set()
    assert hash_decisions(SETTINGS, plain) != hash_decisions(SETTINGS, graded)


def cell(column: str, value: str) -> str:
    cells = GOOD.split("\t")
    cells[HEADER.split("\t").index(column)] = value
    return f"{HEADER}\n" + "\t".join(cells) + "\n"


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", "empty"),
        (HEADER + "\n", "no design"),
        (b"\xff\xfea\x00", "not UTF-8"),
        (b"design\n\xe9\n", "not UTF-8"),
        (b"design\na\x00b\n", "control character"),
        ("design,span_m\na,28\n", "with tabs between"),
        ("span_m\theight_m\n28\t10\n", "'design' is missing"),
        ("design\tspan\na\t28\n", "unknown column, the nearest is span_m"),
        ("design\txyz\na\t28\n", "unknown column, allowed are design"),
        ("design\tspan_m\tspan_m\na\t28\t28\n", "stands twice"),
        ("design\tspan_m\na\n", "line 2: 1 cells: 2 are allowed"),
        ("design\tspan_m\na\t28\t\n", "line 2: 3 cells"),
        ("design\na\nb\na\n", "line 4: design 'a': the name stands twice, first in line 2"),
        ("design\na\nA\n", "design 'A'"),
        (cell("design", ""), "a name is due"),
        (cell("design", "../x"), "design: '../x'"),
        (cell("design", "a/b"), "a name of lower-case letters"),
        (cell("design", "a b"), "a name of lower-case letters"),
        (cell("design", "-a"), "a name of lower-case letters"),
        (cell("design", "a" * 65), "64 at most"),
        (cell("design", "ä"), "a name of lower-case letters"),
        (cell("design", "..."), "a name of lower-case letters"),
        (cell("design", "$(id)"), "a name of lower-case letters"),
        (cell("design", "figures"), "reserved"),
        (cell("design", "con"), "reserved"),
        (cell("pattern", "kirigami"), "one of miura, arc_miura, smooth, flat, yoshimura"),
        (cell("surface", "parabolid"), "the nearest is paraboloid"),
        (cell("surface", "roof.txt"), "or a mesh file"),
        (cell("span_m", "28e"), "the value is text"),
        (cell("span_m", "28,5"), "write 28.5"),
        (cell("span_m", "0x1c"), "span_m"),
        (cell("span_m", "028"), "span_m"),
        (cell("span_m", "nan"), "span_m"),
        (cell("span_m", "inf"), "span_m"),
        (cell("span_m", "1e99"), "at most 500"),
        (cell("span_m", "0"), "at least 0.1"),
        (cell("span_m", "-28"), "at least 0.1"),
        (cell("span_m", "1e-9"), "at least 0.1 and of at most 500"),
        (cell("span_m", "28000"), "at most 500"),
        (cell("span_m", "true"), "span_m"),
        (cell("height_m", "-0.0"), "above 0"),
        (cell("zigzag", "15.5"), "15.5: a whole number in polylines of at least 3 and of at most"),
        (cell("zigzag", "010"), "'010'.*, write it without leading zeros$"),
        (cell("zigzag", "1_5"), "'1_5'.*, the value is text$"),
        (cell("span_m", ".5"), "'.5'.*, write a digit before the point$"),
        (cell("zigzag", "fifteen"), "the value is text$"),
        (cell("zigzag", "2"), "at least 3"),
        (cell("strip", "1001"), "at most 1000"),
        (cell("support", "edges"), "one of all, zigzag, strip"),
        (cell("fold_mode", "elastik"), "the nearest is elastic"),
        (cell("edge_beam_depth_m", "0.01"), "edge_beam_depth_m: 0.01: 0 for none or a number in m"),
        (cell("edge_beam_depth_m", "6"), "0.05 to 5, or of -5 to -0.05 is allowed"),
        (cell("edge_beam_thickness_m", "-1"), "0.02 to 2 is allowed"),
        (cell("edge_beam_thickness_m", "0,15"), "write 0.15 with a decimal point"),
        (cell("edge_beam_thickness_m", ""), "edge_beam_thickness_m: 0 beside edge_beam_depth_m"),
        (cell("edge_beam_depth_m", "0"), "both above 0 are allowed, or none"),
        (cell("support", "all"), "no border is free to carry an edge beam"),
        (cell("tags", "x;y"), "with commas between"),
        (cell("tags", "x,,y"), "with commas between"),
        (cell("tags", "../x"), "with commas between"),
    ],
)
def test_bad_table_is_refused_with_its_place(tmp_path, text, named):
    with pytest.raises(InputError, match=named) as caught:
        read(tmp_path, text)
    message = str(caught.value)
    assert "YAML" not in message and "quotes" not in message
    assert message.startswith(str(tmp_path / "designs.tsv")) and "\n" not in message


def test_a_limit_on_panels_holds_where_one_is_set(tmp_path):
    text = f"{HEADER}\n" + GOOD.replace("\t15\t16", "\t100\t100") + "\n"
    assert read(tmp_path, text)[0].panels == 9801
    settings = make_settings({"limits": {"panels_max": 4000}}, "config.yaml")
    with pytest.raises(InputError, match=r"9801 panels: at most limits\.panels_max = 4000"):
        read(tmp_path, text, settings)


def test_unknown_tag_names_the_nearest(designs):
    with pytest.raises(InputError, match="the nearest is supports"):
        select_designs(designs, "suports")


def test_name_pattern_serves_as_a_wildcard_constraint():
    assert NAME.fullmatch("paraboloid-28-10-15x16-all")
    assert not NAME.fullmatch("a/b") and not NAME.fullmatch("a\n")


@pytest.mark.parametrize(
    ("sizing", "row", "named"),
    [
        ({}, "1\t15\t16", "panels of 66.67 mm in plan: a sizing.start_thickness_mm below that"),
        ({"start_thickness_mm": 10000, "largest_thickness_mm": 10000}, "5\t15\t16", "it is 10000"),
        ({}, "0.5\t9\t3", "makes panels of 62.5 mm"),
        ({"start_thickness_mm": 334, "least_thickness_mm": 334}, "5\t15\t16", "333.3 mm"),
    ],
)
def test_panels_thicker_than_wide_are_refused(tmp_path, sizing, row, named):
    """Before any job: the loop would begin with, or have to end in, blocks."""
    settings = make_settings({"sizing": sizing})
    with pytest.raises(InputError, match=named) as caught:
        read(tmp_path, f"design\tspan_m\tzigzag\tstrip\nblock\t{row}\n", settings)
    assert "line 2: design 'block': span_m" in str(caught.value)


def test_panels_a_little_wider_than_thick_are_read(tmp_path):
    """A warning of the final state, not a refusal: design 5/2 of Table 1 starts at half of it."""
    settings = make_settings({"sizing": {"start_thickness_mm": 333, "least_thickness_mm": 40}})
    assert read(tmp_path, "design\tspan_m\tzigzag\tstrip\na\t5\t15\t16\n", settings)


@pytest.mark.parametrize("depth", [0.4, -0.4])
def test_an_edge_beam_thicker_than_deep_is_refused(tmp_path, depth):
    row = "design\tsupport\tedge_beam_depth_m\tedge_beam_thickness_m\na\tstrip\t{}\t{}\n"
    with pytest.raises(InputError, match=r"edge_beam_thickness_m: 0\.4: less"):
        read(tmp_path, row.format(depth, 0.4))
    assert read(tmp_path, row.format(depth, 0.39))
