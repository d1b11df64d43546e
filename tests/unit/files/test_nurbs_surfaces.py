"""NURBS of Rhino's files: evaluated against closed forms and Rhino's library, meshed by chord."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.files.meshes import rhino_child
from foldshell.files.meshes.model import MeshError
from foldshell.files.meshes.nurbs import MOST, evaluate_patch, make_patch, measure_sags, mesh_patch
from foldshell.files.meshes.surface import read_surface
from foldshell.files.meshes.triangles import find_border
from foldshell.folding.mesh_target import read_mesh_target

rhino = pytest.importorskip("rhino3dm")
EXACT = 2e-12  # m: some fifty roundings of 28 m
SPAN = 28.0


def make_arc(radius, half):
    """Rational quadratic of an arc about (0, 0), from -half to half: points (3, 2), weights (3,).

    Piegl and Tiller (1997), section 7.3: the middle weight is the cosine of the half angle.
    """
    ends = radius * np.array([[-math.sin(half), math.cos(half)], [math.sin(half), math.cos(half)]])
    middle = [0.0, radius / math.cos(half)]
    return np.array([ends[0], middle, ends[1]]), np.array([1.0, math.cos(half), 1.0])


def make_sphere(radius, half_x, half_y):
    """Homogeneous net (3, 3, 4) of a patch of a sphere about 0, its middle at (0, 0, radius).

    The arc in the plane y z is turned about the axis y, as in their section 8.5.
    """
    profile, weights = make_arc(radius, half_y)
    turn, turned = make_arc(1.0, half_x)
    weight = turned[:, None] * weights
    x, z = (turn[:, k, None] * profile[:, 1] for k in (0, 1))
    y = np.broadcast_to(profile[:, 0], x.shape)
    return np.stack([x * weight, y * weight, z * weight, weight], axis=-1)


def make_barrel(radius, half, length):
    """Homogeneous net (3, 2, 4) of a barrel about the axis y."""
    arc, weights = make_arc(radius, half)
    net = np.array([[(x, y, z, 1.0) for y in (-length / 2, length / 2)] for x, z in arc])
    return net * weights[:, None, None]


def move(net, scale=1.0, turn=0.0, offset=(0.0, 0.0, 0.0)):
    """Scale, turn about z, then move a homogeneous net."""
    c, s = math.cos(turn), math.sin(turn)
    matrix = np.eye(4)
    matrix[:3, :3] = scale * np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    matrix[:3, 3] = offset
    return net @ matrix.T


def make_surface(net, knots_u, knots_v):
    """The surface of Rhino's library with a homogeneous net and knots without both end knots."""
    count_u, count_v = net.shape[:2]
    orders = len(knots_u) - count_u + 2, len(knots_v) - count_v + 2
    surface = rhino.NurbsSurface.Create(3, True, *orders, count_u, count_v)
    for kept, values in ((surface.KnotsU, knots_u), (surface.KnotsV, knots_v)):
        for k, value in enumerate(values):
            kept[k] = float(value)
    for i in range(count_u):
        for j in range(count_v):
            surface.Points[i, j] = rhino.Point4d(*map(float, net[i, j]))
    assert surface.IsValid
    return surface


ARC, LINE = (0.0, 0.0, 1.0, 1.0), (0.0, 1.0)
CAP = make_sphere(25.0, 0.62, 0.65)  # 29.05 x 30.25 m along the middle
BARREL = make_barrel(20.0, 0.78, 28.4)


def save(path, *items, unit="Meters"):
    file = rhino.File3dm()
    file.Settings.ModelUnitSystem = getattr(rhino.UnitSystem, unit)
    for item in items:
        file.Objects.Add(item)
    assert file.Write(str(path), 7)
    return path


def take(surface):
    """The patch of a surface, by way of what is read from a face."""
    arrays = rhino_child._take_nurbs(SimpleNamespace(UnderlyingSurface=lambda: surface))
    return make_patch(arrays["points"], arrays["knots_u"], arrays["knots_v"])


@pytest.mark.parametrize("made", ["sphere", "cylinder"])
def test_surfaces_of_the_library_are_exact(made):
    """Whole sphere and cylinder as Rhino's library makes them: |x - c| = r to roundings."""
    middle = rhino.Point3d(3.0, -2.0, 5.0)
    if made == "sphere":
        surface = rhino.NurbsSurface.CreateFromSphere(rhino.Sphere(middle, 14.0))
    else:
        circle = rhino.Circle(middle, 14.0)
        surface = rhino.NurbsSurface.CreateFromCylinder(rhino.Cylinder(circle, 9.0))
    patch = take(surface)
    u, v = (np.linspace(s[0], s[-1], 37) for s in (patch.find_spans(0), patch.find_spans(1)))
    arm = evaluate_patch(patch, u, v) - [3.0, -2.0, 5.0]
    kept = arm if made == "sphere" else arm[..., :2]
    assert np.abs(np.linalg.norm(kept, axis=-1) - 14.0).max() < EXACT
    assert np.ptp(arm, axis=(0, 1)) == pytest.approx([28, 28, 28 if made == "sphere" else 9])


def test_any_knots_and_weights_agree_with_the_library():
    """Degrees 3 and 2, uneven, double and unclamped knots, uneven weights: Rhino's own PointAt."""
    rng = np.random.default_rng(4)
    net = rng.uniform(-10, 10, (7, 6, 4))
    net[..., 3] = rng.uniform(0.3, 4, (7, 6))
    knots_u = (-0.7, -0.1, 0.0, 0.4, 1.0, 1.0, 2.5, 2.7, 3.0)  # unclamped, double inside
    surface = make_surface(net, knots_u, (0.0, 0.0, 0.2, 0.9, 1.3, 2.0, 2.0))
    patch = take(surface)
    assert patch.degrees == (3, 2)
    assert patch.find_spans(0) == pytest.approx([0, 0.4, 1, 2.5])
    u, v = rng.uniform(0.0, 2.5, 30), rng.uniform(0.0, 2.0, 30)
    due = [[surface.PointAt(float(a), float(b)) for b in v] for a in u]
    due = np.array([[(p.X, p.Y, p.Z) for p in row] for row in due])
    assert np.abs(evaluate_patch(patch, u, v) - due).max() < EXACT * np.abs(due).max() / 10


@pytest.mark.parametrize(
    ("unit", "key", "metres"),
    [("Meters", "m", 1.0), ("Millimeters", "mm", 1e-3), ("Feet", "feet", 0.3048)],
)
@pytest.mark.parametrize("form", ["cap", "barrel"])
def test_targets_lie_on_the_surface_where_it_stands(tmp_path, form, unit, key, metres):
    """Turned and moved: vertices to 2e-12 m, points between them to 1e-5 of the span."""
    net, knots = (CAP, (ARC, ARC)) if form == "cap" else (BARREL, (ARC, LINE))
    offset, turn = np.array([120.0, -40.0, 7.0]), 0.0 if form == "barrel" else math.pi / 2
    moved = move(net, 1 / metres, turn, offset / metres)
    path = save(tmp_path / "a.3dm", make_surface(moved, *knots), unit=unit)
    surface = read_surface(path, SPAN, key)
    assert surface.middle == pytest.approx(tuple(offset[:2]), abs=1e-9)
    radius, axes = (25.0, [0, 1, 2]) if form == "cap" else (20.0, [0, 2])

    def miss(points):
        return np.abs(np.linalg.norm((points - offset)[..., axes], axis=-1) - radius).max()

    corners = surface.vertices[surface.triangles]
    between = [corners.mean(axis=1), *(corners[:, [k, k - 1]].mean(axis=1) for k in range(3))]
    assert miss(surface.vertices) < EXACT
    assert 1e-7 * SPAN < max(map(miss, between)) < 1e-5 * SPAN
    assert len(surface.vertices) < 120_000
    target = read_mesh_target(path, SPAN, key)
    assert target.origin == pytest.approx((*offset[:2], 0.0), abs=1e-9)
    places = np.array([[3.3, -9.1, 40.0], [-6.2, 4.7, 15.0]])
    closest, normals = target.find_closest(places + np.array([0, 0, offset[2]]))
    assert miss(closest + target.origin) < 1e-5 * SPAN
    arm = (closest - [0, 0, offset[2]]) * np.isin([0, 1, 2], axes)
    assert np.abs(normals - arm / np.linalg.norm(arm, axis=1)[:, None]).max() < 1e-3


def test_the_chord_error_is_that_of_the_caller():
    """A hundred times finer: ten times as many points along each curved side; lines stay lines."""
    patch = make_patch(BARREL, np.array(ARC), np.array(LINE))
    coarse, fine = (mesh_patch(patch, chord) for chord in (1e-2, 1e-4))
    sides = [len(np.unique(mesh.vertices[:, 0].round(9))) for mesh in (coarse, fine)]
    assert 7 < sides[1] / sides[0] < 12
    assert {len(np.unique(mesh.vertices[:, 1].round(9))) for mesh in (coarse, fine)} == {33}


def test_sags_of_a_saddle_and_a_dome():
    """z = x y sags under diagonals alone, by h2 / 4; z = x2 + 2 y2 by h2 / 4, h2 / 2, their sum."""
    along = np.linspace(-1, 1, 9)  # cells of h = 0.5
    x, y = np.meshgrid(along, along, indexing="ij")
    flat = measure_sags(np.stack([x, y, np.full_like(x, 2.0)], axis=-1))
    assert max(flat) < 1e-15
    u, v, diagonal = measure_sags(np.stack([x, y, 1e-6 * x * y], axis=-1))
    assert max(u, v) < 1e-20 and diagonal == pytest.approx(1e-6 * 0.25 / 4, rel=1e-6)
    u, v, diagonal = measure_sags(np.stack([x, y, 1e-6 * (x**2 + 2 * y**2)], axis=-1))
    assert [u, v, diagonal] == pytest.approx(1e-6 * np.array([0.25, 0.5, 0.75]) / 4, rel=1e-6)


def test_creases_are_lines_of_the_mesh(tmp_path):
    """A ridge at a knot of full multiplicity, u = 0.37: its height is kept to the last digits."""
    ridge = [(-14.0, 0.0), (-7.0, 1.0), (-3.0, 6.0), (5.0, 4.0), (14.0, 0.0)]
    net = np.array([[(x, y, z, 1.0) for y in (-14.0, 14.0)] for x, z in ridge])
    surface = make_surface(net, (0, 0, 0.37, 0.37, 1, 1), LINE)
    vertices = read_surface(save(tmp_path / "a.3dm", surface), SPAN).vertices
    assert np.isclose(vertices, [-3.0, 14.0, 6.0], rtol=0, atol=EXACT).all(axis=1).any()


def test_surfaces_of_revolution_are_exact(tmp_path):
    """Their NURBS form is the library's: an arc turned about a line 20 m below it is a torus."""
    arc = rhino.Arc(rhino.Point3d(-15, 0, 0.5), rhino.Point3d(0, 0, 12), rhino.Point3d(15, 0, 0.5))
    low = arc.Center.Z - 20.0
    axis = rhino.Line(rhino.Point3d(-1, 0, low), rhino.Point3d(1, 0, low))
    turned = rhino.RevSurface.Create(arc.ToNurbsCurve(), axis, -0.6, 0.6)
    x, y, z = read_surface(save(tmp_path / "a.3dm", turned), 21.0, sides=(28.0, 21.0)).vertices.T
    found = np.hypot(np.hypot(y, z - low) - 20.0, x)
    assert np.abs(found - arc.Radius).max() < EXACT
    assert np.ptp(y) == pytest.approx(2 * math.sin(0.6) * (20 + arc.Radius))


def test_a_dome_with_a_pole_and_a_seam_has_neither(tmp_path):
    """Half an arc turned right round: one border, the plan's, and one vertex at the apex."""
    ends = [rhino.Point3d(25 * math.sin(a), 0, 25 * math.cos(a)) for a in (0.0, 0.4, 0.8)]
    axis = rhino.Line(rhino.Point3d(0, 0, 0), rhino.Point3d(0, 0, 1))
    dome = rhino.RevSurface.Create(rhino.Arc(*ends).ToNurbsCurve(), axis, 0.0, 2 * math.pi)
    surface = read_surface(save(tmp_path / "a.3dm", dome), 25.0)
    edges, number = find_border(surface.triangles)
    border = surface.vertices[np.unique(edges[number == 1])]
    assert number.max() == 2 and np.abs(border[:, 2] - 25 * math.cos(0.8)).max() < EXACT
    assert (np.abs(surface.vertices - [0, 0, 25]).max(axis=1) < 1e-6).sum() == 1
    assert np.abs(np.linalg.norm(surface.vertices, axis=1) - 25).max() < EXACT


def cylinder(*caps):
    return rhino.Brep.CreateFromCylinder(
        rhino.Cylinder(rhino.Circle(rhino.Point3d(0, 0, 0), 14.0), 28.0), *caps
    )


@pytest.mark.parametrize(
    ("items", "unit", "key", "named"),
    [
        ((make_surface(CAP, ARC, ARC),), "Millimeters", "m", "in millimetres: metres are allowed"),
        ((make_surface(CAP, ARC, ARC),), "Meters", "feet", "in metres: feet are allowed"),
        ((make_surface(CAP, ARC, ARC),), "Microns", "mm", "in Microns: millimetres are allowed"),
        ((make_surface(CAP, ARC, ARC),) * 2, "Meters", "m", "several curved faces"),
        ((cylinder(True, True),), "Meters", "m", "several curved faces, or curved and planar"),
        ((make_surface(move(CAP, 1e-3), ARC, ARC),), "Meters", "m", "plan 0.02"),
        ((make_surface(move(CAP, 1e3), ARC, ARC),), "Meters", "m", "it looks like millimetres"),
        ((rhino.NurbsSurface.CreateFromSphere(rhino.Sphere(rhino.Point3d(0, 0, 0), 14.0)),),
         "Meters", "m", "a closed surface"),
    ],
)  # fmt: skip
def test_other_models_are_refused_in_a_sentence(tmp_path, items, unit, key, named):
    path = save(tmp_path / "a.3dm", *items, unit=unit)
    with pytest.raises(InputError, match=named) as caught:
        read_surface(path, SPAN, key)
    assert str(caught.value).startswith(str(path)) and "\n" not in str(caught.value)


def test_missing_and_damaged_files_are_refused(tmp_path):
    data = save(tmp_path / "a.3dm", make_surface(CAP, ARC, ARC)).read_bytes()
    (tmp_path / "cut.3dm").write_bytes(data[: len(data) // 3])
    for name, named in (("none", "no such file"), ("cut", "damaged|no mesh")):
        with pytest.raises(InputError, match=named):
            read_surface(tmp_path / f"{name}.3dm", SPAN)


def test_trimmed_surfaces_are_refused():
    """Rhino's library cannot trim a curved surface: a model that answers as one that is trimmed."""
    brep = SimpleNamespace(ObjectType="ObjectType.Brep", IsSurface=False,
                           Faces=[SimpleNamespace(IsPlanar=lambda tolerance: False)])  # fmt: skip
    item = SimpleNamespace(Attributes=SimpleNamespace(Visible=True, LayerIndex=0), Geometry=brep)
    with pytest.raises(MeshError, match="holds a trimmed surface"):
        rhino_child._read_model(SimpleNamespace(Layers=[], Objects=[item]), MeshError)


@pytest.mark.parametrize(
    ("weight", "knots", "named"),
    [
        (0.0, ARC, "control point 2, 3 of its surface"),
        (-1.0, ARC, "a positive weight"),
        (math.nan, ARC, "finite coordinates"),
        (1e300, ARC, "up to 1e"),
        (1.0, (0.0, 1.0, 0.0, 1.0), "knots along u"),
        (1.0, (0.0, 0.0, math.inf, math.inf), "knots along u"),
        (1.0, (1.0, 1.0, 1.0, 1.0), "knots along u"),
        (1.0, (0.0, 1.0), "knots along u"),
    ],
)
def test_damaged_nets_are_refused(weight, knots, named):
    net = CAP.copy()
    net[1, 2, 3] = weight
    with pytest.raises(MeshError, match=named):
        make_patch(net, np.array(knots), np.array(ARC))


def test_what_needs_too_many_points_is_refused():
    """A needle 1e6 m high over 30 m: the points would lie 1e-3 m apart at its tip."""
    patch = make_patch(CAP * [1, 1, 1e5, 1], np.array(ARC), np.array(ARC))
    with pytest.raises(MeshError, match=f"more than {MOST:,} points"):
        mesh_patch(patch, 1e-5 * SPAN)
