"""Sheets that are folded already: from a file of any format to the displacement of the shell."""

import numpy as np
import pytest

from folded_roofs import make_roof, write_obj, write_stl
from foldshell.files.errors import InputError
from foldshell.files.meshes.extent import measure_extent
from foldshell.folding.panel_files import panel_arrays, take_folded
from foldshell.pattern.make_panels import read_folded
from foldshell.records.arrays import list_arrays
from foldshell.settings.study import Settings
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.case import make_case
from foldshell.sizing.iteration import IterationTask

VERTICES, PANELS = make_roof()


def find_displacement(path, file_unit="declared"):
    """Panels of a file, what was said of it, and the largest downward displacement (m) at 80 mm."""
    mesh = read_folded(path, file_unit)
    arrays = mesh_folded_sheet(list_arrays(panel_arrays(take_folded(mesh))), "all", 2)
    case = make_case(arrays, Settings())
    record, _ = case.run(IterationTask(0, 10.8, np.full(len(mesh.panels), 0.08)), alone=True)
    return len(mesh.panels), mesh.notes, record.displacement_vertical_max_m


@pytest.fixture(scope="module")
def clean(tmp_path_factory):
    return find_displacement(write_obj(tmp_path_factory.mktemp("roof") / "a.obj", VERTICES, PANELS))


def test_every_second_panel_turned_over_changes_nothing(clean, tmp_path):
    turned = [panel[::-1] if k % 2 else panel for k, panel in enumerate(PANELS)]
    panels, notes, moved = find_displacement(write_obj(tmp_path / "a.obj", VERTICES, turned))
    assert panels == clean[0] == 12 and "turned over" in notes[0] and clean[1] == ()
    assert moved == pytest.approx(clean[2], rel=1e-9)


def test_vertices_that_hang_on_a_side_are_welded(clean, tmp_path):
    """One hexagon loses the vertices on its valley: its neighbour's hang on that side."""
    valley = {k for k, p in enumerate(VERTICES) if p[0] == 3.6 and 0 < p[1] < 14}
    cut = [[k for k in p if n != 1 or k not in valley] for n, p in enumerate(PANELS)]
    panels, notes, moved = find_displacement(write_obj(tmp_path / "a.obj", VERTICES, cut))
    assert panels == 12 and any("taken into" in note or "weld" in note for note in notes), notes
    assert moved == pytest.approx(clean[2], rel=1e-9)


def test_stl_has_the_same_panels_by_coplanarity(clean, tmp_path):
    """Single precision moves vertices by 1e-7 of the size."""
    obj = read_folded(write_obj(tmp_path / "a.obj", VERTICES, PANELS), "m")
    path = write_stl(tmp_path / "a.stl", obj.vertices, obj.facets)
    panels, _, moved = find_displacement(path)
    assert panels == 12
    assert moved == pytest.approx(clean[2], rel=1e-5)


@pytest.mark.parametrize(("unit", "factor"), [("mm", 1e3), ("cm", 1e2), ("inch", 1 / 0.0254)])
def test_units_give_the_same(clean, tmp_path, unit, factor):
    path = write_obj(tmp_path / "a.obj", factor * VERTICES, PANELS)
    panels, _, moved = find_displacement(path, unit)
    assert panels == 12 and moved == pytest.approx(clean[2], rel=1e-9)


def test_places_are_those_of_the_file(tmp_path):
    path = write_obj(tmp_path / "a.obj", VERTICES + np.array([100.0, -50, 7]), PANELS)
    assert np.abs(read_folded(path, "m").vertices.min(axis=0) - [100, -50, 7]).max() < 1e-12


def test_a_flat_file_is_no_folded_sheet(tmp_path):
    flat = write_obj(tmp_path / "a.obj", VERTICES * [1, 1, 0], PANELS)
    assert read_folded(flat, "m").folded is not None  # a flat roof of a mesh file is a sheet too
    path = tmp_path / "a.fold"
    path.write_text('{"vertices_coords": [[0,0],[1,0],[0,1]], "faces_vertices": [[0,1,2]]}')
    with pytest.raises(InputError, match="a flat sheet"):
        read_folded(path, "m")


def test_a_plan_of_kilometres_is_refused_with_its_unit(tmp_path):
    path = write_obj(tmp_path / "a.obj", 1000 * VERTICES, PANELS)
    with pytest.raises(InputError, match="it looks like millimetres"):
        measure_extent(path, "declared")
    assert measure_extent(path, "mm") == pytest.approx([10.8, 14.0, 1.3])
