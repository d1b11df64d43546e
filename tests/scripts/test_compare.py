"""The entry script of rule crosscheck, run by its path, on a small corrugated roof."""

import functools
import json
import os
import runpy
import subprocess
import sys
from pathlib import Path

import openpyxl
import pytest

from crosscheck import verdict
from crosscheck.errors import CrosscheckError, MechanismError
from crosscheck.model import read_model
from crosscheck.records import MULTIFRONTAL
from crosscheck.stability import FIRST_ORDER, Method, analyse_mesh
from crosscheck_models import describe_primary, describe_small_fold, write_model
from foldshell.records.comparison import ComparisonRecord
from foldshell.records.files import read_record

SCRIPT = Path(__file__).parents[2] / "scripts" / "compare.py"


@pytest.fixture(scope="module")
def main():
    return functools.partial(runpy.run_path(str(SCRIPT))["main"], solver=MULTIFRONTAL)


@pytest.fixture(scope="module")
def primary_values(tmp_path_factory):
    """Values of finer meshes stand for the other code's."""
    return compute_primary(tmp_path_factory.mktemp("model"), describe_small_fold())


def compute_primary(folder, data):
    """Plain data as the primary code writes it, second-order values within their combination."""
    model = read_model(write_model(folder / "model.json", data))
    runs = [analyse_mesh(model, m, Method()) for m in (3, 4)]
    return describe_primary(runs, [3, 4])


def write_inputs(folder, primary, model=None):
    (folder / "primary.json").write_text(json.dumps(primary))
    return (
        write_model(folder / "model.json", model or describe_small_fold()),
        folder / "primary.json",
        folder / "comparison.json",
        folder / "comparison.xlsx",
    )


def test_agreeing_codes_pass(main, tmp_path, primary_values):
    paths = write_inputs(tmp_path, primary_values)
    main(*paths, subdivisions=[1, 2], tolerance={"work": 0.03})
    result = json.loads(paths[2].read_text())
    assert result["pass"], result
    assert result["not_compared"] == []
    compared = set(result["quantities"])
    assert {"S2 work_knm", "D2 buckling_factor", "S2 Th.II displacement_max_m"} <= compared
    record = read_record(paths[2], ComparisonRecord)  # refuses keys that it does not know
    assert record.reactions["S2 supports"].passed and record.governing["displacement"] == "D2"
    assert result["design"] == "test"
    work = result["quantities"]["D2 work_knm"]
    assert work["tolerance"] == 0.03
    assert len(work["independent_meshes"]) == 2
    sheet = openpyxl.load_workbook(paths[3])["comparison"]
    assert "passed" in sheet["A1"].value
    assert sorted(p.name for p in tmp_path.iterdir()) == [
        "comparison.json",
        "comparison.xlsx",
        "model.json",
        "primary.json",
    ]


def test_codes_that_differ_are_compared_on_a_finer_mesh(main, tmp_path, primary_values):
    """On one element a block the work is off by more than the tolerance, on two by less."""
    paths = write_inputs(tmp_path, primary_values)
    model = read_model(paths[0])
    found = [analyse_mesh(model, m, FIRST_ORDER)["S2"]["work_knm"] for m in (1, 2)]
    main(*paths, subdivisions=[1, 3])
    settled = json.loads(paths[2].read_text())
    assert settled["independent_subdivisions"] == [1, 3]
    limit = settled["quantities"]["S2 work_knm"]["primary"]
    far, near = (abs(value / limit - 1) for value in found)
    assert "first" not in settled
    main(*paths, subdivisions=[1], tolerance={"work": (far * near) ** 0.5})
    result = json.loads(paths[2].read_text())
    assert result["independent_subdivisions"] == [2]
    first = result["first"]
    assert first["independent_subdivisions"] == [1]
    assert first["quantities"].keys() == result["quantities"].keys()
    work = first["quantities"]["S2 work_knm"]
    assert not work["pass"] and work["independent"] == pytest.approx(found[0])
    sheet = openpyxl.load_workbook(paths[3])["comparison"]
    texts = [row[0] for row in sheet.values if isinstance(row[0], str)]
    assert any("second comparison, on meshes 2" in text and "S2 work_knm" in text for text in texts)


def test_a_mechanism_is_not_compared_and_says_why(main, tmp_path):
    """The primary code has no displacements to compare: neither passed nor failed."""
    primary = {"subdivisions": [4, 12], "combinations": {}, "reason": "moves most at node 7"}
    paths = write_inputs(tmp_path, primary)
    main(*paths, subdivisions=[1, 2])
    result = json.loads(paths[2].read_text())
    assert result["pass"] is None and result["reason"] == "moves most at node 7"
    assert result["quantities"] == {}
    sheet = openpyxl.load_workbook(paths[3])["comparison"]
    assert "not possible" in sheet["A1"].value and sheet["A4"].value == "moves most at node 7"


def test_a_mechanism_that_only_the_independent_code_finds_fails(
    main, tmp_path, primary_values, monkeypatch
):
    def give_way(*_arguments):
        raise MechanismError("these let the shell move")

    monkeypatch.setattr(verdict, "analyse_mesh", give_way)
    paths = write_inputs(tmp_path, primary_values)
    main(*paths, subdivisions=[1, 2])
    result = json.loads(paths[2].read_text())
    assert result["pass"] is False and "let the shell move" in result["reason"]


def test_another_load_factor_fails_the_comparison(main, tmp_path, primary_values):
    """More slips, in either code: test_planted_slips.py."""
    wrong = describe_small_fold()
    wrong["combinations"]["S2"]["LL"] = 1.4
    paths = write_inputs(tmp_path, primary_values, wrong)
    main(*paths, subdivisions=[1, 2])
    assert not json.loads(paths[2].read_text())["pass"]


def test_a_slip_in_stability_alone_is_caught(main, tmp_path, primary_values):
    """Membrane forces of half the size in the other code: twice the factor, first order alike."""
    wrong = json.loads(json.dumps(primary_values))
    for entry in wrong["combinations"].values():
        entry["buckling_factor"] = [2 * value for value in entry["buckling_factor"]]
    paths = write_inputs(tmp_path, wrong)
    main(*paths, subdivisions=[1, 2])
    quantities = json.loads(paths[2].read_text())["quantities"]
    failed = {name for name, entry in quantities.items() if not entry["pass"]}
    assert failed == {"S2 buckling_factor", "D2 buckling_factor"}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda model, primary: model.pop("facets"), ["model.json", "facets", "missing"]),
        (lambda model, primary: primary.pop("subdivisions"), ["primary.json", "subdivisions"]),
        (
            lambda model, primary: model["panel_thickness_m"].__setitem__(2, -0.06),
            ["model.json", "panel_thickness_m[2]", "-0.06", "above 0"],
        ),
    ],
)
def test_bad_input_is_one_sentence_and_writes_nothing(
    main, tmp_path, primary_values, change, words
):
    model, primary = describe_small_fold(), json.loads(json.dumps(primary_values))
    change(model, primary)
    paths = write_inputs(tmp_path, primary, model)
    with pytest.raises(CrosscheckError) as caught:
        main(*paths, subdivisions=[1, 2])
    assert all(word in str(caught.value) for word in words)
    assert not paths[2].exists() and not paths[3].exists()


@pytest.mark.parametrize("meshes", [[], [0, 2], [3, 2], [2, 2]])
def test_subdivisions_must_increase(main, tmp_path, primary_values, meshes):
    with pytest.raises(CrosscheckError, match="subdivisions"):
        main(*write_inputs(tmp_path, primary_values), subdivisions=meshes)


def test_run_as_a_script_it_finds_the_package_of_its_own_name(tmp_path, primary_values):
    """As Snakemake does it: a `snakemake` object in the globals, its folder on the path."""
    paths = [str(path) for path in write_inputs(tmp_path, primary_values)]
    code = f"""
import runpy, sys, types
sys.path.insert(0, {str(SCRIPT.parent)!r})

class Files(list):  # as Snakemake's: by number and by name
    def __init__(self, **named):
        super().__init__(named.values())
        self.__dict__.update(named)
        self.get, self.items = named.get, named.items

job = types.SimpleNamespace(
    input=Files(model={paths[0]!r}, primary={paths[1]!r}),
    output=Files(comparison={paths[2]!r}, workbook={paths[3]!r}),
    params={{"subdivisions": [1, 2], "solver": "multifrontal"}}, wildcards={{}}, rule="compare",
)
runpy.run_path({str(SCRIPT)!r}, init_globals={{"snakemake": job}}, run_name="__main__")
"""
    environment = {**os.environ, "PYTHONPATH": ""}
    good = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False
    )
    assert good.returncode == 0, good.stderr
    assert json.loads(Path(paths[2]).read_text())["pass"]
    Path(paths[0]).write_text("{}")
    bad = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False
    )
    assert bad.returncode == 1
    assert bad.stderr.startswith("error: model.json: format")
    assert "Traceback" not in bad.stderr
