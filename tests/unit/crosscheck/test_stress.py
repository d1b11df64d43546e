"""Utilization, its percentile and its means, by hand."""

import numpy as np
import pytest

from crosscheck.model import Material
from crosscheck.stress import (
    compute_panel_means,
    compute_percentile,
    rate_pressure,
    rate_principal_stress,
    rate_stress,
)

CONCRETE = Material(31e6, 0.2, 25.0, 16700.0, 1670.0, "von_mises")


def test_von_mises():
    """Uniaxial: the stress itself; pure shear: sqrt(3) times; equal biaxial: the stress."""
    stress = np.array([[16700.0, 0, 0], [0, 0, 16700.0], [-8350.0, -8350.0, 0]])
    np.testing.assert_allclose(rate_stress(stress, CONCRETE), [1, np.sqrt(3), 0.5])


def test_rankine():
    """Tension counts against a tenth of the compressive strength; pure shear is both."""
    stress = np.array([[1670.0, 0, 0], [-16700.0, -100.0, 0], [0, 0, 835.0]])
    np.testing.assert_allclose(rate_principal_stress(stress, CONCRETE), [1, 1, 0.5])


def test_drucker_prager_passes_through_both_uniaxial_strengths():
    """Pure shear: (m + 1) sqrt(3) t / 2 f with m = 10; biaxial compression lies in the cone."""
    stress = np.array([[1670.0, 0, 0], [-16700.0, 0, 0], [0, 0, 1000.0], [-900.0, -900.0, 0]])
    shear = 11 * np.sqrt(3) * 1000 / (2 * 16700)
    np.testing.assert_allclose(rate_pressure(stress, CONCRETE), [1, 1, shear, 0])


def test_percentile_counts_area():
    value = np.array([3.0, 1.0, 2.0, 4.0])
    area = np.array([1.0, 90.0, 8.5, 0.5])
    assert compute_percentile(value, area) == 3.0
    assert compute_percentile(value, area, 0.98) == 2.0
    assert compute_percentile(value, area, 1.0) == 4.0


def test_panel_means_weigh_by_area():
    value = np.array([[1.0, 3.0], [5.0, 5.0], [2.0, 2.0]])
    area = np.array([[1.0, 3.0], [2.0, 2.0], [1.0, 1.0]])
    np.testing.assert_allclose(
        compute_panel_means(value, area, np.array([1, 1, 0])), [2.0, (1 + 9 + 20) / 8]
    )
    assert compute_panel_means(value, area, np.array([0, 0, 0])) == pytest.approx(34 / 10)
