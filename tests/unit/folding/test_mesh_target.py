"""Free-form targets: distances against the exact surface, folding onto three meshes, refusals."""

import numpy as np
import pytest
import pyvista

from foldshell.files.errors import InputError
from foldshell.folding.fold import fold_sheet
from foldshell.folding.quadric import make_quadric
from foldshell.folding.targets import make_target
from foldshell.pattern.design import design_sheet
from foldshell.settings.fold import Fold

SHAPES = {
    "bumps.stl": lambda x, y: (
        3 * np.exp(-((x - 4) ** 2 + (y + 3) ** 2) / 90)
        + 4 * np.exp(-((x + 6) ** 2 + (y - 5) ** 2) / 120)
    ),
    "wave.vtu": lambda x, y: 1.2 * np.sin(x / 6) + 0.8 * np.cos(y / 7) + 0.02 * x * y,
    "skew.ply": lambda x, y: 6 - 0.012 * x**2 - 0.02 * y**2 + 0.008 * x * y + 0.0006 * x**3,
    "barrel.obj": lambda x, y: 5 * np.cos(x / 10) * (1 + 0.02 * y),
    "dome.vtk": lambda x, y: 9 * np.cos(np.pi * x / 40) * np.cos(np.pi * y / 44),
}


def write_surface(path, height, span=28.0, points=90, margin=1.02, scale=1.0):
    """Triangulate z = height(x, y) over a square and save it in the suffix's format."""
    along = np.linspace(-span / 2 * margin, span / 2 * margin, points)
    x, y = np.meshgrid(along, along)
    mesh = pyvista.StructuredGrid(x * scale, y * scale, height(x, y) * scale)
    mesh = mesh.extract_surface(algorithm=None).triangulate()
    if path.suffix == ".vtu":
        mesh = mesh.cast_to_unstructured_grid()
    mesh.save(path)
    return mesh


def test_distances_are_those_of_the_surface(tmp_path):
    """A fine mesh of the paraboloid; facets of 0.32 m sag h2 / 8 R = 7e-4 m below it."""
    exact = make_quadric("paraboloid", 28, 10)
    path = tmp_path / "p.stl"
    write_surface(path, exact.evaluate_height)
    target = make_target(str(path), 28.0, 10.0)
    rng = np.random.default_rng(2)
    x, y = rng.uniform(-13, 13, (2, 300))
    foot = np.column_stack([x, y, exact.evaluate_height(x, y)])
    normals = exact.find_normals(x, y)
    offset = rng.uniform(-2, 2, 300)
    closest, found = target.find_closest(foot + offset[:, None] * normals)
    distance = np.einsum("ij,ij->i", found, foot + offset[:, None] * normals - closest)
    assert np.abs(distance - offset).max() < 2e-3
    assert np.abs(found - normals).max() < 2e-2
    assert target.section_lengths() == pytest.approx(exact.section_lengths(), rel=1e-4)
    assert np.abs(target.evaluate_height(x, y) - foot[:, 2]).max() < 2e-3


@pytest.mark.parametrize("name", SHAPES)
def test_sheets_follow_free_forms(tmp_path, name):
    """rms <= 1e-3 span in elastic mode; constraints 1e-9 in exact mode."""
    write_surface(tmp_path / name, SHAPES[name])
    _assert_followed(tmp_path / name, 15, 16)


def _lay_out(path, zigzag, strip):
    target = make_target(str(path), 28.0, 10.0)
    return design_sheet("miura", target.section_lengths(), zigzag, strip, 60.0, 0), target


def _assert_followed(path, zigzag, strip):
    sheet, target = _lay_out(path, zigzag, strip)
    soft = fold_sheet(sheet, target, "elastic", Fold())
    assert soft.state == "ok" and soft.quality.rms_over_span <= 1e-3
    _assert_exact(sheet, target)


def _assert_exact(sheet, target):
    true = fold_sheet(sheet, target, "exact", Fold())
    assert true.state == "ok", true.reason
    assert true.shape.residuals["constraint_residual"] <= 1e-9
    assert true.shape.residuals["unfold_closure_m"] <= 1e-9
    assert true.quality.max_over_span <= 1e-9


@pytest.mark.slow
def test_waves_too_short_for_a_coarse_soft_sheet(tmp_path):
    """Its folds are about as deep as the radius of 3 m: it draws in, and is not called ok."""
    write_surface(tmp_path / "a.ply", lambda x, y: 1.5 * np.sin(x / 2.2) + 0 * y)
    sheet, target = _lay_out(tmp_path / "a.ply", 15, 16)
    soft = fold_sheet(sheet, target, "elastic", Fold())
    assert soft.state == "crumpled" and "plan coverage 0.65" in soft.reason
    _assert_exact(sheet, target)
    _assert_followed(tmp_path / "a.ply", 30, 16)


OTHER_SHAPES = {
    "vault.obj": lambda x, y: (6 + 1.5 * np.sin(y / 9)) * np.cos(np.pi * x / (40 + 0.3 * y)),
    "bumpy.ply": lambda x, y: (
        4 - 0.01 * (x**2 + y**2) + 0.8 * np.sin(x / 3.5 + 1) * np.cos(y / 4.2)
        + 0.5 * np.sin((x + y) / 5)
    ),
    "patch.vtu": lambda x, y: np.sqrt(900 - (x - 6) ** 2 - (y + 5) ** 2) - 20,
    "ridge.stl": lambda x, y: 5 * np.exp(-(((x + y) / 12) ** 2)) - 0.008 * (x - y) ** 2,
}  # fmt: skip


def _shuffle(mesh, seed=1):
    """Renumber vertices, reorder and turn triangles, and turn half of them over."""
    rng = np.random.default_rng(seed)
    faces = mesh.faces.reshape(-1, 4)[:, 1:]
    order = rng.permutation(mesh.n_points)
    faces = np.argsort(order)[faces][rng.permutation(len(faces))]
    faces = np.array([np.roll(face, rng.integers(3)) for face in faces])
    over = rng.random(len(faces)) < 0.5
    faces[over] = faces[over][:, ::-1]
    return pyvista.PolyData.from_regular_faces(np.asarray(mesh.points)[order], faces)


@pytest.mark.verification
@pytest.mark.parametrize("name", OTHER_SHAPES)
def test_sheets_follow_shuffled_free_forms(tmp_path, name):
    """A vault of changing curvature, a bumpy sheet, a dome off its centre, a slanting ridge."""
    mesh = _shuffle(write_surface(tmp_path / "whole.stl", OTHER_SHAPES[name]))
    if name.endswith(".vtu"):
        mesh = mesh.cast_to_unstructured_grid()
    mesh.save(tmp_path / name)
    for zigzag, strip in ((15, 16), (30, 16)):
        _assert_followed(tmp_path / name, zigzag, strip)


def test_a_mesh_beside_the_origin_is_centred(tmp_path):
    mesh = write_surface(tmp_path / "a.stl", SHAPES["dome.vtk"])
    mesh.translate([100.0, -40.0, 3.0]).save(tmp_path / "b.stl")
    one, two = (make_target(str(tmp_path / k), 28.0, 10.0) for k in ("a.stl", "b.stl"))
    x, y = np.array([3.0, -9.0]), np.array([5.0, 2.0])
    # binary STL is single precision: 100 m carries 4e-6 m
    assert two.evaluate_height(x, y) - 3 == pytest.approx(one.evaluate_height(x, y), abs=1e-4)


def _refuse(path, named):
    with pytest.raises(InputError, match=named):
        make_target(str(path), 28.0, 10.0)


def test_missing_and_damaged_files_are_refused(tmp_path):
    _refuse(tmp_path / "none.stl", "no such file")
    (tmp_path / "empty.stl").write_bytes(b"")
    _refuse(tmp_path / "empty.stl", "empty")
    (tmp_path / "text.ply").write_text("this is not a mesh")
    _refuse(tmp_path / "text.ply", "text.ply")
    write_surface(tmp_path / "a.vtu", SHAPES["wave.vtu"])
    whole = (tmp_path / "a.vtu").read_bytes()
    (tmp_path / "cut.vtu").write_bytes(whole[: len(whole) // 2])
    _refuse(tmp_path / "cut.vtu", "cut")


def test_wrong_scale_is_refused_with_a_hint(tmp_path):
    write_surface(tmp_path / "mm.stl", SHAPES["wave.vtu"], scale=1000.0)
    _refuse(tmp_path / "mm.stl", "millimetres")
    write_surface(tmp_path / "small.stl", SHAPES["wave.vtu"], span=20.0)
    _refuse(tmp_path / "small.stl", "span of 28")


def test_closed_doubled_and_holed_surfaces_are_refused(tmp_path):
    pyvista.Sphere(radius=15.0).save(tmp_path / "ball.stl")
    _refuse(tmp_path / "ball.stl", "closed")
    mesh = write_surface(tmp_path / "a.stl", SHAPES["dome.vtk"])
    (mesh + mesh.translate([0, 0, 2.0])).extract_surface(algorithm=None).save(tmp_path / "two.stl")
    _refuse(tmp_path / "two.stl", "over itself")
    centre = mesh.cell_centers().points
    keep = np.hypot(centre[:, 0] - 5, centre[:, 1]) > 3
    mesh.extract_cells(keep).extract_surface(algorithm=None).save(tmp_path / "hole.stl")
    _refuse(tmp_path / "hole.stl", "no surface above")


def test_damaged_triangles_are_refused(tmp_path):
    """Each file differs from a good one by a vertex, a triangle or a row of walls."""
    mesh = write_surface(tmp_path / "a.stl", SHAPES["dome.vtk"], points=40)
    points, faces = np.asarray(mesh.points, dtype=float), mesh.faces.reshape(-1, 4)[:, 1:]

    def write(name, points, faces):
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
        lines += [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
        (tmp_path / name).write_text("\n".join(lines) + "\n")
        return tmp_path / name

    make_target(str(write("good.obj", points, faces)), 28.0, 10.0)
    broken = points.copy()
    broken[50, 2] = np.nan
    _refuse(write("nan.obj", broken, faces), "not finite")
    _refuse(write("far.obj", points, np.vstack([faces, [[0, 1, 10**6]]])), "vertex 999999|1000000")
    fin = np.vstack([points, [[0.0, 0.0, 20.0]]])
    third = np.vstack([faces, [[*faces[900, :2], len(points)]]])
    _refuse(write("fin.obj", fin, third), "three or more triangles")
    step = points * [1, 1, 0] + np.outer(points[:, 0] > 2, [0, 0, 12])
    _refuse(write("wall.obj", step, faces), "steeper than 85 deg")
    _refuse(write("up.obj", points[:, [0, 2, 1]], faces), "must cover the span")
    _refuse(write("none.obj", points, faces[:0]), "0 triangles")
