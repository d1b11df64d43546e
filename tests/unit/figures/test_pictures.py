"""Pictures: what is in them follows the fields, and nothing else."""

import numpy as np
import pytest
from PIL import Image

from figure_cases import make_state
from foldshell.figures.camera import fit_camera
from foldshell.figures.figure_specs import describe_verdict
from foldshell.figures.layout import Caption, compose, load_font, save_png, view_size, wrap
from foldshell.figures.load_path_figures import (
    specify_buckling,
    specify_isolines,
    specify_principal_stress_lines,
)
from foldshell.figures.pictures import (
    draw_design,
    specify_displacement,
    specify_strain,
    specify_thickness,
    specify_utilization,
)
from foldshell.figures.render import render_scenes
from foldshell.figures.scene import Lines, Scene
from foldshell.results.colour_scales import ABOVE, COMPRESSION, TENSION, exaggeration
from foldshell.results.design_view import make_design_view
from foldshell.settings.material import Material
from foldshell.settings.sizing import Sizing
from record_cases import make_analysis

SIZE = (640, 480)
LIMITS, MATERIAL = Sizing(), Material()


def subject_of(folder, **options):
    """Return a case as the view of pictures."""
    return make_design_view(make_state(folder, **options), 5.0, LIMITS, MATERIAL)


def share_near(image, colour, distance=30):
    """Share of pixels within a distance of a colour in each channel."""
    near = np.abs(np.asarray(image).astype(int) - np.array(colour)).max(axis=-1) <= distance
    return near.mean()


def test_each_picture_shows_its_own_field(tmp_path):
    """All eight are different from each other, and none is blank: ink on white in the view."""
    pictures = draw_design(
        subject_of(tmp_path),
        SIZE,
        ("thickness", "utilization", "displacement", "planarity", "strain",
         "principal_stress_lines", "isolines", "buckling"),
    )  # fmt: skip
    top, bottom = round(0.165 * SIZE[1]), round(0.85 * SIZE[1])
    views = {name: np.asarray(picture)[top:bottom] for name, picture in pictures.items()}
    for name, view in views.items():
        assert (view < 250).any(axis=-1).mean() > 0.1, name
        for other in views:
            assert other == name or (views[other] != view).any(axis=-1).mean() > 0.005


def test_utilization_above_the_limit_is_red(tmp_path):
    """0.9 everywhere leaves no red in the view, 1.1 everywhere makes the sheet red."""
    found = {}
    for value in (0.9, 1.1):
        (tmp_path / str(value)).mkdir()
        scene = specify_utilization(subject_of(tmp_path / str(value), utilization=value)).scene
        camera = fit_camera(scene.points, 4 / 3)
        found[value] = share_near(render_scenes([scene], [camera], (400, 300))[0], ABOVE, 60)
    assert found[0.9] == 0
    assert found[1.1] > 0.1


def test_rendered_triangle_is_where_the_camera_projects_it():
    """A red triangle covers the pixels that its projection covers, within its border's pixels."""
    points = np.array([[0.0, 0, 0], [2, 0.3, 0.2], [0.4, 1.5, 0.6]])
    camera = fit_camera(points, 1.0)
    red = np.array([[220, 0, 0]], dtype=np.uint8)
    image = render_scenes([Scene(points, np.array([[0, 1, 2]]), red)], [camera], (200, 200))[0]
    a, b, c = (camera.project(points) * [1, -1] + 1) * 100
    area = abs((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]) / 2
    assert (image[..., 1] < 128).sum() == pytest.approx(area, rel=0.03)


def test_a_scene_far_from_the_origin_looks_like_one_near_it():
    """On a national grid single precision has 0.5 m left: the picture must not know it."""
    rng = np.random.default_rng(3)
    points, triangles = rng.uniform(-3, 3, (30, 3)), rng.integers(0, 30, (20, 3))
    colours = rng.integers(0, 255, (20, 3), dtype=np.uint8)
    images = []
    for place in (np.zeros(3), np.array([690_000.0, 5_334_000.0, 520.0])):
        moved = points + place
        line = Lines(moved[:4][None], (0, 0, 0), 2.0)
        scene = Scene(moved, triangles, colours, (line,), moved[:2], 0.3)
        camera = fit_camera(moved, SIZE[0] / SIZE[1])
        images += render_scenes([scene], [camera], SIZE)
    differ = (np.abs(images[0].astype(int) - images[1]) > 30).any(axis=-1).mean()
    assert (images[0] < 250).any(axis=-1).mean() > 0.1 and differ < 0.002


def test_second_scene_is_not_the_first_again():
    """Scenes drawn in one window do not leak into each other."""
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    scenes = [
        Scene(points, np.array([[0, 1, 2]]), np.array([colour], dtype=np.uint8))
        for colour in ((200, 0, 0), (0, 0, 200), (200, 0, 0))
    ]
    first, second, third = render_scenes(scenes, [fit_camera(points, 1.0)] * 3, (120, 120))
    assert (first != second).any()
    assert np.array_equal(first, third)


def test_same_state_same_bytes(tmp_path):
    """A picture is the same file when it is drawn again."""
    view = subject_of(tmp_path)
    for name in ("a", "b"):
        picture = draw_design(view, SIZE, ("thickness",))["thickness"]
        save_png(tmp_path / f"{name}.png", picture)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_displaced_shape_is_drawn_by_its_stated_factor(tmp_path):
    """w = -1e-3 x2: points of the scene are nodes plus factor times that, and the words say so."""
    view = subject_of(tmp_path)
    spec = specify_displacement(view)
    nodes = view.state.cells.nodes
    drop = 1e-3 * nodes[:, 0] ** 2
    factor = exaggeration(np.column_stack([drop, 0 * drop, 0 * drop]), 5.0)
    assert 0.03 * 5 < factor * drop.max() < 0.12 * 5
    assert np.allclose(spec.scene.points[:, 2], nodes[:, 2] - factor * drop, atol=1e-12)
    assert f"D2: at most {1e3 * drop.max():.1f} mm down" in spec.caption.lines[0]
    assert f"drawn {factor:g} times" in spec.caption.lines[0]
    assert "limit 20.8 mm" in spec.caption.lines[0]


def test_tension_and_compression_have_their_colours(tmp_path):
    """A flat sheet stretched along x and shortened along y: lines of both colours."""
    view = subject_of(
        tmp_path,
        folded=False,
        move=lambda x: np.column_stack([1e-3 * x[:, 0], -1e-3 * x[:, 1], 0 * x[:, 0]]),
    )
    lines = {line.colour: 0 for line in specify_principal_stress_lines(view).scene.lines}
    for line in specify_principal_stress_lines(view).scene.lines:
        lines[line.colour] += len(line.points)
        if line.colour in (TENSION, COMPRESSION) and len(line.points):
            step = np.abs(line.points[:, 1] - line.points[:, 0])
            across = 1 if line.colour == TENSION else 0
            assert step[:, across].max() < 1e-9
    assert lines[TENSION] > 20
    assert lines[COMPRESSION] > 20


def test_sheet_that_carries_by_bending_has_no_force_lines(tmp_path):
    """A flat sheet that only moves down has no membrane force; the picture says so."""
    spec = specify_principal_stress_lines(subject_of(tmp_path, folded=False))
    assert "bending alone" in spec.caption.lines[0]


def test_design_without_results_says_what_is_missing(tmp_path):
    """An unstable design: thickness is drawn, the others say why they are empty."""
    view = subject_of(
        tmp_path, utilization=None, move=lambda x: np.nan * x, verdict="unstable",
        reason="buckling factor 0.7 of S1 is below 1", buckling_factor={"S1": None},
    )  # fmt: skip
    assert specify_utilization(view).caption.lines[0] == "no utilization"
    assert specify_displacement(view).caption.lines[0] == "no displacement"
    assert specify_isolines(view).caption.lines[0] == "no utilization"
    assert specify_buckling(view).caption.lines[0] == "no buckling mode"
    assert "no membrane forces" in specify_principal_stress_lines(view).caption.lines[0]
    for spec in (specify_thickness, specify_displacement):
        assert spec(view).caption.lines[-1] == (
            "unstable by the paper's criteria after 4 analyses: "
            "buckling factor 0.7 of S1 is below 1"
        )


def test_buckling_mode_is_that_of_the_least_factor(tmp_path):
    """S2 has the least factor, 2.0; the mode is scaled to 1, zero at supported nodes."""
    view = subject_of(tmp_path)
    assert specify_buckling(view).caption.lines[0].startswith("S2: buckling factor 2.00")
    mode = view.state.buckling_mode("S2")
    assert np.linalg.norm(mode, axis=1).max() == pytest.approx(1)
    vertices = np.unique(view.state.shell.support_pairs)
    assert np.abs(mode[vertices]).max() < 1e-12  # interpolated from the nodes: rounding is left


def test_long_words_are_broken_not_shrunk():
    """Every line fits; no word is lost."""
    font = load_font(20)
    text = "every panel stands at the least thickness of 40 mm " * 4
    lines = wrap(text, font, 300)
    assert all(font.getlength(line) <= 300 for line in lines)
    assert " ".join(lines) == text.strip()
    assert describe_verdict(make_analysis(verdict="not_converged", reason="", iteration=29)) == (
        "not converged by the paper's criteria after 30 analyses"
    )
    assert describe_verdict(make_analysis(verdict="unstable", reason="a mechanism")) == (
        "unstable by the paper's criteria after 1 analysis: a mechanism"
    )


def test_words_do_not_cover_the_view():
    """The rendered view appears unchanged in the picture, but for the corner with the axes."""
    view = np.random.default_rng(5).integers(0, 255, (*view_size(SIZE)[::-1], 3), dtype=np.uint8)
    picture = compose(view, Caption("title", ("a", "b", "c"), "x [m]"), np.eye(3)[:, :2], SIZE)
    assert isinstance(picture, Image.Image)
    top = round(0.165 * SIZE[1])
    inside = np.asarray(picture)[top : top + view.shape[0]]
    corner = view.shape[1] // 4
    assert np.array_equal(inside[:, corner:], view[:, corner:])


def test_strain_stands_in_its_facet(tmp_path):
    """Strain rises from facet to facet; the cells of a facet have its colour, others have not."""
    view = subject_of(tmp_path)
    spec = specify_strain(view)
    scale = spec.caption.scale
    facet = np.repeat(view.state.mesh.facet, view.state.cells.order**2)
    expected = scale.colour(100 * np.linspace(0, 0.02, 40))[facet]
    assert np.array_equal(spec.scene.colours, expected)
    assert scale.high == pytest.approx(2.0)
