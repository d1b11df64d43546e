"""design.vtu and design_lines.vtu hold the fields, cell by cell."""

import numpy as np
import pyvista

from figure_cases import make_state
from foldshell.exchange.design_vtu import write_design_vtu, write_lines_vtu
from foldshell.results.design_view import make_design_view
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing

MATERIAL = Material()


def read(path):
    """Return points, cells and fields of a VTU of triangles or lines, by VTK."""
    grid = pyvista.read(path)
    (cells,) = grid.cells_dict.values()
    return grid.points, cells, dict(grid.cell_data), dict(grid.point_data)


def test_fields_stand_in_their_cells(tmp_path):
    """Thickness of each cell is its panel's; displacement at each node is the known field."""
    state = make_state(tmp_path)
    write_design_vtu(tmp_path / "design.vtu", state, MATERIAL)
    points, cells, fields, nodal = read(tmp_path / "design.vtu")
    assert len(cells) == 2 * 20 * 2**2
    assert np.array_equal(fields["thickness"], np.linspace(0.05, 0.15, 20)[fields["panel"]])
    assert np.allclose(nodal["displacement"][:, 2], -1e-3 * points[:, 0] ** 2, atol=1e-15)
    assert set(nodal["displacement_combination"]) == {4}
    assert set(fields["governing_combination"]) == {2}
    assert set(fields["force_combination"]) == {2}
    assert np.array_equal(fields["thickness_class"], 1 + fields["panel"] * 3 // 20)
    assert np.array_equal(np.unique(fields["class_thickness"]), [0.1, 0.15, 0.2])
    assert (fields["utilization"] == 0.4).all()
    strip = np.isin(state.folded.strip, (0, 5))
    assert np.array_equal(nodal["supported"][: len(strip)] == 1, strip)


def test_principal_forces_rebuild_the_tensor(tmp_path):
    """n1 d1 d1 + n2 d2 d2 has the components nx, ny, nxy in the facet's axes."""
    state = make_state(tmp_path, move=lambda x: 1e-3 * np.sin(x + x[:, [2, 0, 1]]))
    write_design_vtu(tmp_path / "design.vtu", state, MATERIAL)
    points, cells, fields, _ = read(tmp_path / "design.vtu")
    corner = points[cells]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    x, y = fields["axis_x"], np.cross(normal, fields["axis_x"])
    tensor = sum(
        fields[f"principal_{k}"][:, :, None] * fields[f"direction_{k}"][:, None, :] for k in (1, 2)
    )
    scale = np.abs(fields["n1"]).max()
    for name, (a, b) in {"nx": (x, x), "ny": (y, y), "nxy": (x, y)}.items():
        component = np.einsum("ca,cab,cb->c", a, tensor, b)
        assert np.allclose(component, fields[name], atol=1e-9 * scale)
    assert (fields["n1"] >= fields["n2"]).all()


def test_unstable_design_keeps_what_there_is(tmp_path):
    """Without displacement and utilization only geometry and thickness are written."""
    state = make_state(tmp_path, utilization=None, move=lambda x: np.nan * x)
    write_design_vtu(tmp_path / "design.vtu", state, MATERIAL)
    _, _, fields, nodal = read(tmp_path / "design.vtu")
    assert set(fields) == {"panel", "thickness", "thickness_class", "class_thickness"}
    assert set(nodal) == {"supported"}


def test_every_field_has_its_unit_and_meaning(tmp_path):
    """FieldData names each field once, with a unit; title, verdict and combinations are text."""
    state = make_state(tmp_path)
    factors = {"S1": {"SW": 1.4, "SDL": 1.4}}
    write_design_vtu(tmp_path / "design.vtu", state, MATERIAL, factors)
    grid = pyvista.read(tmp_path / "design.vtu")
    names = sorted([*grid.cell_data, *grid.point_data])
    assert sorted(line.split(" [")[0] for line in grid.field_data["units"]) == names
    assert sorted(line.split(" [")[0] for line in grid.field_data["legend"]) == names
    assert "n_S1 [kN/m]" in grid.field_data["units"] and "m_D2 [kNm/m]" in grid.field_data["units"]
    assert list(grid.field_data["title"]) == ["foldshell: final state of case"]
    assert "converged" in grid.field_data["verdict"]
    assert grid.field_data["combinations"][0] == "1: S1 = 1.4 SW + 1.4 SDL"
    assert list(grid.field_data["buckling_factor_of"]) == ["S1", "S2", "D2"]
    assert list(grid.field_data["buckling_factor"]) == [3.0, 2.0, 4.0]


def test_fields_of_every_combination_and_their_envelopes(tmp_path):
    """D2 moves ten times as far as the others, so its forces are ten times theirs."""
    state = make_state(tmp_path, move=lambda x: 1e-3 * np.sin(x + x[:, [2, 0, 1]]))
    write_design_vtu(tmp_path / "design.vtu", state, MATERIAL)
    _, _, fields, nodal = read(tmp_path / "design.vtu")
    for letter in "nmv":
        assert np.allclose(
            fields[f"{letter}_D2"], 10 * fields[f"{letter}_D1"], rtol=1e-4, atol=1e-3
        )
        assert np.array_equal(
            fields[f"{letter}_deflection_max"],
            np.maximum(fields[f"{letter}_D1"], fields[f"{letter}_D2"]),
        )
        assert np.array_equal(
            fields[f"{letter}_strength_min"],
            np.minimum(fields[f"{letter}_S1"], fields[f"{letter}_S2"]),
        )
    for k, name in enumerate(("nx", "ny", "nxy")):
        assert np.allclose(fields[name], fields["n_S2"][:, k], rtol=1e-6, atol=1e-4)
    assert {f"displacement_{c}" for c in ("S1", "S2", "D1", "D2")} <= set(nodal)
    modes = [name for name in nodal if name.startswith("buckling_mode_")]
    assert sorted(modes) == [f"buckling_mode_{c}" for c in ("D2", "S1", "S2")]
    assert np.linalg.norm(nodal["buckling_mode_S1"], axis=1).max() == 1


def test_same_state_same_bytes(tmp_path):
    """The file depends on the fields alone."""
    state = make_state(tmp_path)
    for name in ("a.vtu", "b.vtu"):
        write_design_vtu(tmp_path / name, state, MATERIAL)
    assert (tmp_path / "a.vtu").read_bytes() == (tmp_path / "b.vtu").read_bytes()


def test_lines_carry_force_and_level(tmp_path):
    """Stretched along x, shortened along y: kind 1 runs along x in tension, kind 2 along y."""
    state = make_state(
        tmp_path,
        folded=False,
        move=lambda x: np.column_stack([1e-3 * x[:, 0], -1e-3 * x[:, 1], 0 * x[:, 0]]),
    )
    view = make_design_view(state, 5.0, Sizing(), MATERIAL)
    write_lines_vtu(tmp_path / "lines.vtu", view)
    points, cells, fields, _ = read(tmp_path / "lines.vtu")
    step = points[cells[:, 1]] - points[cells[:, 0]]
    first, second = fields["kind"] == 1, fields["kind"] == 2
    assert first.sum() > 20
    assert second.sum() > 20
    assert np.abs(step[first][:, 1:]).max() < 1e-9
    assert np.abs(step[second][:, [0, 2]]).max() < 1e-9
    assert (fields["force"][first] > 0).all()
    assert (fields["force"][second] < 0).all()


def test_unstable_design_has_no_lines(tmp_path):
    """The file is there, with no cell in it."""
    state = make_state(tmp_path, utilization=None, move=lambda x: np.nan * x)
    view = make_design_view(state, 5.0, Sizing(), MATERIAL)
    write_lines_vtu(tmp_path / "lines.vtu", view)
    assert 'NumberOfCells="0"' in (tmp_path / "lines.vtu").read_text()
