"""VTU files: two other readers find every value in its place."""

import meshio
import numpy as np
import pytest
import pyvista

from foldshell.exchange.vtu import write_vtu

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 1 / 3]], dtype=float)


@pytest.mark.parametrize("cells", [[[0, 1, 2], [0, 2, 3]], [[0, 1], [1, 2], [2, 3]]])
def test_meshio_and_vtk_read_the_same_values(tmp_path, cells):
    """Doubles come back bit by bit, whole numbers as they were, vectors by component."""
    cells = np.array(cells)
    rng = np.random.default_rng(1)
    nodal = {"vector": rng.normal(size=(4, 3)), "flag": np.arange(4, dtype=np.int32)}
    fields = {"value": rng.normal(size=len(cells)), "number": np.arange(len(cells))}
    path = tmp_path / "a.vtu"
    write_vtu(path, POINTS, cells, nodal, fields)
    mesh, grid = meshio.read(path), pyvista.read(path)
    assert np.array_equal(mesh.points, POINTS)
    assert np.array_equal(grid.points, POINTS)
    assert np.array_equal(mesh.cells[0].data, cells)
    assert np.array_equal(grid.cells.reshape(len(cells), -1)[:, 1:], cells)
    for name, values in nodal.items():
        assert np.array_equal(mesh.point_data[name], values)
        assert np.array_equal(grid.point_data[name], values)
    for name, values in fields.items():
        assert np.array_equal(mesh.cell_data[name][0], values)
        assert np.array_equal(grid.cell_data[name], values)


def test_large_arrays_and_none_at_all(tmp_path):
    """One block of a megabyte is read; a file without cells has none."""
    points = np.random.default_rng(2).normal(size=(50_000, 3))
    cells = np.arange(49_998).reshape(-1, 3)
    write_vtu(tmp_path / "large.vtu", points, cells, {}, {})
    assert np.array_equal(pyvista.read(tmp_path / "large.vtu").points, points)
    write_vtu(tmp_path / "none.vtu", np.empty((0, 3)), np.empty((0, 2), dtype=int), {}, {})
    assert pyvista.read(tmp_path / "none.vtu").n_cells == 0
