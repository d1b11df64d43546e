"""A Miura derivative goes through the same interface, and does what it is for."""

import pytest

from foldshell.folding.fold import fold_sheet
from foldshell.folding.targets import make_target, measure_turning
from foldshell.pattern.design import design_sheet
from foldshell.settings.fold import Fold


def _fold(kind, mode):
    target = make_target("arch_strip", 28, 6)
    turning = measure_turning(target)
    sheet = design_sheet(kind, target.section_lengths(), 15, 16, 60.0, 0, turning)
    return fold_sheet(sheet, target, mode, Fold())


@pytest.mark.parametrize("mode", ["elastic", "exact", "rigid"])
def test_arc_miura_folds_in_every_mode(mode):
    result = _fold("arc_miura", mode)
    assert result.state == "ok", result.reason
    assert result.quality.rms_over_span <= 2e-4


def test_arc_miura_follows_an_arch_with_less_stretch():
    """It is born curved: strain falls, and bent isometrically it comes far nearer the arch."""
    strain = {
        kind: _fold(kind, "elastic").quality.edge_strain_rms for kind in ("miura", "arc_miura")
    }
    assert strain["arc_miura"] < 0.8 * strain["miura"]
    rms = {k: _fold(k, "isometric").quality.rms_over_span for k in ("miura", "arc_miura")}
    assert rms["arc_miura"] < 0.3 * rms["miura"]
