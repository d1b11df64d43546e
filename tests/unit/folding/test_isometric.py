"""Isometric mode: what a Miura sheet can follow without stretching, and what it cannot."""

import pytest
from folding_cases import DENSITIES, fold_case

REACHED = {"hypar": 1.6e-3, "hypar_twist": 6e-4}


def _assert_isometric(surface, height, zigzag, strip):
    _, _, result = fold_case(surface, 28, height, zigzag, strip, "isometric")
    assert result.quality.edge_strain_max <= 1e-12
    if surface in REACHED:
        assert result.state == "ok", result.reason
        assert result.quality.rms_over_span <= REACHED[surface]
        assert result.quality.flipped_folds == 0 and result.quality.self_intersections == 0
    else:  # positive or no Gaussian curvature: the distance that is left is the answer
        assert result.state == "not_reached"
        assert "rms distance" in result.reason and result.quality.rms_over_span > 2e-3


@pytest.mark.parametrize("surface", ["paraboloid", "hypar", "hypar_twist", "arch", "arch_strip"])
def test_saddles_are_reached_and_domes_are_not(surface):
    _assert_isometric(surface, 10, 15, 16)


@pytest.mark.verification
@pytest.mark.parametrize(("zigzag", "strip"), DENSITIES)
@pytest.mark.parametrize("height", [10, 6])
@pytest.mark.parametrize("surface", ["paraboloid", "hypar", "hypar_twist", "arch", "arch_strip"])
def test_every_design(surface, height, zigzag, strip):
    if height == 6 and surface not in REACHED:
        pytest.skip("shallow cylinders come near enough; measured at 28/10")
    _assert_isometric(surface, height, zigzag, strip)
