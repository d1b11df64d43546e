"""Entry script of rule kinematics."""

import json

import kinematics


def test_tables_are_written(tmp_path):
    path = tmp_path / "kinematics.json"
    kinematics.main(
        path, densities=((5, 6),), attractions=(100.0,), panel_force_ratios=(0.01,),
        explicit_attractions=(100.0,), explicit_panel_force_ratios=(1.0,),
        figure_path=tmp_path / "k.png",
    )  # fmt: skip
    assert (tmp_path / "k.png").read_bytes()[:4] == b"\x89PNG"
    data = json.loads(path.read_text())
    assert [row["in_plane"] < 0 for row in data["ratios"]] == [True] * 8
    assert data["sheets"][0]["rigid_panels"]["freedoms"] == 1
    assert {row["panels"] for row in data["force_ratios"]} == {"quadrilaterals", "triangles"}
    engines = [row["engine"] for row in data["force_ratios"]]
    assert engines == ["levenberg_marquardt"] * 4 + ["averaged_projections"] * 4
