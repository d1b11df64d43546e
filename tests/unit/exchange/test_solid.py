"""The thickened solid: closed, and as large as its panels less their mitres."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial import ConvexHull, HalfspaceIntersection

from export_cases import CASES, make_export_model
from foldshell.exchange.model import Panel
from foldshell.exchange.sides import list_sides
from foldshell.exchange.solid import fold_tangents, thicken
from foldshell.files.errors import InputError

trimesh = pytest.importorskip("trimesh")


def mitred_volume(model):
    """Return the sum of all faces' slabs between their two offset planes, each cut by the planes
    that halve the angles at its folds.

    The plane at an edge holds the edge and the sum of both normals: made anew from the geometry,
    not from the solid's own shifts.
    """
    sides, total = list_sides(model), 0.0
    for rows in np.split(np.arange(len(sides.face)), np.flatnonzero(np.diff(sides.face)) + 1):
        normal, half = sides.normal[rows[0]], sides.thickness[rows[0]] / 2
        middle = model.vertices[sides.start[rows]].mean(axis=0)
        planes = [[*normal, -normal @ middle - half], [*-normal, normal @ middle - half]]
        for row in rows:
            start = model.vertices[sides.start[row]]
            along = model.vertices[sides.stop[row]] - start
            beyond = sides.twin[row]
            up = normal + (sides.normal[beyond] if beyond >= 0 else 0)
            out = np.cross(along, up)
            out /= np.linalg.norm(out)
            planes.append([*out, -out @ start])
        hull = HalfspaceIntersection(np.array(planes), middle)
        total += ConvexHull(hull.intersections).volume
    return total


@pytest.mark.parametrize("case", CASES)
def test_solid_is_closed_and_as_large_as_its_mitred_panels(tmp_path, case):
    """Watertight, turned outwards; caps at vertices are all that may differ: 0.1 %."""
    model = make_export_model(tmp_path, **CASES[case])
    solid = thicken(model)
    mesh = trimesh.Trimesh(solid.points, solid.triangles, process=False)
    assert mesh.is_watertight and mesh.is_winding_consistent and mesh.body_count == 1
    assert mesh.volume == pytest.approx(mitred_volume(model), rel=1e-3)
    assert solid.volume == pytest.approx(mesh.volume, rel=1e-12)
    assert set(solid.panel) == set(range(len(model.panels)))


def test_two_squares_and_a_fold():
    """Two unit squares at a right angle, 0.1 thick: 2 x 0.1 with the mitre symmetric, exactly."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 1], [1, 1, 1.0]])
    facets = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]])
    panels = tuple(
        Panel(
            k, np.array(ring), np.array([2 * k, 2 * k + 1]), np.empty((0, 2)), np.empty(0), 0, 0.1
        )
        for k, ring in enumerate(([0, 1, 2, 3], [1, 4, 5, 2]))
    )
    corners = vertices[facets]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    model = SimpleNamespace(
        design="l", vertices=vertices, facets=facets, panels=panels, area_vectors=area
    )
    tangents = fold_tangents(vertices, list_sides(model))
    assert np.sort(tangents)[-2:] == pytest.approx([1, 1])  # a valley of 90 deg
    solid = thicken(model)
    assert solid.volume == pytest.approx(0.2, rel=1e-12)
    low, high = solid.points.min(axis=0), solid.points.max(axis=0)
    assert low == pytest.approx([0, 0, -0.05]) and high == pytest.approx([1.05, 1, 1])


def test_panel_too_thick_for_its_folds_is_named(tmp_path):
    model = make_export_model(tmp_path, thickness=np.full(20, 1.5))
    with pytest.raises(InputError, match=r"panel P\d+: 1500 mm: too thick"):
        thicken(model)
