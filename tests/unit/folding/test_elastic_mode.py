"""Paper mode over the study's designs, against the figures it must reach."""

import numpy as np
import pytest

from folding_cases import DENSITIES, SPAN_HEIGHTS, fold_case
from foldshell.settings.design import SURFACES
from foldshell.settings.fold import FoldWeights


def _assert_reached(surface, span, height, zigzag, strip):
    _, _, result = fold_case(surface, span, height, zigzag, strip)
    steep = height >= 0.8 * span
    quality = result.quality
    assert result.state == "ok", result.reason
    assert quality.rms_over_span <= (5e-4 if steep else 1.5e-4)
    assert quality.max_over_span <= (1e-3 if steep else 4e-4)
    assert quality.flipped_folds == 0 and quality.self_intersections == 0
    assert quality.plan_coverage >= (0.8 if steep and surface == "hypar_twist" else 0.9)
    if height <= 0.4 * span:
        assert result.shape.iterations <= 20


@pytest.mark.parametrize("surface", ["paraboloid", "hypar", "arch"])
def test_supports_study_is_reached(surface):
    _assert_reached(surface, 28, 10, 15, 16)


@pytest.mark.slow
@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize(("span", "height"), SPAN_HEIGHTS)
def test_every_design_is_reached(surface, span, height):
    """Five densities each: the whole of the paper's Table 1 and more."""
    for zigzag, strip in DENSITIES:
        _assert_reached(surface, span, height, zigzag, strip)


@pytest.mark.parametrize("surface", ["paraboloid", "arch"])
def test_highest_vertices_can_be_attracted(surface):
    _, target, result = fold_case(surface, 28, 10, 15, 16, attract="highest")
    assert result.quality.rms_over_span <= 1.5e-4 and result.state == "ok"
    lowest = np.setdiff1d(np.arange(len(result.shape.vertices)), result.attracted)
    points = result.shape.vertices[lowest]
    closest, normals = target.find_closest(points)
    assert (np.einsum("ij,ij->i", points - closest, normals) < -0.5).all()


def test_soft_springs_distort_the_paraboloid_and_say_so():
    """The prototype measured 1.4 to 2.9 % strain; the report must not hide it."""
    quality = fold_case("paraboloid", 28, 10, 15, 16)[2].quality
    assert 0.01 < quality.edge_strain_max < 0.03
    assert quality.angle_defect_max_rad > 0.05 and quality.neutral_fold_mean_deg > 1


def test_without_attraction_the_target_is_not_reached():
    weights = FoldWeights(attraction=1e-9)
    result = fold_case("paraboloid", 28, 10, 15, 16, weights=weights)[2]
    assert result.state in ("not_reached", "crumpled")
    assert "rms" in result.reason or "coverage" in result.reason


def test_iterations_run_out_as_not_reached():
    result = fold_case("paraboloid", 28, 10, 15, 16, max_iterations=1)[2]
    assert result.state == "not_reached" and result.shape.iterations == 1


def test_same_input_gives_the_same_bits():
    one, two = (fold_case("hypar", 28, 10, 15, 16)[2].shape.vertices for _ in range(2))
    assert np.array_equal(one, two)
