"""What is reported of a folded sheet is measured on the vertices that are written."""

import numpy as np
import pytest

from folding_cases import fold_case
from foldshell.folding.constraints import require_planar
from foldshell.folding.exact import project_vertices
from foldshell.folding.fold import fold_sheet, judge_shape
from foldshell.folding.quality import measure_quality
from foldshell.folding.shape import Shape
from foldshell.folding.targets import make_target
from foldshell.pattern.design import design_sheet
from foldshell.pattern.unfold import unfold_panels
from foldshell.settings.fold import Fold
from record_cases import make_quality


def write_dome(path, span=5.0, points=25, noise=0.02, seed=1, corner=(0.0, 0.0, 0.0)):
    """A dome over [0, span]2 from `corner`, of quadrilaterals, with noise in its heights [m]."""
    along = np.linspace(-0.01 * span, 1.01 * span, points)
    x, y = np.meshgrid(along, along)
    u, v = x - span / 2, y - span / 2
    z = 0.4 * span * np.cos(np.pi * u / (1.45 * span)) * np.cos(np.pi * v / (1.5 * span))
    z += noise * np.random.default_rng(seed).normal(size=z.shape)
    number = np.arange(points**2).reshape(points, points)
    quads = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], -1)
    rows = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) + corner
    lines = [f"v {a!r} {b!r} {c!r}" for a, b, c in rows.tolist()]
    lines += ["f " + " ".join(map(str, quad)) for quad in (quads.reshape(-1, 4) + 1).tolist()]
    path.write_text("\n".join(lines) + "\n")
    return str(path)


def fold_onto(path, mode, span=5.0, zigzag=15, strip=16):
    target = make_target(path, span, 1.0)
    sheet = design_sheet("miura", target.section_lengths(), zigzag, strip, 60.0, 0)
    return sheet, target, fold_sheet(sheet, target, mode, Fold())


@pytest.mark.parametrize("seed", [1, 2])
def test_exact_mode_on_a_noisy_dome_writes_what_it_measured(tmp_path, seed):
    """Projections that stop above 1e-12: state, residual and vertices belong together."""
    sheet, _, result = fold_onto(write_dome(tmp_path / "a.obj", seed=seed), "exact")
    closure = unfold_panels(result.shape.vertices, sheet.grid).closure
    assert result.state == "ok", result.reason
    assert closure <= 1e-9 and result.shape.residuals["unfold_closure_m"] <= 1e-9
    assert result.quality.angle_defect_max_rad <= 1e-9
    assert result.quality.planarity_max <= 1e-9


def test_a_projection_that_ends_early_returns_the_state_of_its_residual():
    sheet, _, result = fold_case("paraboloid", 28, 10, 15, 16)
    planar = require_planar(sheet.grid, sheet.rest, 1.0, 1.0)
    stopped = project_vertices([planar], result.shape.vertices, max_iterations=3)
    again = float(np.abs(planar.evaluate(stopped.vertices)[0]).max())
    assert stopped.residual == again > 1e-12
    assert stopped.residual < float(np.abs(planar.evaluate(result.shape.vertices)[0]).max())


def test_iterations_that_end_within_the_limits_are_ok():
    """The arch meets its tolerance after 8 iterations, and hardly moves after five of them."""
    result = fold_case("arch", 28, 10, 15, 16, max_iterations=5)[2]
    assert "stopped at the limit of 5 iterations" in result.reason
    assert result.quality.rms_over_span < 1e-4 and result.state == "ok"


def test_what_is_no_number_is_not_ok():
    quality = make_quality(plan_coverage=0.0)
    shape = Shape(np.zeros((1, 3)), np.zeros((1, 3)), 1, True, "settled")
    assert judge_shape(shape, quality, 2e-3, 0.8, "elastic")[0] == "crumpled"  # coverage 0
    lost = make_quality(rms_over_span=float("nan"))
    assert judge_shape(shape, lost, 2e-3, 0.0, "elastic")[0] == "not_reached"


@pytest.mark.parametrize("mode", ["elastic", "exact", "isometric"])
@pytest.mark.parametrize("corner", [(0.0, 0.0, 0.0), (690_000.0, 5_334_000.0, 520.0)])
def test_a_sheet_stands_where_its_surface_stands(tmp_path, corner, mode):
    """Once with its corner at the origin, once on a national grid [m]."""
    path = write_dome(tmp_path / "a.obj", noise=0.0, corner=corner)
    sheet, target, result = fold_onto(path, mode)
    assert target.origin == pytest.approx((corner[0] + 2.5, corner[1] + 2.5, 0.0), abs=1e-6)
    vertices = result.shape.vertices - corner
    middle = 0.5 * (vertices.min(axis=0) + vertices.max(axis=0))
    assert middle[:2] == pytest.approx([2.5, 2.5], abs=0.25)
    points = vertices[result.attracted]
    u, v = points[:, 0] - 2.5, points[:, 1] - 2.5
    height = 2 * np.cos(np.pi * u / 7.25) * np.cos(np.pi * v / 7.5)
    inside = (np.abs(u) < 2.5) & (np.abs(v) < 2.5)
    if mode != "isometric":  # no isometry leads to a dome
        assert result.state == "ok", result.reason
        # facets of 0.21 m sag by h2 / 8 R = 2e-3 m below the dome of 2.6 m radius
        assert np.abs(points[:, 2] - height)[inside].max() < 5e-3
    # Measured on the written vertices: the numbers come out again from them, but for the
    # subtraction of the middle.
    again = measure_quality(
        result.shape.vertices - target.origin, sheet.grid, result.shape.flat,
        result.distances[result.attracted], target.span,
    )  # fmt: skip
    assert again == result.quality


def test_residuals_know_what_writing_costs(tmp_path):
    """At 5,334 km doubles are 9e-10 m apart: the closure that is told is the written sheet's."""
    path = write_dome(tmp_path / "a.obj", noise=0.0, corner=(690_000.0, 5_334_000.0, 520.0))
    sheet, _, result = fold_onto(path, "exact")
    closure = unfold_panels(result.shape.vertices, sheet.grid).closure
    told = result.shape.residuals["unfold_closure_m"]
    assert 1e-10 < closure < 1e-5 and told == pytest.approx(closure, rel=0.5)


def test_distances_near_ridges_are_those_of_the_surface(tmp_path):
    """Above a ridge the interpolated normal is not the way to the nearest point."""
    lines = ["v -3 -3 0", "v 3 -3 0", "v -3 0 3", "v 3 0 3", "v -3 3 0", "v 3 3 0"]
    (tmp_path / "ridge.obj").write_text("\n".join([*lines, "f 1 2 4 3", "f 3 4 6 5"]) + "\n")
    target = make_target(str(tmp_path / "ridge.obj"), 6.0, 1.0)
    points = np.array([[0, 0.3, 3.5], [0.2, -1.5, 1.4], [0, 0, 2.0]])
    ways = [np.hypot(0.3, 0.5), -0.1 / np.sqrt(2), -1 / np.sqrt(2)]
    assert target.measure_distances(points) == pytest.approx(ways, rel=1e-12)
    assert target.measure_reach(points) == 0


def test_beyond_its_border_a_surface_goes_on_along_its_tangent(tmp_path):
    lines = ["v -3 -3 0", "v 3 -3 3", "v 3 3 3", "v -3 3 0", "f 1 2 3 4"]
    (tmp_path / "slope.obj").write_text("\n".join(lines) + "\n")
    target = make_target(str(tmp_path / "slope.obj"), 6.0, 1.0)
    points = np.array([[3.4, 0.3, 3.2], [3.4, 0.3, 3.7], [0.0, 3.5, 1.5]])
    # The plane z = (x + 3) / 2: distances are the heights above it over its secant.
    above = points[:, 2] - (points[:, 0] + 3) / 2
    assert target.measure_distances(points) == pytest.approx(above * 2 / np.sqrt(5), abs=1e-12)
    assert target.measure_reach(points[:1]) == pytest.approx(0.4 * np.sqrt(5) / 2)
    assert target.measure_reach(points[2:]) == pytest.approx(0.5)
