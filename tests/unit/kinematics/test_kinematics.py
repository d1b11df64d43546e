"""Kinematics of the Miura sheet against closed forms and known counts."""

import math

import pytest

from foldshell.folding.targets import make_target
from foldshell.kinematics.force_ratios import try_force_ratios
from foldshell.kinematics.mechanism import (
    count_mechanisms,
    find_soft_modes,
    measure_isometry,
    measure_ratios,
)
from foldshell.pattern.design import design_sheet
from foldshell.pattern.miura import Miura, folded_vertices, rest_fold_angle
from foldshell.settings.fold import Fold

CASES = [(60, None), (60, 40), (70, 50), (50, 30)]


def _state(sector, fold, zigzag_count=7, strip_count=8):
    pattern = Miura(1.0, 1.3, math.radians(sector), zigzag_count, strip_count)
    angle = rest_fold_angle(pattern.sector_angle) if fold is None else math.radians(fold)
    return pattern, angle


@pytest.mark.parametrize(("sector", "fold"), CASES)
def test_both_poissons_ratios_are_the_closed_forms(sector, fold):
    """Auxetic in plane (C1), a saddle in bending, equal in size: -+ cos2 t tan2 g.

    In plane by central differences (1e-8); in bending by linear algebra (1e-10).
    """
    ratios = measure_ratios(*_state(sector, fold))
    assert ratios.in_plane_exact < 0
    assert ratios.in_plane == pytest.approx(ratios.in_plane_exact, rel=1e-8)
    assert ratios.bending == pytest.approx(-ratios.in_plane_exact, rel=1e-10)
    assert ratios.bending_residual < 1e-10


@pytest.mark.parametrize(("sector", "fold"), CASES)
def test_twist_and_saddle_are_isometric_and_domes_are_not(sector, fold):
    """First-order isometries: residual 0 for xy and x2 - r y2; 0.3 and more for the others."""
    pattern, angle = _state(sector, fold)
    missed = measure_isometry(folded_vertices(pattern, angle), pattern.grid)
    assert missed["twist"] < 1e-12 and missed["saddle"] < 1e-10
    assert min(missed["dome"], missed["arch"], missed["arch_strip"]) > 0.25


def test_what_is_missed_grows_with_density():
    coarse, fine = (
        measure_isometry(folded_vertices(pattern, angle), pattern.grid)
        for pattern, angle in (_state(60, None), _state(60, None, 11, 12))
    )
    assert all(fine[name] > coarse[name] for name in ("dome", "arch", "arch_strip"))


@pytest.mark.parametrize(("zigzag_count", "strip_count"), [(5, 6), (7, 8)])
def test_rigid_quadrilaterals_have_one_freedom_and_are_over_constrained(zigzag_count, strip_count):
    """One mechanism whatever the size; bending panels have many and no redundancy."""
    pattern, angle = _state(60, None, zigzag_count, strip_count)
    vertices = folded_vertices(pattern, angle)
    rigid = count_mechanisms(vertices, pattern.grid, True)
    assert rigid.freedoms == 1 and rigid.self_stresses > 5
    bending = count_mechanisms(vertices, pattern.grid, False)
    # Maxwell: 3 V - E - 6, as no edge is redundant
    grid = pattern.grid
    assert bending.freedoms == 3 * len(vertices) - len(grid.edges) - 6
    assert bending.self_stresses == 0


@pytest.mark.parametrize(("sector", "fold"), CASES)
@pytest.mark.parametrize("panel_over_crease", [1.0, 10.0])
def test_softest_mode_is_twist_then_saddle(sector, fold, panel_over_crease):
    """Fig. 4 of the paper; for panels at most ten times as stiff as creases, fold <= 55 deg."""
    modes = find_soft_modes(*_state(sector, fold, 9, 10), panel_over_crease)
    assert [mode.shape for mode in modes[:2]] == ["twist", "saddle"]
    assert min(mode.agreement for mode in modes[:2]) > 0.95
    assert modes[1].stiffness > 1.2


@pytest.mark.parametrize("panel", [1e-4, 1.0, 100.0])
def test_triangles_keep_their_panels_and_quadrilaterals_shear(panel):
    """Claim C3 at one attraction: without diagonals panels shear, whatever keeps them flat."""
    target = make_target("paraboloid", 28, 10)
    sheet = design_sheet("miura", target.section_lengths(), 15, 16, 60.0, 0)
    quads, triangles = (
        try_force_ratios(sheet, target, Fold(), kind, 100.0, panel)
        for kind in ("quadrilaterals", "triangles")
    )
    assert triangles.folded and triangles.shear_max < 0.1
    assert quads.reached  # the target is met all the same, by other panels than were given
    assert not quads.folded and quads.shear_max > 0.2
