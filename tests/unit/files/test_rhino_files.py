"""Surfaces and panels from Rhino: meshes, one untrimmed surface, planar polysurfaces."""

import math

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.files.meshes.surface import read_surface
from foldshell.pattern.read_panels import read_panels

rhino = pytest.importorskip("rhino3dm")
ALONG = np.linspace(-3, 3, 9)


def height(x, y):
    return 1 - 0.04 * x**2 - 0.06 * y**2 + 0.01 * x * y


def make_mesh():
    mesh = rhino.Mesh()
    for x in ALONG:
        for y in ALONG:
            mesh.Vertices.Add(float(x), float(y), float(height(x, y)))
    for i in range(8):
        for j in range(8):
            k = 9 * i + j
            mesh.Faces.AddFace(k, k + 9, k + 10, k + 1)
    return mesh


def make_patch():
    """z of degree two in both directions: the control net that gives it exactly."""
    surface = rhino.NurbsSurface.Create(3, False, 3, 3, 3, 3)
    for knots in (surface.KnotsU, surface.KnotsV):
        for k, value in enumerate((0.0, 0.0, 1.0, 1.0)):
            knots[k] = value
    a, b, c, d = 1.0, -0.04, -0.06, 0.01
    for i, x in enumerate((-3.0, 0.0, 3.0)):
        for j, y in enumerate((-3.0, 0.0, 3.0)):
            # blossoms of x2: f(-3, -3) = 9, f(-3, 3) = -9, f(3, 3) = 9
            xx, yy = (9.0, -9.0, 9.0)[i], (9.0, -9.0, 9.0)[j]
            surface.Points[i, j] = rhino.Point4d(x, y, a + b * xx + c * yy + d * x * y, 1.0)
    return surface


def save(path, *items, unit="Meters"):
    file = rhino.File3dm()
    file.Settings.ModelUnitSystem = getattr(rhino.UnitSystem, unit)
    for item in items:
        file.Objects.Add(item)
    assert file.Write(str(path), 7)
    return path


def test_a_mesh_is_read(tmp_path):
    surface = read_surface(save(tmp_path / "a.3dm", make_mesh()), 6.0)
    x, y, z = surface.vertices.T
    assert len(surface.triangles) == 128 and np.abs(z - height(x, y)).max() < 1e-6  # single


def test_an_untrimmed_surface_is_read_in_double_precision(tmp_path):
    brep = rhino.Brep.CreateFromSurface(make_patch())
    surface = read_surface(save(tmp_path / "a.3dm", brep, rhino.LineCurve(
        rhino.Point3d(0, 0, 0), rhino.Point3d(9, 9, 9))), 6.0)  # fmt: skip
    x, y, z = surface.vertices.T
    assert np.abs(z - height(x, y)).max() < 1e-12 and np.ptp(x) == pytest.approx(6, abs=1e-12)
    with pytest.raises(InputError, match="a curved surface, sampled: a folded sheet has planar"):
        read_panels(tmp_path / "a.3dm")


def test_a_planar_polysurface_becomes_panels(tmp_path):
    """Four walls and a floor of a box without its lid, as a folded sheet."""
    box = rhino.Brep.CreateFromBox(
        rhino.Box(rhino.BoundingBox(rhino.Point3d(1, 2, 3), rhino.Point3d(3, 5, 7)))
    )
    mesh = read_panels(save(tmp_path / "a.3dm", box))
    assert len(mesh.panels) == 6 and len(mesh.vertices) == 8
    assert mesh.vertices.min(axis=0) == pytest.approx([1, 2, 3])
    millimetres = read_panels(save(tmp_path / "b.3dm", box, unit="Millimeters"), "mm")
    assert millimetres.vertices.max(axis=0) == pytest.approx([0.003, 0.005, 0.007])


@pytest.mark.parametrize(
    ("items", "unit", "named"),
    [
        ((), "Meters", "no mesh and no surface"),
        ((make_mesh(),), "Millimeters", "the model is in millimetres: metres are allowed"),
        ((make_mesh(), make_patch()), "Meters", "1 meshes and 1 surfaces"),
        ((make_patch(), make_patch()), "Meters", "several curved faces"),
        ((rhino.Brep.CreateFromSphere(rhino.Sphere(rhino.Point3d(0, 0, 0), 3.0)),), "Meters", "."),
        ((rhino.LineCurve(rhino.Point3d(0, 0, 0), rhino.Point3d(9, 9, 9)),), "Meters", "no mesh"),
    ],
)
def test_other_models_are_refused(tmp_path, items, unit, named):
    with pytest.raises(InputError, match=named) as caught:
        read_surface(save(tmp_path / "a.3dm", *items, unit=unit), 6.0)
    assert str(caught.value).startswith(str(tmp_path / "a.3dm"))


def test_damaged_files_are_refused(tmp_path):
    data = save(tmp_path / "a.3dm", make_mesh()).read_bytes()
    for name, part in (("cut", data[: len(data) // 2]), ("head", data[:40]), ("words", b"x" * 99)):
        (tmp_path / f"{name}.3dm").write_bytes(part)
        with pytest.raises(InputError, match=r"damaged|no mesh|XML|is a"):
            read_surface(tmp_path / f"{name}.3dm", 6.0)
    (tmp_path / "named.obj").write_bytes(data)
    with pytest.raises(InputError, match=r"its content is 3DM, its name says \.obj"):
        read_surface(tmp_path / "named.obj", 6.0)
    assert math.isfinite(len(data))
