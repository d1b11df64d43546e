"""What the 3D view is given: every field that the state allows, and none that it does not."""

from dataclasses import replace

import numpy as np
import pytest

from figure_cases import PANELS
from foldshell.report import viewer_data
from foldshell.report.arrays import pack_arrays, unpack_arrays
from foldshell.report.viewer_data import make_viewer_data
from foldshell.results.design_view import make_design_view
from foldshell.results.state import read_state
from foldshell.settings.loads import Combinations
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from report_cases import SETTINGS, write_files


def view_of(folder, folded=True, **options):
    """Return the view of a small case, and its state."""
    paths, _ = write_files(folder, **options)
    files = [paths[name] for name in ("mesh", "folded", "arrays", "final")]
    state = read_state(
        "case", *files, Combinations(**SETTINGS["combinations"]), paths["class_arrays"]
    )
    return make_viewer_data(make_design_view(state, 5.0, Sizing(), Material(), folded)), state


def test_every_field_is_there(tmp_path):
    """Six fields with unit, range and ticks; two shapes; creases of all kinds."""
    found, state = view_of(tmp_path)
    names = [field["name"] for field in found.facts["fields"]]
    assert names == ["thickness", "utilization", "utilization_mean", "displacement", "class",
                     "planarity"]  # fmt: skip
    counts = {"panel": PANELS, "triangle": len(state.triangles), "node": len(state.cells.nodes)}
    for field in found.facts["fields"]:
        assert len(found.arrays[f"field_{field['name']}"]) == counts[field["at"]]
        assert field["low"] < field["high"]
        assert "[" in field["words"] or field["name"] == "class"
        assert len(bytes.fromhex(field["colours"])) == 3 * viewer_data.COLOURS
    assert [shape["name"] for shape in found.facts["shapes"]] == ["displacement", "buckling"]
    assert {f"crease_{kind}" for kind in ("mountain", "valley", "flat", "border")} < set(
        found.arrays
    )


def test_values_survive_the_packing(tmp_path):
    """Thickness 50 to 150 mm, displacement -x^2 mm: within a 65534th of their range."""
    found, state = view_of(tmp_path)
    values = unpack_arrays(*pack_arrays(found.arrays))
    assert np.abs(values["panel_thickness"] - state.final.thickness).max() < 1e-6
    down = state.cells.nodes[:, 0] ** 2
    assert np.abs(values["field_displacement"] - down).max() < 1e-4 * down.max()
    moved = values["shape_displacement"]
    assert np.abs(moved[:, 2] + 1e-3 * down).max() < 1e-7 * down.max()
    assert np.array_equal(values["triangles"], state.triangles)


def test_panel_values_belong_to_the_panel(tmp_path):
    """Panel i * 5 + j lies between zig-zags i, i + 1 and strips j, j + 1."""
    found, _ = view_of(tmp_path)
    number = found.arrays["panel_zigzag"] * 5 + found.arrays["panel_strip"]
    assert np.array_equal(number, np.arange(PANELS))


def test_unstable_design_has_geometry_and_thickness(tmp_path):
    """No displacements and no utilization: their fields and the shapes are left out."""
    found, _ = view_of(tmp_path, utilization=None, move=lambda x: np.nan * x, classes=False,
                       buckling_factor={"S1": None})  # fmt: skip
    assert [field["name"] for field in found.facts["fields"]] == ["thickness", "planarity"]
    assert found.facts["shapes"] == []
    assert "panel_utilization" not in found.arrays


def test_smooth_sheets_have_no_creases(tmp_path):
    """Panel borders of a smooth shell are no creases, however much they bend."""
    smooth, _ = view_of(tmp_path / "smooth", folded=False)
    folded, _ = view_of(tmp_path / "folded")
    assert len(smooth.arrays["crease_mountain"]) == len(smooth.arrays["crease_valley"]) == 0
    assert len(smooth.arrays["crease_flat"]) > 0
    assert len(folded.arrays["crease_mountain"]) > 0


def test_very_large_sheets_are_shown_by_facets(tmp_path, monkeypatch):
    """Above the limit: two triangles per panel, each with the largest value of its four cells."""
    fine, state = view_of(tmp_path)
    monkeypatch.setattr(viewer_data, "CELLS_MAX", 10)
    cells = np.random.default_rng(5).permutation(8 * PANELS).reshape(-1, 4)
    state = replace(state, final=replace(state.final, utilization_cell=cells))
    coarse = make_viewer_data(make_design_view(state, 5.0, Sizing(), Material()))
    assert np.array_equal(coarse.arrays["field_utilization"], cells.max(axis=1))
    assert len(coarse.arrays["triangles"]) == 2 * PANELS
    assert np.array_equal(coarse.arrays["nodes"], state.shell.vertices)
    ends = coarse.arrays["crease_border"]
    assert ends.shape[1] == 2
    assert np.array_equal(ends, fine.arrays["crease_border"][:, [0, -1]])


@pytest.mark.parametrize("value", [0.4, 1.7])
def test_limit_of_utilization(tmp_path, value):
    """Below half the limit the scale ends earlier; above it the limit is marked."""
    found, _ = view_of(tmp_path, utilization=value)
    field = next(f for f in found.facts["fields"] if f["name"] == "utilization")
    assert field["limit"] == (1.0 if value > 1 else None)
    assert field["above"] == ("up to 1.70" if value > 1 else "none")


def test_a_sheet_far_from_the_origin_is_shown_about_its_middle(tmp_path):
    """The page holds single precision: 0.5 m at the coordinates of a national grid."""
    near, state = view_of(tmp_path)
    place = np.array([690_000.0, 5_334_000.0, 520.0])
    moved = replace(
        state,
        cells=replace(state.cells, nodes=state.cells.nodes + place),
        shell=replace(state.shell, vertices=state.shell.vertices + place),
    )
    far = make_viewer_data(make_design_view(moved, 5.0, Sizing(), Material()))
    assert np.abs(far.arrays["nodes"]).max() < 10
    sizes = [np.ptp(data.arrays["nodes"], axis=0) for data in (near, far)]
    assert sizes[1] == pytest.approx(sizes[0], abs=1e-8)
