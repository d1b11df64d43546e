"""C1, C2, C3 and C14 on tables made by hand."""

from dataclasses import replace

import pytest

from claims_case import make_design_result
from foldshell.claims import kinematics
from foldshell.claims.design_result import Comparer
from foldshell.records.kinematics import (
    ForceRatioTrial,
    KinematicsRecord,
    MechanismCount,
    RatioRow,
    SheetRecord,
    SoftMode,
)
from record_cases import make_quality

COMPARER = Comparer()


QUADS, TRIANGLES = (True, False), (True, True)
"""Two strengths: one of them folds quadrilaterals, both fold triangles."""


def _fold_all(engine, quads=QUADS, triangles=TRIANGLES):
    zero = dict.fromkeys(("attraction", "panel", "rms_over_span", "crease_strain_max", "shear_max",
                          "planarity_max"), 0.0)  # fmt: skip
    return [
        ForceRatioTrial(surface="hypar", engine=engine, panels=kind, reached=one, folded=False,
                        iterations=7, flipped_folds=0, self_intersections=0, **zero)
        for kind, values in (("quadrilaterals", quads), ("triangles", triangles)) for one in values
    ]  # fmt: skip


def _table(ratio=-1.0, shapes=("twist", "saddle"), dome=0.5, stresses=(20, 0), strengths=()):
    modes = tuple(SoftMode(panel_over_crease=1.0, stiffness=k + 1.0, shape=shape, agreement=1.0)
                  for k, shape in enumerate((*shapes, "other")))  # fmt: skip
    residual = {"twist": 0.0, "saddle": 0.0, "dome": dome, "arch": dome}
    rigid, bending = (MechanismCount(freedoms=1, self_stresses=count) for count in stresses)
    ratios = RatioRow(fold_angle_deg=50.0, in_plane=ratio, in_plane_exact=ratio + 1e-9,
                      bending=1.0, bending_exact=1.0, bending_residual=0.0)  # fmt: skip
    sheet = SheetRecord(zigzag=7, strip=8, modes=modes, isometry_residual=residual,
                        rigid_panels=rigid, bending_panels=bending)  # fmt: skip
    return KinematicsRecord(sector_angle_deg=60.0, ratios=(ratios,), sheets=(sheet,),
                            force_ratios=tuple(strengths), geometric_rules=())  # fmt: skip


@pytest.mark.parametrize(
    ("ratio", "verdict"), [(-1.2, "holds"), (0.3, "fails"), (1e-10, "cannot_be_told")]
)
def test_auxetic(ratio, verdict):
    assert kinematics.judge_auxetic(_table(ratio)).judge()[0] == verdict


@pytest.mark.parametrize(
    ("shapes", "dome", "verdict"),
    [
        (("twist", "saddle"), 0.5, "holds"),
        (("other", "other"), 0.5, "mixed"),
        (("twist", "saddle"), 0.0, "cannot_be_told"),
    ],
)
def test_soft_modes(shapes, dome, verdict):
    claim = kinematics.judge_soft_modes(_table(shapes=shapes, dome=dome), [], COMPARER)
    assert claim.judge()[0] == verdict


def test_strain_of_designs_enters():
    designs = [make_design_result({"edge_strain_rms": e}, surface=s)
               for s, e in (("paraboloid", 0.001), ("hypar", 0.01))]  # fmt: skip
    verdict, parts = kinematics.judge_soft_modes(_table(), designs, COMPARER).judge()
    assert verdict == "mixed"
    assert parts["dome: edges of designs strained more than the hypar's"] == "fails"


@pytest.mark.parametrize(
    ("quads", "triangles", "stresses", "verdict"),
    [
        ((True, False), (True, True), (20, 0), "holds"),
        ((True, True), (True, False), (0, 0), "fails"),
        ((True, False), (True, False), (20, 0), "mixed"),
        ((False, False), (True, True), (20, 0), "mixed"),
    ],
)
def test_strengths(quads, triangles, stresses, verdict):
    table = _table(strengths=_fold_all("own", quads, triangles), stresses=stresses)
    assert kinematics.judge_force_ratios(table).judge()[0] == verdict


def test_engines_that_disagree_are_told_apart():
    strengths = _fold_all("one") + _fold_all("other_way", triangles=(True, False))
    claim = kinematics.judge_force_ratios(_table(strengths=strengths))
    verdict, parts = claim.judge()
    assert verdict == parts["triangles reach the target at all strengths"] == "mixed"
    assert len(claim.parts["triangles reach the target at all strengths"]) == 2
    assert "By one alone: holds, from 4 foldings of at most 7 iterations." in claim.notes
    assert "By other way alone: mixed, from 4 foldings of at most 7 iterations." in claim.notes


def _folded(mode, **quality):
    exact = {"planarity_max": 1e-15, "edge_strain_max": 1e-14, "angle_defect_max_rad": 1e-15,
             "flat_foldability_max_rad": 1e-15} | quality  # fmt: skip
    one = make_design_result({"flat_foldability_max_rad": exact.pop("flat_foldability_max_rad")},
                             fold_mode=mode)  # fmt: skip
    return replace(one, quality=make_quality(**exact))


def test_foldability_is_judged_by_the_mode_of_the_paper():
    soft = {"planarity_max": 0.05, "angle_defect_max_rad": 0.2, "flat_foldability_max_rad": 0.03}
    designs = [_folded("elastic", **soft), _folded("rigid"), _folded("exact")]
    verdict, parts = kinematics.judge_foldability(designs).judge()
    assert verdict == "fails"
    assert parts["rigid foldability, mode rigid"] == "holds"
    assert kinematics.judge_foldability([_folded("elastic")]).judge()[0] == "holds"
    some = [_folded("elastic", flat_foldability_max_rad=0.2)]
    assert kinematics.judge_foldability(some).judge()[0] == "mixed"
    assert kinematics.judge_foldability([_folded("exact")]).judge()[0] == "cannot_be_told"


def test_edges_that_stretch_are_not_rigid():
    (first, *_) = kinematics.judge_foldability([_folded("elastic", edge_strain_max=0.02)]).findings
    assert first.verdict == "fails" and first.quantity == "edge_strain_max"
