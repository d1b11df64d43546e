"""The table of loads: what is read, and one sentence for what is not allowed."""

import pytest

from foldshell.files.errors import InputError
from foldshell.settings.design import Design
from foldshell.settings.load_rows import LoadRow, place_rows, read_direction
from foldshell.settings.load_sets import check_loads, combinations_of, note_idle_loads, place_set
from foldshell.settings.load_study import load_study
from foldshell.settings.load_table import read_load_sets
from foldshell.settings.make import make_settings
from foldshell.settings.stages import hash_decisions, stage_parameters
from foldshell.settings.zones import read_variation, read_zone

HEADER = (
    "set\tcase\tkind\tvalue_kn_m3\tvalue_kn_m2\tvalue_kn\tvalue_kn_m\tvalue_k\tvalue_mm\t"
    "direction\tarea\tzone\tvariation\tsign\taction"
)


def row(**cells):
    names = HEADER.split("\t")
    assert not cells.keys() - set(names)
    return "\t".join(cells.get(name, "") for name in names)


def table(tmp_path, *rows, header=HEADER):
    path = tmp_path / "loads.tsv"
    path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    return str(path)


OWN = row(set="s", case="SW", kind="self_weight")
SNOW = {
    "set": "s", "case": "SNOW", "kind": "pressure", "value_kn_m2": "0.8", "direction": "-z",
    "area": "plan_up", "action": "snow",
}  # fmt: skip


def test_rows_are_typed_with_defaults(tmp_path):
    wind = row(set="s", case="WX", kind="pressure", value_kn_m2="0.5", direction="x")
    path = table(tmp_path, OWN, row(**SNOW, zone="box -1 -1  1 1", sign="both"), wind)
    found = read_load_sets(path)["s"]
    assert found[0] == LoadRow("SW", "self_weight", None, "-z", action="permanent")
    assert found[1] == LoadRow(
        "SNOW", "pressure", 0.8, "-z", "plan_up", "box -1 -1 1 1", "", "both", "snow"
    )
    assert found[2].action == "wind" and found[2].sign == "given" and found[2].area == "sheet"
    assert [LoadRow.from_text(one.to_text()) for one in found] == list(found)


@pytest.mark.parametrize(
    ("cells", "named"),
    [
        ({"value_kn_m2": ""}, "value_kn_m2: the cell is empty: a number in kN/m2 is due"),
        ({"value_kn_m2": "nan"}, "value_kn_m2: 'nan': a number in kN/m2"),
        ({"value_kn_m2": "inf"}, "'inf'"),
        ({"value_kn_m2": "1e9"}, "'1e9'"),
        ({"value_kn_m2": "0,8"}, "'0,8'"),
        ({"value_kn_m2": "0.8 kN/m2"}, "without unit"),
        ({"value_kn_m2": "0"}, "0 loads nothing"),
        ({"value_kn": "3"}, "value_kn: '3': a load of the kind pressure has its value in"),
        ({"set": "Snow"}, "set: 'Snow': a name of lower-case"),
        ({"set": "paper"}, "set: 'paper': its values are the keys of the group loads"),
        ({"set": ""}, "set: ''"),
        ({"case": "1S"}, "case: '1S'"),
        ({"case": ""}, "case: ''"),
        ({"kind": "presure"}, "kind: 'presure': one of .*the nearest is pressure"),
        ({"kind": ""}, "kind: ''"),
        ({"direction": ""}, "direction: the cell is empty"),
        ({"direction": "down"}, "direction: 'down' is no direction: x, y, z"),
        ({"direction": "0 0 0"}, "the vector has no length"),
        ({"direction": "1 0 nan"}, "'nan' is no plain finite number"),
        ({"area": "plan"}, "area: 'plan': one of sheet, plan_abs"),
        ({"area": "footprnt"}, "the nearest is footprint"),
        ({"sign": "plus"}, "sign: 'plus': one of given, both"),
        ({"action": "snwo"}, "action: 'snwo'.*the nearest is snow"),
        ({"zone": "bxo 1 1 2 2"}, "zone: 'bxo 1 1 2 2': 'bxo' is no zone: all, box"),
        ({"zone": "box 1 1 2"}, "3 numbers stand where 4 are due"),
        ({"zone": "box 1 1 2 nan"}, "'nan' is no plain number"),
        ({"zone": "polygon 0 0, 1 1, 2 2"}, "enclose no area"),
        ({"zone": "side left"}, "'left' is no side of the crown"),
        ({"zone": "panels 5-3"}, "runs backwards"),
        ({"zone": "panels -3"}, "neither a number nor a range"),
        ({"zone": "zigzag 2"}, "between polylines 2 and 2 lies no panel"),
        ({"zone": "point 1 1"}, "for a load of the kind pressure all, box, polygon"),
        ({"zone": "line 0 0, 1 1"}, "for a load of the kind pressure"),
        ({"zone": "all of it"}, "no zone"),
        ({"variation": "x 0:1"}, "2 to 100 pairs"),
        ({"variation": "x 1:1, 0:0"}, "the places do not rise"),
        ({"variation": "u 0:1, 1:1"}, "'u' is no axis"),
        ({"variation": "x 0:0, 1:0"}, "all factors are 0"),
        ({"kind": "force", "value_kn_m2": "", "value_kn": "2", "zone": "line 0 0, 1 1"},
         "zone: 'line 0 0, 1 1': for a load of the kind force"),
        ({"kind": "force", "value_kn_m2": "", "value_kn": "2", "zone": "point 0 0"},
         "area: 'plan_up': only a load over an area"),
        ({"kind": "line", "value_kn_m2": "", "value_kn_m": "2", "zone": "all", "area": ""},
         "for a load of the kind line line is allowed"),
        ({"kind": "line", "value_kn_m2": "", "value_kn_m": "2", "area": "", "zone": "line 0 0"},
         "2 to 100 points"),
        ({"kind": "temperature", "value_kn_m2": "", "value_k": "20", "area": ""},
         "direction: '-z': empty for the mean"),
        ({"kind": "settlement", "value_kn_m2": "", "value_mm": "20", "area": "",
          "direction": "normal"}, "an axis or a vector"),
        ({"kind": "self_weight", "value_kn_m2": "", "direction": "x"}, "-z or an empty cell"),
        ({"kind": "self_weight", "value_kn_m2": "", "area": "", "zone": "box 0 0 1 1"},
         "for a load of the kind self_weight all, zigzag, strip, panels"),
    ],
)  # fmt: skip
def test_a_bad_cell_is_named_with_what_is_allowed(tmp_path, cells, named):
    path = table(tmp_path, OWN, row(**(SNOW | cells)))
    with pytest.raises(InputError, match=named) as caught:
        read_load_sets(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: line 3") and "\n" not in message


def test_bad_tables(tmp_path):
    for header, named in [
        ("set\tcase\tkind\tvalue", "column 'value': a load needs its unit in the header"),
        ("set\tcase\tkind\tvalue_kpa", "column 'value_kpa': a load needs its unit"),
        ("set\tcase\tvalue_kn_m2", "the column 'kind' is missing"),
        ("set\tcase\tkind\tdirektion", "the nearest is direction"),
        ("set\tcase\tkind\tcase", "the column stands twice"),
    ]:
        with pytest.raises(InputError, match=named):
            read_load_sets(table(tmp_path, "a\tb\tc\td", header=header))
    with pytest.raises(InputError, match="line 3: set 's': case SNOW: the same load stands in lin"):
        read_load_sets(table(tmp_path, row(**SNOW), row(**SNOW)))
    with pytest.raises(InputError, match="differs from SNOW in case alone"):
        read_load_sets(table(tmp_path, row(**SNOW), row(**(SNOW | {"case": "Snow"}))))
    mixed = row(**(SNOW | {"action": "wind", "zone": "side x-"}))
    with pytest.raises(InputError, match="case SNOW: action: snow and wind: one for all"):
        read_load_sets(table(tmp_path, row(**SNOW), mixed))
    with pytest.raises(InputError, match="no load stands below"):
        read_load_sets(table(tmp_path))
    with pytest.raises(InputError, match="14 cells"):
        read_load_sets(table(tmp_path, row(**SNOW).rpartition("\t")[0]))


def study(tmp_path, rows, designs="design\tloads\na\ts\n", **config):
    path = table(tmp_path, *rows)
    (tmp_path / "designs.tsv").write_text(designs, encoding="utf-8")
    said = []
    plain = {"load_table": path, "designs": str(tmp_path / "designs.tsv"), **config}
    settings, found = load_study(plain, [], said.append)
    return settings, found, said


LISTED = {"combinations": {"strength": {"S1": {"SW": 1.4}, "S2": {"SW": 1.2, "SNOW": 1.6}},
                           "deflection": {"D1": {"SW": 1, "SNOW": 1}}}}  # fmt: skip


def test_a_design_gets_its_loads_and_combinations_and_no_others(tmp_path):
    rows = [OWN, row(**SNOW, zone="zigzag 1-3")]
    settings, (one,), said = study(tmp_path, rows, **LISTED)
    assert said == []
    plain = stage_parameters(settings, "analyse", one)
    assert list(plain["loads"]) == ["rows"]
    assert plain["loads"]["rows"][1].split(" | ")[5] == "panels 15-44"  # 16 strips, 15 panels a row
    assert plain["combinations"]["strength"] == LISTED["combinations"]["strength"]
    before = hash_decisions(settings, one)
    live = study(tmp_path, rows, loads={"live_kn_m2": 2}, **LISTED)
    assert hash_decisions(live[0], one) == before
    assert "loads: live is changed, but no design has the set 'paper'" in live[2][0]
    other = study(tmp_path, [OWN, row(**SNOW, zone="zigzag 1-4")], **LISTED)
    assert hash_decisions(other[0], one) != before
    again = study(tmp_path, [line.replace("s\t", "t\t", 1) for line in rows],
                  "design\tloads\na\tt\n", **LISTED)  # fmt: skip
    assert hash_decisions(again[0], again[1][0]) == before  # the name of a set decides nothing


def test_a_design_with_the_papers_loads_is_what_it_was(tmp_path):
    plain = make_settings({})
    settings, (one,), _ = study(tmp_path, [OWN], "design\na\n")
    assert stage_parameters(settings, "analyse", one) == stage_parameters(plain, "analyse")
    assert combinations_of(settings, one) is settings.combinations


@pytest.mark.parametrize(
    ("rows", "designs", "config", "named"),
    [
        ([OWN], "design\tloads\na\tsnwo\n", {}, "design 'a': loads: 'snwo': .* no such set"),
        ([OWN], None, {}, "strength.S1: SDL: the set 's' of design 'a' has no such case"),
        ([OWN], None, {"combinations": {"strength": {"S1": {"SW": 0.0}}}}, "loads nothing"),
        ([OWN], None, {"combinations": {"strength": {"S1": {"SN": 1.0}}}}, "S1.SN: unknown key"),
        (
            [OWN, row(**SNOW)],
            "design\na\n",
            {"combinations": {"strength": {"S1": {"SNOW": 1.0}}}},
            "S1: combination S1 loads nothing",
        ),
        (
            [OWN, row(**SNOW)],
            "design\na\n",
            {"combinations": {"strength": {"S1": {"SNOW": 1.0, "SW": 1.0}}}},
            "S1: SNOW: the set .paper. of design .a. has no such case",
        ),
        ([OWN, row(**SNOW, zone="zigzag 3-15")], None, LISTED, "polylines 0 to 14"),
        ([OWN, row(**SNOW, zone="box 30 0 40 9")], None, LISTED,
         "zone: 'box 30 0 40 9': it meets no panel of a plan of 28 m by 28 m"),
        ([OWN, row(**SNOW, zone="strip 0-99")], None, LISTED, "polylines 0 to 15"),
        ([OWN, row(**SNOW, zone="panels 3, 210")], None, LISTED, "panel 210: .* panels 0 to 209"),
        ([OWN, row(**SNOW)], None, LISTED | {"crosscheck": {"strength": "S3"}}, "'S3'"),
        ([OWN, row(**(SNOW | {"case": "A"}))], None, {"combinations": {"rule": "listd"}}, "listed"),
    ],
)  # fmt: skip
def test_a_bad_study_is_refused_in_one_sentence(tmp_path, rows, designs, config, named):
    with pytest.raises(InputError, match=named) as caught:
        study(tmp_path, rows, designs or "design\tloads\na\ts\n", **config)
    assert "\n" not in str(caught.value)


def test_the_table_need_not_be_there(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    settings = make_settings({})
    assert settings.load_sets == {}
    with pytest.raises(InputError, match=r"loads: 'x': config/loads\.tsv has no such set"):
        check_loads([Design(name="a", loads="x")], settings, "designs.tsv", "config")
    with pytest.raises(InputError, match=r"other\.tsv"):
        make_settings({"load_table": "other.tsv"})


def test_both_signs_turn_listed_combinations_round(tmp_path):
    wind = {"case": "W", "action": "wind", "sign": "both"}
    rows = [OWN, row(**(SNOW | wind)), row(**(SNOW | {"sign": "both"}))]
    given = {"strength": {"S1": {"SW": 1.4}, "S2": {"SW": 1.2, "W": 0.5, "SNOW": 1.6}},
             "deflection": {"D1": {"SW": 1, "W": 1}}}  # fmt: skip
    settings, (one,), _ = study(tmp_path, rows, combinations=given)
    found = combinations_of(settings, one)
    assert found.strength == {
        "S1": {"SW": 1.4},
        "S2": {"SW": 1.2, "W": 0.5, "SNOW": 1.6},
        "S2n1": {"SW": 1.2, "W": 0.5, "SNOW": -1.6},
        "S2n2": {"SW": 1.2, "W": -0.5, "SNOW": 1.6},
        "S2n3": {"SW": 1.2, "W": -0.5, "SNOW": -1.6},
    }
    assert found.deflection == {"D1": {"SW": 1, "W": 1}, "D1n": {"SW": 1, "W": -1}}


def test_directions_zones_and_variations():
    assert read_direction("3 0 -4") == pytest.approx((0.6, 0, -0.8))
    assert read_direction("-normal") is None and read_direction("-y") == (0, -1, 0)
    assert read_zone("panels 3, 5-7").panels == ((3, 3), (5, 7))
    assert read_zone("line 0 0, 1 2, 3 4").points == ((0, 0), (1, 2), (3, 4))
    found = read_variation("y -7:0, 0:1, 7:0.5")
    assert (found.axis, found.places, found.factors) == (1, (-7, 0, 7), (0, 1, 0.5))
    rows = [LoadRow("A", "pressure", 1.0, "x", zone="strip 2-4")]
    # 4 zig-zags and 6 strips: 3 rows of 5 panels, columns 2 and 3
    assert place_rows(rows, 4, 6)[0].zone == "panels 2-3, 7-8, 12-13"
    assert note_idle_loads(make_settings({}), [Design(name="a")], "c") == []
    assert place_set({"s": tuple(rows)}, Design(name="a", loads="s", zigzag=4, strip=6))


def test_a_turned_name_that_stands_already_is_refused(tmp_path):
    given = {"strength": {"S1": {"SNOW": 1.4}, "s1n": {"SW": 1.0}}, "deflection": {"D1": {"SW": 1}}}
    rows = [OWN, row(**(SNOW | {"sign": "both"}))]
    with pytest.raises(InputError, match="S1 turned round would be S1n, which stands there"):
        study(tmp_path, rows, combinations=given)


def test_names_of_generated_combinations_may_be_compared(tmp_path):
    config = {"combinations": {"rule": "en1990"}, "crosscheck": {"strength": "S2"}}
    settings, (one,), _ = study(tmp_path, [OWN, row(**SNOW)], **config)
    assert list(combinations_of(settings, one).strength) == ["S1", "S2"]
    with pytest.raises(InputError, match=r"crosscheck.strength: 'S9'"):
        study(tmp_path, [OWN, row(**SNOW)], **config | {"crosscheck": {"strength": "S9"}})
