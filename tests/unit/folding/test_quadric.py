"""Targets: closest points set off along known normals; arc lengths against quadrature."""

import numpy as np
import pytest
from scipy.integrate import quad

from foldshell.folding.quadric import make_quadric
from foldshell.settings.design import SURFACES


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("height", [6.0, 28.0])
def test_closest_point_of_an_offset_point_is_its_foot(surface, height):
    """Offsets stay within the least radius of curvature (3.5 m), where the foot is unique."""
    target = make_quadric(surface, 28.0, height)
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-14, 14, (2, 500))
    foot = np.column_stack([x, y, target.evaluate_height(x, y)])
    normals = target.find_normals(x, y)
    closest, found = target.find_closest(foot + rng.uniform(-2, 2, (500, 1)) * normals)
    assert np.abs(closest - foot).max() < 1e-12
    assert np.abs(found - normals).max() < 1e-12
    assert (normals[:, 2] > 0).all()


@pytest.mark.parametrize("surface", SURFACES)
def test_section_lengths_and_walk(surface):
    target = make_quadric(surface, 28.0, 10.0)
    for axis, bend in enumerate((target.along_x, target.along_y)):
        exact = 2 * quad(lambda x, k=bend: np.sqrt(1 + (2 * k * x) ** 2), 0, 14)[0]
        assert target.section_lengths()[axis] == pytest.approx(exact, rel=1e-12)
        ends = target.walk_section(axis, np.array([-exact / 2, 0.0, exact / 2]))
        assert ends == pytest.approx([-14, 0, 14], abs=1e-11)


def test_heights_are_those_of_the_study():
    """Corners and crowns as stated in the study's reading of the paper."""
    corner = (np.array([14.0]), np.array([14.0]))
    assert make_quadric("paraboloid", 28, 10).evaluate_height(*corner)[0] == pytest.approx(0)
    assert make_quadric("paraboloid", 28, 10).apex == 10
    arch = make_quadric("arch", 28, 10)
    assert arch.evaluate_height(np.array([14.0]), np.array([3.0]))[0] == pytest.approx(0)
    for name, at in (("hypar", ([14, 0], [0, 14])), ("hypar_twist", ([14, 14], [14, -14]))):
        heights = make_quadric(name, 28, 10).evaluate_height(*np.array(at, dtype=float))
        assert sorted(heights) == pytest.approx([0, 10])


def test_unknown_surface_is_refused():
    with pytest.raises(ValueError, match="must be one of paraboloid"):
        make_quadric("dome", 28, 10)
