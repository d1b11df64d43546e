"""Miura geometry against its invariants; the circle construction against the closed form."""

import math

import numpy as np
import pytest

from foldshell.kinematics.reverse_fold import (
    fold_by_rules,
    fold_unit,
    largest_travel,
    make_travel,
    travel_at,
)
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
    rest_fold_angle,
    size_miura,
)

PATTERNS = [
    Miura(1.3, 0.7, math.radians(60), 5, 6),
    Miura(0.4, 2.0, math.radians(48), 4, 7),
    Miura(1.0, 1.0, math.radians(85), 6, 5),
]
PATH = np.concatenate([[0, 1e-8, 1e-5], np.linspace(0.01, 1.57, 23), [math.pi / 2]])


def _edge_lengths(vertices, grid):
    return np.linalg.norm(np.diff(vertices[grid.edges], axis=1)[:, 0], axis=1)


@pytest.mark.parametrize("pattern", PATTERNS)
def test_rules_agree_with_closed_form(pattern):
    """Fig. 1 of the paper against Schenk and Guest; 1e-12 m leaves room for round-off only."""
    for angle in PATH:
        by_rules = fold_by_rules(pattern, travel_at(pattern, angle))
        assert np.abs(by_rules - folded_vertices(pattern, angle)).max() < 1e-12


@pytest.mark.parametrize("pattern", PATTERNS)
def test_folding_keeps_every_length_plane_and_angle(pattern):
    """Rigid folding: panels congruent to the flat ones (also across the neutral fold)."""
    grid = pattern.grid
    flat = flat_vertices(pattern)
    for angle in PATH[:-1]:
        folded = folded_vertices(pattern, angle)
        assert np.abs(_edge_lengths(folded, grid) - _edge_lengths(flat, grid)).max() < 1e-12
        assert np.abs(measure_folds(folded, grid)[grid.neutral]).max() < 1e-12
        assert np.abs(developability_residual(folded, grid)).max() < 1e-12
        assert np.abs(flat_foldability_residual(folded, grid)).max() < 1e-12


@pytest.mark.parametrize("pattern", PATTERNS)
def test_folds_have_the_assigned_direction(pattern):
    grid = pattern.grid
    folds = measure_folds(folded_vertices(pattern, 0.6), grid)
    assert (folds[grid.assignments == "V"] > 0.01).all()
    assert (folds[grid.assignments == "M"] < -0.01).all()


def test_valley_is_the_mirror_of_mountain():
    pattern = PATTERNS[0]
    travel = travel_at(pattern, 0.8)
    upper, lower = (fold_by_rules(pattern, travel, fold) for fold in "MV")
    assert np.array_equal(upper * [1, 1, -1], lower)
    assert upper[:, 2].max() > 0.1


def test_unit_keeps_the_papers_relations():
    """|EH| = 2a - t; P turns about K1 and K2 at right angles to EF and HG; IL parallel to EF."""
    pattern = Miura(1.3, 0.7, 1.0, 3, 3)
    unit = fold_unit(pattern, make_travel(pattern, 0.3 * largest_travel(pattern)))
    assert np.linalg.norm(unit["H"] - unit["E"]) == pytest.approx(
        2 * 1.3 - 0.3 * largest_travel(pattern), abs=1e-14
    )
    for foot, edge in (("K1", unit["F"] - unit["E"]), ("K2", unit["G"] - unit["H"])):
        assert abs((unit["I"] - unit[foot]) @ edge) < 1e-14
        assert np.linalg.norm(unit["I"] - unit[foot]) == pytest.approx(1.3 * math.sin(1.0))
    assert np.allclose(unit["L"] - unit["I"], unit["F"] - unit["E"], atol=1e-15)


def test_translation_outside_the_path_is_refused():
    with pytest.raises(ValueError, match="translation"):
        make_travel(PATTERNS[0], 1.01 * largest_travel(PATTERNS[0]))


@pytest.mark.parametrize("pattern", PATTERNS)
def test_poissons_ratio_is_the_slope_of_the_path(pattern):
    """-dL/L / (dS/S) by central differences; their own error is about 1e-9 here."""
    angle, step = 0.7, 1e-5
    low, high = (fold_cell(pattern, angle + s) for s in (-step, step))
    strain_l = math.log(high.across_zigzags / low.across_zigzags)
    strain_s = math.log(high.across_strips / low.across_strips)
    expected = poissons_ratio(pattern.sector_angle, angle)
    assert -strain_l / strain_s == pytest.approx(expected, rel=1e-7)


def test_strips_of_unequal_width_fold_as_equal_ones_do():
    """Zig-zags along a curve: same vertex angles, so rigid and flat-foldable all the same."""
    pattern = PATTERNS[1]
    grid, widths = pattern.grid, np.array([1.6, 0.3, 1.1, 0.9, 0.4, 1.7])
    flat = flat_vertices(pattern, widths)
    for angle in PATH[:-1]:
        folded = folded_vertices(pattern, angle, widths)
        assert np.abs(_edge_lengths(folded, grid) - _edge_lengths(flat, grid)).max() < 1e-12
        assert np.abs(measure_folds(folded, grid)[grid.neutral]).max() < 1e-12
        assert np.abs(flat_foldability_residual(folded, grid)).max() < 1e-12
    zigzag = _edge_lengths(flat, grid)[: grid.strip_count - 1]
    assert zigzag == pytest.approx(pattern.side_b * widths, rel=1e-14)
    same = folded_vertices(pattern, 0.7, np.ones(6))
    assert same == pytest.approx(folded_vertices(pattern, 0.7), abs=1e-14)


def test_rest_state_measures_the_lengths_it_was_sized_for():
    pattern = size_miura(30.0, 28.0, math.radians(60), 15, 16)
    rest = rest_fold_angle(pattern.sector_angle)
    assert poissons_ratio(pattern.sector_angle, rest) == pytest.approx(-1, abs=1e-14)
    size = np.ptp(folded_vertices(pattern, rest), axis=0)
    assert size[:2] == pytest.approx([30.0, 28.0], abs=1e-12)


def test_panel_longer_than_the_span_is_refused():
    with pytest.raises(ValueError, match="strips"):
        size_miura(30.0, 1.0, math.radians(60), 15, 4)
