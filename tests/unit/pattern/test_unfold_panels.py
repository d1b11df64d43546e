"""Unfolding and rigid refolding against the Miura sheet, whose states are all known."""

import math

import numpy as np
import pytest

from foldshell.pattern.angles import measure_folds
from foldshell.pattern.miura import Miura, flat_vertices, folded_vertices
from foldshell.pattern.unfold import (
    find_overlap,
    fit_onto,
    fold_panels,
    follow_path,
    unfold_panels,
)

PATTERN = Miura(1.3, 0.7, math.radians(60), 6, 7)


def _turn(seed):
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return turn * np.sign(np.linalg.det(turn))


def _distances(vertices):
    return np.linalg.norm(vertices[:, None] - vertices[None], axis=2)


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.0, 1.5])
def test_unfolding_gives_the_flat_pattern(angle):
    """In any pose; compared by all pairwise distances, which do not depend on placement."""
    folded = folded_vertices(PATTERN, angle) @ _turn(1).T + 5.0
    unfolded = unfold_panels(folded, PATTERN.grid)
    assert unfolded.closure < 1e-13
    assert np.ptp(unfolded.vertices[:, 2]) == 0
    exact = _distances(flat_vertices(PATTERN))
    assert np.abs(_distances(unfolded.vertices) - exact).max() < 1e-12
    assert not find_overlap(unfolded.vertices, PATTERN.grid)


def test_unfolded_strips_run_along_y():
    flat = unfold_panels(folded_vertices(PATTERN, 1.0) @ _turn(2).T, PATTERN.grid).vertices
    assert flat == pytest.approx(flat_vertices(PATTERN), abs=1e-12)


@pytest.mark.parametrize("angle", [0.2, 0.9, 1.4])
def test_hinge_rotations_rebuild_the_folded_state(angle):
    folded = folded_vertices(PATTERN, angle)
    state = fold_panels(flat_vertices(PATTERN), PATTERN.grid, measure_folds(folded, PATTERN.grid))
    assert state.closure < 1e-13
    assert np.abs(_distances(state.vertices) - _distances(folded)).max() < 1e-12


def test_rigid_path_is_the_closed_form():
    """Zig-zag folds are twice the angle t to the plane, so tan t is what the path scales."""
    folded = folded_vertices(PATTERN, 1.1)
    parts = np.linspace(0, 1, 7)
    states, closure = follow_path(folded, flat_vertices(PATTERN), PATTERN.grid, parts)
    assert closure < 1e-12
    for state, part in zip(states, parts, strict=True):
        angle = math.atan(part * math.tan(1.1))
        exact = folded_vertices(PATTERN, angle)
        assert np.abs(_distances(state) - _distances(exact)).max() < 1e-12


def test_gap_of_a_sheet_that_is_not_developable_is_seen():
    folded = folded_vertices(PATTERN, 1.0)
    folded[3 * 7 + 3] += [0.05, 0.02, 0.04]
    assert unfold_panels(folded, PATTERN.grid).closure > 1e-3


def test_overlap_is_seen():
    flat = flat_vertices(PATTERN)
    flat[0] = flat[2 * 7 + 2] + [0.1, 0.05, 0]
    assert find_overlap(flat, PATTERN.grid)


def test_best_fit_undoes_a_motion_and_never_mirrors():
    """A turned and moved copy comes back to 1e-12; a mirrored one cannot: it keeps its hand."""
    random = np.random.default_rng(3)
    points = random.normal(size=(20, 3)) * [3, 2, 1]
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    moved = points @ turn.T + [4, -5, 6]
    assert np.abs(fit_onto(moved, points) - points).max() < 1e-12
    mirrored = fit_onto(points * [1, 1, -1], points)
    volume = [np.linalg.det(p[1:4] - p[0]) for p in (points * [1, 1, -1], mirrored)]
    assert volume[0] == pytest.approx(volume[1])
    assert np.abs(mirrored - points).max() > 0.1
