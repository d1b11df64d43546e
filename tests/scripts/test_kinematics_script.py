"""Entry script of rule kinematics."""

import csv
import json

import pytest

import kinematics
from foldshell.kinematics.study import Sweeps

SWEEPS = Sweeps((100.0,), (0.01,), (100.0,), (1.0,))


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Files of a study of one small sheet."""
    folder = tmp_path_factory.mktemp("kinematics")
    paths = [folder / name for name in ("k.json", "rules.csv", "k.png", "trajectories.png")]
    kinematics.main(*paths, sector_angle_deg=60.0, densities=((5, 6),), sweeps=SWEEPS)
    return paths


def test_tables_are_written(written):
    data = json.loads(written[0].read_text())
    assert [row["in_plane"] < 0 for row in data["ratios"]] == [True] * 8
    assert data["sheets"][0]["rigid_panels"]["freedoms"] == 1
    assert {row["panels"] for row in data["force_ratios"]} == {"quadrilaterals", "triangles"}
    engines = [row["engine"] for row in data["force_ratios"]]
    assert engines == ["levenberg_marquardt"] * 4 + ["averaged_projections"] * 4


def test_rules_are_the_closed_form_in_the_table_from_flat_to_folded_flat(written):
    """1e-12 m, rad and relative: round-off only, of sheets of up to 14 m; by the table's rows."""
    rows = json.loads(written[0].read_text())["geometric_rules"]
    for pattern in {(row["side_a_m"], row["sector_angle_deg"]) for row in rows}:
        path = [r for r in rows if (r["side_a_m"], r["sector_angle_deg"]) == pattern]
        assert path[0]["travel_over_largest"] == 0.0
        assert path[-1]["travel_over_largest"] == pytest.approx(1.0, abs=1e-15)
    for row in rows:
        measures = {key: value for key, value in row.items() if "max" in key}
        assert len(measures) == 5 and max(measures.values()) < 1e-12, row
    with written[1].open(encoding="utf-8") as stream:
        assert [float(row["vertices_max_m"]) for row in csv.DictReader(stream)] == [
            row["vertices_max_m"] for row in rows
        ]


def test_pictures_are_written(written):
    for path in written[2:]:
        assert path.read_bytes()[:4] == b"\x89PNG"
