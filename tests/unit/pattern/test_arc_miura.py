"""Arc-Miura: developable, flat-foldable, rigidly foldable, and as curved as it was sized for."""

import math

import numpy as np
import pytest

from foldshell.pattern.angles import (
    developability_residual,
    flat_foldability_residual,
    measure_folds,
)
from foldshell.pattern.arc_miura import (
    flat_arc_vertices,
    fold_arc_vertices,
    make_arc_sheet,
    size_arc_miura,
)
from foldshell.pattern.fold_format import read_fold, write_fold
from foldshell.pattern.miura import folded_vertices, rest_fold_angle, size_miura
from foldshell.pattern.unfold import fold_panels, unfold_panels

ANGLE = math.radians(60)


@pytest.mark.parametrize("turning", [-0.9, 0.6, 1.4])
@pytest.mark.parametrize("part", [0.2, 0.7, 1.0])
def test_every_state_is_rigid_origami(turning, part):
    """Closure and invariants to round-off on the path from flat to rest."""
    pattern, fold = size_arc_miura((30.0, 28.0), turning, ANGLE, 9, 8)
    state, grid = fold_arc_vertices(pattern, part * fold), pattern.grid
    folds = measure_folds(state, grid)
    assert np.abs(folds[grid.neutral]).max() < 1e-11
    assert fold_panels(flat_arc_vertices(pattern), grid, folds).closure < 1e-11
    assert np.abs(developability_residual(state, grid)).max() < 1e-12
    assert np.abs(flat_foldability_residual(state, grid)).max() < 1e-12
    assert unfold_panels(state, grid).vertices == pytest.approx(
        flat_arc_vertices(pattern), abs=1e-11
    )
    assert (folds[grid.assignments == "V"] > 0).all()
    assert (folds[grid.assignments == "M"] < 0).all()


@pytest.mark.parametrize("turning", [-0.9, 0.6, 1.4])
def test_rest_state_turns_as_asked(turning):
    """The chords between valley vertices of one strip turn by 2 turning / (zig-zags - 1) each."""
    pattern, fold = size_arc_miura((30.0, 28.0), turning, ANGLE, 9, 8)
    rest, grid = fold_arc_vertices(pattern, fold), pattern.grid
    strip = rest[(grid.strip_index == 3) & (grid.zigzag_index % 2 == 0)]
    ridge = rest[(grid.strip_index == 3) & (grid.zigzag_index == 1)][0] - strip[0]
    chords = np.diff(strip, axis=0)
    chords /= np.linalg.norm(chords, axis=1)[:, None]
    steps = np.arccos(np.einsum("ij,ij->i", chords[1:], chords[:-1]))
    assert steps == pytest.approx(abs(turning) / 4, abs=1e-10)
    bends_away_from_ridges = (chords[1] - chords[0]) @ ridge < 0
    assert bends_away_from_ridges == (turning > 0)


def test_no_turning_is_the_standard_pattern():
    pattern, fold = size_arc_miura((30.0, 28.0), 0.0, ANGLE, 7, 8)
    standard = size_miura(30.0, 28.0, ANGLE, 7, 8)
    exact = folded_vertices(standard, rest_fold_angle(ANGLE))
    rest = fold_arc_vertices(pattern, fold)
    for one, two in ((0, 20), (3, 50), (9, 33)):
        assert np.linalg.norm(rest[one] - rest[two]) == pytest.approx(
            np.linalg.norm(exact[one] - exact[two]), abs=1e-9
        )


def test_sheet_round_trips_with_its_unrolled_state(tmp_path):
    sheet = make_arc_sheet(*size_arc_miura((30.0, 28.0), 1.0, ANGLE, 7, 8), frames=3)
    write_fold(tmp_path / "a.fold", sheet, "arc")
    back = read_fold(tmp_path / "a.fold")
    assert back.kind == "arc_miura" and len(back.path) == 3
    assert np.array_equal(back.placement, sheet.placement)
    assert np.array_equal(back.rest, sheet.rest)


def test_too_much_turning_is_refused():
    with pytest.raises(ValueError, match="turning"):
        size_arc_miura((30.0, 28.0), 3.0, ANGLE, 4, 8)
