"""Principal stress lines of states whose trajectories are known."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.results.line_spacing import PrincipalStressLine, thin_out
from foldshell.results.principal_stress_lines import (
    find_neighbours,
    make_force_field,
    trace_principal_stress_lines,
)
from foldshell.shell.element import element_geometry
from foldshell.shell.mesh import build_mesh
from foldshell.shell.reference import lattice_points, orthonormal_basis


def square_mesh(size=4, skew=0.15, seed=4):
    """A skewed, renumbered mesh of the unit square in facets."""
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(size + 1.0), np.arange(size + 1.0))
    points = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()])
    inner = ((points[:, :2] > 0) & (points[:, :2] < size)).all(axis=1)
    points[inner, :2] += skew * rng.uniform(-1, 1, (inner.sum(), 2))
    a = (np.arange(size)[:, None] * (size + 1) + np.arange(size)).ravel()
    facets = np.vstack([np.stack([a, a + 1, a + size + 2], 1),
                        np.stack([a, a + size + 2, a + size + 1], 1)])  # fmt: skip
    order = rng.permutation(len(points))
    shift = rng.integers(0, 3, len(facets))
    facets = np.array([np.roll(f, s) for f, s in zip(facets[rng.permutation(len(facets))],
                                                     shift, strict=True)])  # fmt: skip
    place = np.argsort(order)
    return build_mesh(points[order] / size, place[facets], None, 4)


def field_of(mesh, tensor):
    """Return the field of a global tensor function (N, 3) -> (N, 3, 3), exact to degree p - 1."""
    geometry = element_geometry(mesh)
    nodes = lattice_points(mesh.order - 1)
    corner = mesh.nodes[mesh.corners]
    bary = np.column_stack([1 - nodes.sum(axis=1), nodes])
    points = np.einsum("qc,ecx->eqx", bary, corner)
    values = tensor(points.reshape(-1, 3)).reshape(len(corner), len(nodes), 3, 3)
    local = np.einsum("eax,eqxy,eby->eqab", geometry.frame[:, :2], values, geometry.frame[:, :2])
    parts = np.stack([local[..., 0, 0], local[..., 1, 1], local[..., 0, 1]], axis=1)
    to_basis = np.linalg.inv(orthonormal_basis(mesh.order - 1, nodes))
    return make_force_field(mesh, geometry, np.einsum("mq,ecq->ecm", to_basis, parts))


def along(direction):
    """Return a uniaxial tension of 5 kN/m along a direction."""
    direction = np.asarray(direction) / np.linalg.norm(direction)
    return lambda points: np.broadcast_to(5 * np.outer(direction, direction), (len(points), 3, 3))


def test_uniaxial_lines_are_straight_and_parallel():
    """Uniform tension at 20 degrees: every line has that direction and ends at the border."""
    direction = np.array([np.cos(np.radians(20)), np.sin(np.radians(20)), 0])
    lines = trace_principal_stress_lines(
        field_of(square_mesh(), along(direction)), (0,), 0.08, 0.03
    )
    assert len(lines) > 5
    for line in lines:
        chord = line.points[-1] - line.points[0]
        assert abs(chord @ direction) == pytest.approx(np.linalg.norm(chord), rel=1e-9)
        sideways = np.cross(line.points - line.points[0], direction)
        assert np.abs(sideways).max() < 1e-9
        assert np.allclose(line.force, 5)
    longest = lines[0].points[[0, -1]]
    on_border = np.isclose(longest[:, :2], 0, atol=1e-9) | np.isclose(longest[:, :2], 1, atol=1e-9)
    assert on_border.any(axis=1).all()


def test_lines_of_an_opened_fold_are_straight():
    """Two facets folded by 70 degrees, each in tension at 60 degrees to the fold: opened flat,
    the line goes on straight."""
    angle, across = np.radians(70), np.radians(60)
    up = np.array([0, np.cos(angle), np.sin(angle)])
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0.5, -1, 0], 0.5 * np.eye(3)[0] + up])
    mesh = build_mesh(points, np.array([[1, 0, 2], [0, 1, 3]]), None, 2)
    run, rise = np.cos(across), np.sin(across)

    flat, tilted = np.array([run, rise, 0.0]), run * np.eye(3)[0] + rise * up
    both = np.outer(flat, flat), np.outer(tilted, tilted)
    field = field_of(mesh, lambda places: np.broadcast_to(both[0], (len(places), 3, 3)))
    raised = field_of(mesh, lambda places: np.broadcast_to(both[1], (len(places), 3, 3)))
    upper = (mesh.facet == 1)[:, None, None]
    polynomial = np.where(upper, raised.polynomial, field.polynomial)
    line = trace_principal_stress_lines(replace(field, polynomial=polynomial), (0,), 0.15, 0.02)[0]
    raised = line.points[:, 2] > 1e-9
    opened = line.points[:, :2].copy()
    opened[raised, 1] = line.points[raised] @ up
    assert raised.any() and not raised.all()
    slope = np.diff(opened, axis=0) / np.linalg.norm(np.diff(opened, axis=0), axis=1)[:, None]
    assert np.allclose(np.abs(slope @ [run, rise]), 1, atol=1e-9)


def test_lines_about_a_centre_are_rays_and_circles():
    """N = r r^T about (-0.3, -0.2): the tension r2 runs along rays, the zero force on circles.

    The midpoint rule errs by O(step2) over a length; 1e-3 of the radius is asked for.
    """
    centre = np.array([-0.3, -0.2, 0])

    def tensor(points):
        arm = points - centre
        return arm[:, :, None] * arm[:, None, :]

    field = field_of(square_mesh(), tensor)
    for line in trace_principal_stress_lines(field, (0,), 0.1, 0.02):
        arm = line.points[:, :2] - centre[:2]
        bearing = np.arctan2(arm[:, 1], arm[:, 0])
        assert np.ptp(bearing) < 1e-6
        assert np.allclose(line.force, (arm**2).sum(axis=1), rtol=1e-9)
    for line in trace_principal_stress_lines(field, (1,), 0.1, 0.02):
        radius = np.linalg.norm(line.points[:, :2] - centre[:2], axis=1)
        assert np.ptp(radius) < 1e-3 * radius.mean()
        assert np.abs(line.force).max() < 1e-9


def test_neighbours_are_mutual():
    """Whoever is behind my edge has me behind its edge; the border has nobody."""
    mesh = square_mesh(3)
    neighbour = find_neighbours(mesh)
    element, edge = np.nonzero(neighbour[..., 0] >= 0)
    other = neighbour[element, edge]
    back = neighbour[other[:, 0], other[:, 1]]
    assert np.array_equal(back, np.column_stack([element, edge]))
    on_border = (neighbour[..., 0] < 0).sum()
    assert on_border == 4 * 3 * mesh.subdivisions // mesh.cells


def test_thinning_keeps_the_long_line_and_cuts_the_short():
    """Of two lines in the same boxes the longer stays; a part that leaves them is kept."""
    long = PrincipalStressLine(
        np.column_stack([np.arange(0, 10, 0.25), *np.zeros((2, 40))]), np.ones(40), 0
    )
    short = PrincipalStressLine(long.points[4:20] + np.array([0, 0.1, 0]), np.ones(16), 0)
    assert [len(line.points) for line in thin_out([short, long], 0.5)] == [40]
    away = PrincipalStressLine(long.points + np.array([0, 5, 0]), np.ones(40), 0)
    assert len(thin_out([short, long, away], 0.5)) == 2


def test_equal_forces_have_no_lines():
    """The same compression in all directions: no direction is principal."""
    field = field_of(
        square_mesh(), lambda points: np.broadcast_to(-3 * np.eye(3), (len(points), 3, 3))
    )
    assert trace_principal_stress_lines(field, (0,), 0.05, 0.02) == []


def test_a_closed_line_ends_when_it_has_come_round():
    """Hoop tension about the middle: no line turns more than 5/4 pi each way."""
    centre = np.array([0.5, 0.5, 0])

    def hoop(points):
        arm = np.cross([0, 0, 1.0], points - centre)
        return arm[:, :, None] * arm[:, None, :]

    lines = trace_principal_stress_lines(field_of(square_mesh(), hoop), (0,), 0.05, 0.02)
    assert lines
    for line in lines:
        step = np.diff(line.points[:, :2], axis=0)
        step = step[np.linalg.norm(step, axis=1) > 1e-9]
        turn = np.abs(np.diff(np.unwrap(np.arctan2(step[:, 1], step[:, 0])))).sum()
        assert turn < 2.6 * np.pi


def test_lines_start_apart_and_stay_apart():
    """Twenty parallel lines a fifth of the spacing apart: one of five is left, from end to end."""
    x = np.arange(0, 10, 0.1)
    lines = [
        PrincipalStressLine(np.column_stack([x, 0 * x + 0.2 * k, 0 * x]), np.ones(100), 0, 50)
        for k in range(20)
    ]
    kept = thin_out(lines, 1.0)
    places = sorted(line.points[0, 1] for line in kept)
    assert all(len(line.points) == 100 for line in kept)
    assert 2 <= len(kept) <= 4
    assert np.diff(places).min() >= 1.0 - 1e-9


def test_a_line_ends_where_it_comes_close_to_a_stronger_one():
    """It keeps the piece about its start, which is not cut from it."""
    x = np.arange(0, 10, 0.1)
    strong = PrincipalStressLine(np.column_stack([x, 0 * x + 0.05, 0 * x]), 9 * np.ones(100), 0, 50)
    weak = PrincipalStressLine(np.column_stack([0 * x + 5, 6 - x, 0 * x]), np.ones(100), 0, 10)
    first, second = thin_out([weak, strong], 1.0)
    assert len(first.points) == 100 and first.force[0] == 9
    assert second.points[second.start] == pytest.approx(weak.points[10])
    assert 0.4 < second.points[-1, 1] < 1.0


def test_a_line_takes_the_other_direction_at_a_fold_where_that_pulls_alike():
    """Two facets in one plane, the larger tension along x in one and along y in the other, 5 and
    4.9 kN/m: the line along x goes on along x, as the lesser tension there."""
    points = np.array([[0.0, -1, 0], [0, 1, 0], [-2, 0, 0], [2, 0, 0]])
    mesh = build_mesh(points, np.array([[0, 1, 2], [1, 0, 3]]), None, 2)
    along_x, along_y = (np.diag(values) for values in ([5.0, 4.0, 0.0], [4.9, 6.0, 0.0]))
    left = field_of(mesh, lambda places: np.broadcast_to(along_x, (len(places), 3, 3)))
    right = field_of(mesh, lambda places: np.broadcast_to(along_y, (len(places), 3, 3)))
    which = (mesh.facet == 1)[:, None, None]
    field = replace(left, polynomial=np.where(which, right.polynomial, left.polynomial))
    line = trace_principal_stress_lines(field, (0,), 0.2, 0.05)[0]
    x, force = line.points[:, 0], line.force
    assert x.min() < -1 and x.max() > 1
    assert np.ptp(line.points[:, 1]) < 1e-9
    assert force[x < -0.1] == pytest.approx(5) and force[x > 0.1] == pytest.approx(4.9)
