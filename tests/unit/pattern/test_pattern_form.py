"""Sector angle, rest fold angle and grading of strips of a design's sheet."""

import math

import numpy as np
import pytest

from foldshell.pattern.design import design_sheet
from foldshell.pattern.miura import grade_widths, rest_fold_angle

LENGTHS = 30.0, 31.0


def sheet(strips=16, sector=50.0, rest=40.0, grading=0.0):
    return design_sheet(
        "miura", LENGTHS, 15, strips, sector, 0, rest_fold_angle_deg=rest, strip_grading=grading
    )


def panels_of(sheet):
    return [sheet.grid.facets[sheet.grid.facet_panel == panel] for panel in (0, 7, 100)]


@pytest.mark.parametrize("grading", [0.0, 0.7, -0.9])
@pytest.mark.parametrize("strips", [9, 16])
def test_the_rest_state_measures_the_given_lengths(strips, grading):
    """By its outermost vertices, whatever the strips' widths; to rounding of some hundred sums."""
    rest = sheet(strips, grading=grading).rest
    np.testing.assert_allclose(np.ptp(rest[:, :2], axis=0), LENGTHS, rtol=1e-13)


@pytest.mark.parametrize("grading", [0.0, 0.7, -0.9])
def test_the_rest_state_is_the_flat_sheet_folded_without_strain(grading):
    """All edge lengths and panel diagonals are those of the flat state."""
    made = sheet(grading=grading)
    pairs = np.vstack([made.grid.facets[:, [0, 1]], made.grid.facets[:, [1, 2]]])
    pairs = np.vstack([pairs, made.grid.facets[:, [2, 0]]])
    flat, rest = (np.linalg.norm(v[pairs[:, 0]] - v[pairs[:, 1]], axis=1)
                  for v in (made.flat, made.rest))  # fmt: skip
    np.testing.assert_allclose(rest, flat, rtol=1e-12)


@pytest.mark.parametrize(("sector", "rest"), [(60.0, 20.0), (40.0, 35.0), (75.0, 80.0)])
def test_panels_stand_at_the_rest_fold_angle(sector, rest):
    """The angle of every facet's normal to the vertical."""
    made = sheet(sector=sector, rest=rest, grading=0.3)
    corners = made.rest[made.grid.facets]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    cosine = np.abs(normal[:, 2]) / np.linalg.norm(normal, axis=1)
    np.testing.assert_allclose(np.degrees(np.arccos(cosine)), rest, rtol=1e-9)


def test_empty_columns_are_the_sheet_of_poissons_ratio_minus_one():
    given = math.degrees(rest_fold_angle(math.radians(60.0)))
    plain = design_sheet("miura", LENGTHS, 15, 16, 60.0, 0)
    named = sheet(sector=60.0, rest=given)
    np.testing.assert_allclose(named.rest, plain.rest, atol=1e-12)


def test_grading_widens_the_borders_by_its_amount():
    """Mean 1; ends less middle tend to g as strips become many: (n - 1)/n g for n strips."""
    widths = grade_widths(41, 0.5)
    assert widths.mean() == pytest.approx(1, abs=1e-14)
    assert widths[0] - widths[20] == pytest.approx(0.5 * 39 / 40 - 0.5 / 40, abs=1e-14)
    np.testing.assert_allclose(widths, widths[::-1])
    assert grade_widths(16, 0) is None
    with pytest.raises(ValueError, match=r"strip_grading -2.2: the narrowest of 15 strips"):
        grade_widths(16, -2.2)
