"""Which mesh gives the limit: of high order for folded sheets, finer for smooth and flat ones."""

import numpy as np
import pytest

from foldshell.results.mean_fold import measure_mean_fold
from foldshell.results.mesh_convergence import REFERENCE, SMOOTH_REFERENCE, choose_reference
from sizing_case import corrugated_sheet


def _roof(angle):
    """Two square panels that meet at an angle, each of two facets."""
    x, z = np.cos(angle), np.sin(angle)
    vertices = np.array([[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0], [-x, 0, z], [-x, 1, z]], float)
    facets = np.array([[0, 2, 3], [0, 3, 1], [4, 0, 1], [4, 1, 5]])
    return {"vertices": vertices, "facets": facets}


@pytest.mark.parametrize("degrees", [5.0, 35.0, 70.0])
def test_mean_fold_is_that_of_the_ridge(degrees):
    """The facets of one panel lie in one plane and do not count."""
    roof = _roof(np.radians(degrees))
    assert np.degrees(measure_mean_fold(**roof)) == pytest.approx(degrees)


def test_flat_and_smooth_sheets_get_a_finer_mesh():
    assert measure_mean_fold(**_roof(0.0)) == 0
    assert choose_reference(_roof(0.0), 4) == SMOOTH_REFERENCE
    assert choose_reference(_roof(np.radians(8)), 4) == SMOOTH_REFERENCE
    assert choose_reference(_roof(np.radians(8)), 6).subdivisions == 12
    assert choose_reference(corrugated_sheet(), 4) == REFERENCE
