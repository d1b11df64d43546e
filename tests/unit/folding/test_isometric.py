"""Isometric mode: what a Miura sheet can follow without stretching, and what it cannot."""

import numpy as np
import pytest
from folding_cases import DENSITIES, SPAN_HEIGHTS, fold_case

from foldshell.folding.isometric import STEEP_SHEETS

REACHED = {"hypar": 1.6e-3, "hypar_twist": 6e-4}


def _assert_isometric(surface, span, height, zigzag, strip):
    sheet, _, result = fold_case(surface, span, height, zigzag, strip, "isometric")
    quality = result.quality
    assert quality.edge_strain_max <= 1e-12
    if surface in REACHED:
        assert result.state == "ok", result.reason
        assert quality.rms_over_span <= REACHED[surface]
        assert quality.flipped_folds == 0 and quality.self_intersections == 0
    else:  # the distance that is left is the answer
        assert result.state == "not_reached"
        assert "rms distance" in result.reason
    return sheet, result


@pytest.mark.parametrize("surface", ["paraboloid", "hypar", "hypar_twist", "arch", "arch_strip"])
def test_saddles_are_reached_and_domes_are_not(surface):
    _assert_isometric(surface, 28, 10, 15, 16)


@pytest.mark.slow
def test_a_steep_twist_takes_another_sheet():
    """Developable all the same: the flat state is the sheet that was folded, not the given one."""
    sheet, result = _assert_isometric("hypar_twist", 28, 28, 15, 16)
    angle = result.shape.residuals["start_sector_angle_deg"]
    assert round(angle) == STEEP_SHEETS[0][0] and "of 82 deg, the best of 1" in result.reason
    assert np.abs(result.shape.flat - sheet.flat).max() > 0.1
    assert np.ptp(result.shape.flat[:, 2]) == 0


@pytest.mark.slow
def test_a_saddle_that_misses_its_figure_is_not_called_ok():
    """Panels 5 m long and 1 m wide: all four sheets are tried, and none comes near enough."""
    result = fold_case("hypar_twist", 28, 28, 8, 32, "isometric")[2]
    assert 1.6e-3 < result.quality.rms_over_span < 2e-3
    assert result.state == "not_reached" and "allowed 0.0016" in result.reason
    assert f"the best of {len(STEEP_SHEETS)}" in result.reason


@pytest.mark.verification
@pytest.mark.parametrize(("zigzag", "strip"), DENSITIES)
@pytest.mark.parametrize(("span", "height"), SPAN_HEIGHTS)
@pytest.mark.parametrize("surface", ["paraboloid", "hypar", "hypar_twist", "arch", "arch_strip"])
def test_every_design(request, surface, span, height, zigzag, strip):
    """One of 125 is not met: of some twenty sheets of 8 x 32 lines none follows the steepest twist
    nearer than 1.2e-3 span, against 6e-4 that is asked."""
    if (surface, height, span, zigzag) == ("hypar_twist", 28, 28, 8):
        request.applymarker(pytest.mark.xfail(strict=True, reason="rms 1.7e-3 span"))
    _assert_isometric(surface, span, height, zigzag, strip)
