"""Scripts of the claims on shells that stand: one design sized in memory, and the claims."""

import json
from dataclasses import replace

import numpy as np
import pytest

import claims_reinforced
import reinforced_state
from claims_study_case import ROW, SIZING, write_small_design
from foldshell.claims.reinforced_gather import FOLDER
from foldshell.files.errors import InputError
from foldshell.files.whole import write_arrays
from foldshell.records.files import read_record, write_record
from foldshell.records.reinforced_claims import ReinforcedRecord
from foldshell.settings.make import make_settings
from foldshell.settings.stages import stage_parameters
from sizing_case import STRIP, ZIGZAG, corrugated_sheet, stage

OWN = {
    "sizing": {
        "measure": "reinforced", "rule": "filtered_dead_band", "utilization_min": 0.8,
        "buckling_factor_min": 7, "least_thickness_mm": 60,
    },
    "reinforcement": {"sizing_checks": ["strut", "ratio", "fit"]},
}  # fmt: skip


def write_flat_sheet(path):
    sheet = corrugated_sheet()
    across, along = sheet["strip"] * 6 / (STRIP - 1), sheet["zigzag"] * 6 / (ZIGZAG - 1)
    write_arrays(path, sheet | {"vertices": np.column_stack([across, along, 0.0 * across])})
    return path


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A design sized by the paper's criteria, and sized anew as reinforced concrete."""
    folder = tmp_path_factory.mktemp("results")
    write_small_design(folder / "small")
    settings = make_settings(OWN)
    reinforced_state.main(
        {"folded": folder / "small/folded/folded.npz",
         "mesh_convergence": folder / "small/mesh_convergence.json"},
        folder / FOLDER / "small.json",
        [write_flat_sheet(folder / "flat.npz")],
        design=ROW, own="own.yaml", flat="flat-small", support="strip", subdivisions=2,
        settings=stage_parameters(settings, "size") | stage_parameters(settings, "checks"),
    )  # fmt: skip
    return folder


def judge(results, **changes):
    given = {
        "designs": [ROW], "flats": [], "own": "own.yaml", "factor_due": 7.0,
        "settings": stage("study", **SIZING),
    }  # fmt: skip
    paths = results / "claims_reinforced.json", results / "claims_reinforced.md"
    claims_reinforced.main(results, *paths, **given | changes)
    return {entry["id"]: entry for entry in json.loads(paths[0].read_bytes())}, paths[1].read_text()


def test_the_loop_ends_with_steel_that_holds(results):
    found = read_record(results / FOLDER / "small.json", ReinforcedRecord)
    used = found.measures.utilization_reinforced_max
    assert found.measures.state in ("converged", "at_minimum_thickness") and used <= 1
    assert found.measures.steel_kg_m2 > 0
    assert sum(found.governing_share.values()) == pytest.approx(1)
    assert all(0 <= error < 0.5 for error in found.mesh_errors.values())
    assert found.mesh_errors["displacement"] > 0


def test_the_flat_sheet_has_the_volume_of_the_sheet_that_stands(results):
    found = read_record(results / FOLDER / "small.json", ReinforcedRecord)
    assert found.flat.volume_m3 == found.measures.volume
    assert found.flat.thickness_m == pytest.approx(found.measures.volume / 36)


def test_claims_are_those_on_sized_designs_with_both_verdicts(results):
    entries, page = judge(results)
    assert list(entries) == [f"C{k}" for k in range(4, 14)]
    free = entries["C12"]
    assert free["designs"] == ["small"] and min(free["numbers"]["findings"][0]["values"]) > 0
    assert free["paper"]["parts"].keys() == free["parts_survive"].keys()
    assert entries["C10"]["by_strips"]["parts"]["buckling before strength"] == "fails"
    assert "| small |" in page and "## C13" in page


def test_numbers_are_of_the_reinforced_state_and_not_of_the_paper_s(results):
    """Edges that deflect less than the middle turn C12, in the state that stands alone."""
    path = results / FOLDER / "small.json"
    kept = read_record(path, ReinforcedRecord)
    moved = replace(kept.measures, displacement_edge=0.001, displacement_inner=0.1)
    try:
        before = judge(results)[0]["C12"]["paper"]
        write_record(path, replace(kept, measures=moved))
        after = judge(results)[0]["C12"]
    finally:
        write_record(path, kept)
    assert after["paper"] == before and after["verdict"] == "fails"


def test_a_state_that_is_missing_is_named(results, tmp_path):
    write_small_design(tmp_path / "small")
    with pytest.raises(InputError, match=r"sensitivity/reinforced/small\.json: no such file"):
        judge(tmp_path)
