"""Miura verification: random patterns over the whole path, and the published designs' tables.

Closed form of Schenk and Guest, PNAS 110 (2013) 3276, against the circle construction of
Tsiamis, Oliva and Calvano (2018), Fig. 1, and against refolding by hinge rotations.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foldshell.kinematics.reverse_fold import fold_by_rules, travel_at
from foldshell.pattern.angles import (
    developability_residual,
    flat_foldability_residual,
    measure_folds,
)
from foldshell.pattern.miura import (
    Miura,
    flat_vertices,
    fold_cell,
    folded_vertices,
    poissons_ratio,
)
from foldshell.pattern.unfold import fold_panels, unfold_panels

pytestmark = pytest.mark.verification

patterns = st.builds(
    Miura,
    side_a=st.floats(0.2, 5.0),
    side_b=st.floats(0.2, 5.0),
    sector_angle=st.floats(math.radians(15), math.radians(85)),
    zigzag_count=st.integers(3, 8),
    strip_count=st.integers(3, 8),
)
angles = st.floats(0.0, math.pi / 2)


@settings(max_examples=400, deadline=None)
@given(patterns, angles)
def test_rules_agree_with_closed_form(pattern, angle):
    """1e-12 of the sheet's size, from flat to flat-folded: round-off of sums of 40 terms."""
    size = max(pattern.zigzag_count * pattern.side_a, pattern.strip_count * pattern.side_b, 1.0)
    rules = fold_by_rules(pattern, travel_at(pattern, angle))
    assert np.abs(rules - folded_vertices(pattern, angle)).max() <= 1e-12 * size


@settings(max_examples=200, deadline=None)
@given(patterns, st.floats(0.01, 1.5))
def test_invariants_hold(pattern, angle):
    folded, grid = folded_vertices(pattern, angle), pattern.grid
    assert np.abs(measure_folds(folded, grid)[grid.neutral]).max() < 1e-11
    assert np.abs(developability_residual(folded, grid)).max() < 1e-11
    assert np.abs(flat_foldability_residual(folded, grid)).max() < 1e-11
    flat = flat_vertices(pattern)
    lengths = [np.linalg.norm(np.diff(v[grid.edges], axis=1)[:, 0], axis=1) for v in (folded, flat)]
    assert np.abs(lengths[0] - lengths[1]).max() < 1e-12 * lengths[1].max() * 10


@settings(max_examples=100, deadline=None)
@given(patterns, st.floats(0.05, 1.5))
def test_unfolding_and_refolding_return(pattern, angle):
    """There and back through panel placement and hinge rotations, closure to round-off."""
    folded, grid = folded_vertices(pattern, angle), pattern.grid
    unfolded = unfold_panels(folded, grid)
    size = np.ptp(flat_vertices(pattern), axis=0).max()
    assert unfolded.closure < 1e-11 * size
    back = fold_panels(unfolded.vertices, grid, measure_folds(folded, grid))
    assert back.closure < 1e-11 * size
    ends = [np.linalg.norm(v[0] - v[-1]) for v in (back.vertices, folded)]
    assert ends[0] == pytest.approx(ends[1], abs=1e-11 * size)


def test_poissons_ratio_converges_to_the_closed_form():
    """Central differences of the cell approach -cos2 t tan2 g at second order in the step."""
    pattern, angle = Miura(1.0, 1.0, math.radians(60), 3, 3), 0.8
    exact = poissons_ratio(pattern.sector_angle, angle)
    errors = []
    for step in (0.1, 0.05, 0.025):
        low, high = (fold_cell(pattern, angle + side * step) for side in (-1, 1))
        ratio = -math.log(high.across_zigzags / low.across_zigzags) / math.log(
            high.across_strips / low.across_strips
        )
        errors.append(abs(ratio - exact))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([2.0, 2.0], abs=0.1)
