"""What the independent code writes into comparison.json is what the library's record reads."""

import jsonschema
import pytest

from crosscheck import records as written
from crosscheck.comparison import compare
from crosscheck.values import Code, build_independent
from crosscheck.verdict import leave_out
from foldshell.files.errors import InputError
from foldshell.files.whole import write_json
from foldshell.records import comparison as read
from foldshell.records.catalogue import FILES
from foldshell.records.entry import entries
from foldshell.records.schema import make_schema

OF_MESHES = {"primary_meshes", "primary_order", "primary_mesh_error", "independent_meshes",
             "independent_order", "independent_mesh_error"}  # fmt: skip
PAIRS = (
    (written.Comparison, read.ComparisonRecord, {"design"}),
    (written.Quantity, read.ComparedQuantity, OF_MESHES),
    (written.Limit, read.ComparedQuantity, set()),
    (written.SupportReaction, read.SupportReaction, set()),
    (written.ShearShare, read.ShearShare, set()),
    (written.FirstComparison, read.FirstComparison, set()),
)
"""Class that is written, class that is read, keys that only the latter knows."""
RUN = {"S2": {"work_knm": 20.0, "reaction_sum_kn": [-3.0, 0.0, 4.0],
              "load_sum_kn": [3.0, 0.0, -4.0]}}  # fmt: skip


@pytest.mark.parametrize(("writer", "reader", "more"), PAIRS, ids=lambda one: str(one)[:40])
def test_both_classes_have_the_same_keys(writer, reader, more):
    keys = {said.name or name for name, _, said in written.list_fields(writer)}
    assert keys | more == set(entries(reader))


@pytest.mark.parametrize("solver", ["multifrontal", "scipy"])
def test_what_is_written_fits_the_schema_and_reads_back(tmp_path, solver):
    independent = build_independent([2, 3], [RUN, RUN])
    values = {"S2": independent.values["S2"] | {"work_knm": [19.0, 19.1]}}
    compared = compare(Code([4, 8], values, {}, 2.0), independent, {})
    schema = make_schema(next(file for file in FILES if file.name == "comparison"))
    path = tmp_path / "comparison.json"
    for result in (compared, leave_out(None, "a mechanism", solver), leave_out(False, "x", solver)):
        data = {"design": "case", **written.to_data(result)}
        jsonschema.validate(data, schema)
        write_json(path, data)
        record = read.read_comparison(path)
        assert record.passed == result.passed and record.reason == result.reason
        assert {name: one.passed for name, one in record.quantities.items()} == {
            name: one.passed for name, one in result.quantities.items()
        }


def test_a_key_that_is_gone_or_of_another_kind_is_named(tmp_path):
    data = {"design": "case", **written.to_data(leave_out(None, "a mechanism", "scipy"))}
    path = tmp_path / "comparison.json"
    for wrong, words in (
        ({key: value for key, value in data.items() if key != "pass"}, r"pass"),
        (data | {"pass": "yes"}, r"pass"),
        (data | {"quantities": {"S2 work_knm": {"primary": 1.0}}}, r"quantities.*S2 work_knm"),
    ):
        write_json(path, wrong)
        with pytest.raises(InputError, match=rf"comparison\.json: {words}"):
            read.read_comparison(path)
