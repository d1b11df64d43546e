"""Records: what they say of each key, and that files which are damaged get one sentence."""

import copy
import json
import re
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.files.whole import write_arrays
from foldshell.records.analysis import AnalysisRecord, Criterion, read_analysis, write_analysis
from foldshell.records.analysis_arrays import AnalysisArrays, StepMemory
from foldshell.records.arrays import (
    array_entries,
    list_arrays,
    read_typed_arrays,
    write_typed_arrays,
)
from foldshell.records.catalogue import ARRAYS, FILES
from foldshell.records.design_row import DesignRow
from foldshell.records.documentation import write_documentation
from foldshell.records.entry import COUNT, entries
from foldshell.records.history import HistoryRow
from foldshell.records.plain import to_plain
from foldshell.records.schema import make_schema, write_schemas
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows, write_rows
from foldshell.settings.design import COLUMNS, SILENT_AT_ZERO

DOCS = Path(__file__).parents[3] / "docs" / "records.md"
ANALYSIS = {
    "iteration": 3, "state": "ok", "volume_m3": 60.0, "area_m2": 1584.2,
    "buckling_factor": {"S1": 4.25, "D1": None}, "second_order_iterations": 4,
    "second_order_residual": None, "dofs": 18613, "mesh_subdivisions": 4, "element_order": 5,
    "verdict": "continue", "reason": "not stationary yet",
    "criteria": {"utilization_min": {"value": None, "limit": 0.6, "met": False}},
    "stationary_iterations": 0, "displacement_place_m": [0.0, 1.5, 2.0],
    "edited": False, "counted_from": 0,
}  # fmt: skip
UNITS = {"m": "m", "m2": "m2", "m3": "m3", "kn": "kN", "knm": "kNm", "rad": "rad", "deg": "deg",
         "s": "s", "mb": "MB", "kpa": "kPa"}  # fmt: skip


def all_records():
    """Return every record class of the catalogue, those inside of others too."""
    found: dict[type, None] = {}

    def visit(kind):
        if kind not in found and hasattr(kind, "__dataclass_fields__"):
            found[kind] = None
            for about in entries(kind).values():
                for inner in inner_types(about.type):
                    visit(inner)

    for file in FILES:
        visit(file.kind)
    return list(found)


def inner_types(hint):
    """Return a type and all that it is made of."""
    return [hint, *(one for part in getattr(hint, "__args__", ()) for one in inner_types(part))]


def write(path, **changed):
    """Write analysis.json with some keys changed, or left out where they are `...`."""
    data = copy.deepcopy(ANALYSIS) | changed
    path.write_text(json.dumps({key: value for key, value in data.items() if value is not ...}))
    return path


def test_a_record_reads_and_writes_the_same_content(tmp_path):
    record = read_analysis(write(tmp_path / "analysis.json"))
    assert record.volume_m3 == 60.0 and record.goes_on
    assert record.criteria.utilization_min == Criterion(value=None, limit=0.6, met=False)
    assert record.displacement_place_m == (0.0, 1.5, 2.0) and record.utilization_max is None
    assert (record.least_factor, record.least_factor_combination) == (4.25, "S1")
    write_analysis(tmp_path / "again.json", replace(record, seconds=1.5))
    assert json.loads((tmp_path / "again.json").read_text()) == ANALYSIS
    assert json.loads((tmp_path / "seconds.json").read_text()) == {"seconds": 1.5}


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"volume_m3": ...}, "volume_m3: is missing"),
        ({"volume_m3": "60"}, "volume_m3: '60': must be a number"),
        ({"volume_m3": True}, "volume_m3: True: must be a number"),
        ({"volume_m3": float("nan")}, "volume_m3: nan: must be a number"),
        ({"volume_m3": 10**400}, "volume_m3: 1000"),
        ({"iteration": 3.0}, "iteration: 3.0: must be a whole number"),
        ({"iteration": None}, "iteration: None: must be a whole number"),
        ({"verdict": "done"}, "verdict: 'done': must be one of continue, converged"),
        ({"edited": "no"}, "edited: 'no': must be true or false"),
        ({"utilisation_max": 1.0}, "utilisation_max: is not known, the nearest is utilization_max"),
        ({"buckling_factor": [1.0]}, "buckling_factor: [1.0]: must be names with values"),
        ({"buckling_factor": {"S1": "x"}}, "buckling_factor.S1: 'x': must be a number"),
        (
            {"criteria": {"utilization_min": {"limit": 1, "met": True}}},
            "criteria.utilization_min.value: is missing",
        ),
        ({"criteria": {"utilization": {}}}, "criteria.utilization: is not known, the nearest is"),
        ({"displacement_place_m": [1.0, 2.0]}, "displacement_place_m: [1.0, 2.0]: must be a list"),
        ({"displacement_place_m": [1.0, 2.0, {}]}, "displacement_place_m[2]: {}: must be a num"),
    ],
)
def test_a_damaged_value_is_one_sentence_with_file_and_key(tmp_path, changed, words):
    path = write(tmp_path / "analysis.json", **changed)
    with pytest.raises(InputError) as error:
        read_analysis(path)
    text = str(error.value)
    assert text.startswith(f"{path}: {words}") and "\n" not in text
    assert text.endswith("delete this file and start again, it is computed anew")


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, "\x00", '{"a": ' + "9" * 5000 + "}"])
def test_a_file_that_is_no_json_is_one_sentence(tmp_path, text):
    path = tmp_path / "analysis.json"
    path.write_text(text)
    with pytest.raises(InputError, match="cannot be read as JSON: delete this file"):
        read_analysis(path)
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(InputError, match="cannot be read as JSON"):
        read_analysis(path)
    path.write_text("[]")
    with pytest.raises(InputError, match="content: \\[\\]: must be names with values"):
        read_analysis(path)
    with pytest.raises(InputError, match="no such file"):
        read_analysis(tmp_path / "none.json")


def test_every_key_with_a_unit_in_its_name_has_that_unit():
    """`volume_m3` is in m3: the suffix is what readers of a bare file go by."""
    checked = 0
    for kind in all_records():
        for key, about in entries(kind).items():
            suffix = re.search(r"_([a-z]+[23]?)$", key)
            if key == "volume_per_area_m":
                assert about.unit in ("m", "m3/m2")
            elif key == "cost_m2":  # in a currency of one's own
                assert about.unit == "1/m2"
            elif key.endswith(("_kg_m2", "_kg_m3", "_cm2_m")):
                assert about.unit == "/".join(key.split("_")[-2:])
            elif suffix and suffix[1] in UNITS:
                assert about.unit == UNITS[suffix[1]], f"{kind.__name__}.{key}"
                checked += 1
            assert about.unit in {
                *UNITS.values(),
                "",
                "-",
                COUNT,
                "m3/m2",
                "kg/m2",
                "kg/m3",
                "cm2/m",
                "mm",
                "kg",
                "1/m2",
            }, key
    assert checked > 60


def test_numbers_have_a_unit_and_counts_are_whole():
    for kind in all_records():
        for key, about in entries(kind).items():
            names = {one for one in inner_types(about.type) if one in (int, float, bool, str)}
            if names <= {bool, str}:
                assert about.unit == "" or not names, f"{kind.__name__}.{key}"
            if about.unit == COUNT:
                assert names & {int, float}, f"{kind.__name__}.{key}"


def test_the_page_on_result_files_is_in_step():
    assert DOCS.read_text(encoding="utf-8") == write_documentation(), (
        "PYTHONPATH=scripts python -m foldshell.records > docs/records.md"
    )


def test_schemas_are_valid_and_take_what_the_records_write(tmp_path):
    paths = write_schemas(tmp_path)
    assert [path.name for path in paths] == [f"{file.name}.schema.json" for file in FILES]
    for path in paths:
        jsonschema.Draft202012Validator.check_schema(json.loads(path.read_text()))
    schema = json.loads((tmp_path / "analysis.schema.json").read_text())
    jsonschema.validate(ANALYSIS, schema)
    properties = schema["$defs"]["AnalysisRecord"]["properties"]
    assert properties["volume_m3"]["unit"] == "m3" and properties["volume_m3"]["description"]


@pytest.mark.parametrize(
    "changed",
    [
        {"volume_m3": "60"},
        {"verdict": "done"},
        {"utilisation_max": 1.0},
        {"displacement_place_m": [1.0, 2.0]},
        {"displacement_place_m": [1.0, 2.0, 3.0, 4.0]},
        {"buckling_factor": {"S1": "x"}},
    ],
)
def test_a_schema_refuses_what_a_record_refuses(changed):
    schema = make_schema(next(file for file in FILES if file.name == "analysis"))
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(ANALYSIS | changed, schema)


def test_columns_of_designs_stand_in_the_summary():
    """The columns of designs.tsv, their record and the first columns of the summary are one."""
    assert set(entries(DesignRow)) == set(COLUMNS)
    later = ("edge_beam", "folded", "file_unit", "loads", "outline", "openings", "settings")
    later += SILENT_AT_ZERO
    first = [key for key in entries(DesignRow) if not key.startswith(later)]
    assert list(entries(SummaryRow))[: len(first)] == first


def make_row(**changed):
    values = {
        "iteration": 0, "verdict": "continue", "volume_m3": 1 / 3, "second_order_iterations": 2,
        "reason": "a, b\n\"c\"", "thickness_min_m": 0.04,
    }  # fmt: skip
    return HistoryRow(**values | changed)


def test_a_table_reads_back_to_the_last_digit(tmp_path):
    rows = [make_row(), make_row(iteration=1, utilization_max=1e-17, panels_above_one=3)]
    write_rows(tmp_path / "history.csv", HistoryRow, rows)
    assert read_rows(tmp_path / "history.csv", HistoryRow) == rows
    header = (tmp_path / "history.csv").read_text().splitlines()[0].split(",")
    assert "edge_beam_utilization_max" not in header and "utilization_max" in header
    rows.append(make_row(edge_beam_utilization_max=0.5))
    write_rows(tmp_path / "history.csv", HistoryRow, rows)
    assert read_rows(tmp_path / "history.csv", HistoryRow) == rows


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("0.04", "thin"), "row 1: thickness_min_m: 'thin': must be a number"),
        (("0.04", "nan"), "row 1: thickness_min_m: nan: must be a number"),
        (("volume_m3", "volume_m4"), "row 1: volume_m4: is not known, the nearest is volume_m3"),
        (("continue", "go"), "row 1: verdict: 'go': must be one of"),
        (("0.04", "0.04,5"), "row 1: has not one cell for each column"),
        ((",,", ","), "row 1: has not one cell for each column"),
    ],
)
def test_a_damaged_table_is_one_sentence(tmp_path, change, words):
    path = tmp_path / "history.csv"
    write_rows(path, HistoryRow, [make_row()])
    path.write_text(path.read_text().replace(*change, 1))
    with pytest.raises(InputError) as error:
        read_rows(path, HistoryRow)
    assert str(error.value).startswith(f"{path}: {words}")


def test_arrays_read_back_and_tell_what_does_not_fit(tmp_path):
    path = tmp_path / "analysis.npz"
    arrays = AnalysisArrays(thickness=np.ones(6), edge_beam_panel=np.arange(2))
    write_typed_arrays(path, arrays)
    read = read_typed_arrays(path, AnalysisArrays)
    assert list(list_arrays(read)) == ["thickness", "edge_beam_panel"]
    assert read.utilization("panel_mean") is None
    write_arrays(path, {"thickness": np.ones(6), "utilization_panel_mean": np.ones(5)})
    with pytest.raises(InputError, match=r"utilization_panel_mean: \(5,\): must be \(P\) with P ="):
        read_typed_arrays(path, AnalysisArrays)
    write_arrays(path, {"translations": np.ones((4, 2, 1)), "thickness": np.ones(6)})
    with pytest.raises(InputError, match=r"translations: \(4, 2, 1\): must be \(N, 3, C\)"):
        read_typed_arrays(path, AnalysisArrays)
    write_arrays(path, {"displacement": np.ones(3)})
    with pytest.raises(InputError, match="thickness: is missing: delete this file"):
        read_typed_arrays(path, AnalysisArrays)


def test_damaged_arrays_are_one_sentence(tmp_path):
    path = tmp_path / "memory.npz"
    memory = StepMemory(step=np.ones(3), direction=np.ones(3), sign_changes=np.ones(3),
                        stable=np.empty(0), failures=np.asarray(2))  # fmt: skip
    write_typed_arrays(path, memory)
    assert read_typed_arrays(path, StepMemory).failures == 2
    whole = path.read_bytes()
    for damage in (b"", whole[: len(whole) // 2], whole[:-30], b"x" + whole[1:]):
        path.write_bytes(damage)
        with pytest.raises(InputError, match=r"memory\.npz: cannot be read as arrays"):
            read_typed_arrays(path, StepMemory)
    with pytest.raises(InputError, match="no such file"):
        read_typed_arrays(tmp_path / "none.npz", StepMemory)


def test_words_and_units_are_made_for_people():
    known = entries(AnalysisRecord)
    assert known["volume_m3"].label() == "volume [m³]"
    assert known["utilization_max"].label() == "utilization, largest of all points [-]"
    assert known["dofs"].label() == "unknowns"
    assert known["displacement_vertical_max_m"].label(unit=False) == "vertical displacement, down"
    assert to_plain(Criterion(value=None, limit=1.0, met=False))["value"] is None


@pytest.mark.parametrize("file", ARRAYS, ids=lambda file: file.name)
def test_an_array_that_is_missing_or_of_other_axes_is_named_with_its_file(tmp_path, file):
    """Sizes by letter: all axes of a file that share one have its size."""
    sizes = {letter: 3 + k for k, letter in enumerate("ABCDEFGHIJKLMNOPQRSTUVWXYZ")}
    about = array_entries(file.kind)
    arrays = {
        name: np.zeros([int(axis) if axis.isdigit() else sizes[axis] for axis in one.axes])
        for name, one in about.items()
    }
    path = tmp_path / f"{file.name}.npz"
    write_arrays(path, arrays)
    assert set(list_arrays(read_typed_arrays(path, file.kind))) == set(arrays)
    for name, one in about.items():
        write_arrays(path, {key: values for key, values in arrays.items() if key != name})
        if one.required:
            with pytest.raises(InputError, match=rf"{file.name}\.npz: {name}: is missing"):
                read_typed_arrays(path, file.kind)
        else:
            assert getattr(read_typed_arrays(path, file.kind), name) is None
        write_arrays(path, arrays | {name: np.zeros((1, 1, 1, 1))})
        with pytest.raises(InputError, match=rf"{file.name}\.npz: {name}: \(1, 1, 1, 1\): must be"):
            read_typed_arrays(path, file.kind)
