"""C4 to C9 on pairs made by hand: each can hold, fail, be mixed and not be told."""

import pytest

from claims_case import make_design_result
from foldshell.claims import structure
from foldshell.claims.design_result import Comparer

COMPARER = Comparer()


def _heights(quantity, values, **columns):
    return [
        make_design_result({quantity: value}, height_m=height, **columns)
        for value, height in zip(values, (6.0, 10.0, 28.0), strict=True)
    ]


@pytest.mark.parametrize(
    ("used", "moved", "verdict"),
    [
        ((0.6, 0.5, 0.4), (0.09, 0.06, 0.03), "holds"),
        ((0.4, 0.5, 0.6), (0.03, 0.06, 0.09), "fails"),
        ((0.6, 0.5, 0.4), (0.03, 0.06, 0.09), "mixed"),
        ((0.5, 0.5, 0.5), (0.06, 0.06, 0.06), "cannot_be_told"),
    ],
)
def test_lower_curvature(used, moved, verdict):
    designs = [
        make_design_result({"utilization_mean": u, "displacement": w}, height_m=h)
        for u, w, h in zip(used, moved, (6.0, 10.0, 28.0), strict=True)
    ]
    assert structure.judge_curvature(designs, COMPARER).judge()[0] == verdict


@pytest.mark.parametrize(
    ("folded", "smooth", "verdict"),
    [
        ((0.05, 0.06, 0.08), (0.05, 0.045, 0.04), "holds"),
        ((0.08, 0.06, 0.05), (0.04, 0.05, 0.06), "fails"),
        ((0.05, 0.06, 0.08), (0.04, 0.05, 0.06), "mixed"),
        ((0.05, 0.05, 0.05), (0.05, 0.05, 0.05), "cannot_be_told"),
    ],
)
def test_material_of_folded_and_smooth(folded, smooth, verdict):
    designs = _heights("volume_per_area", folded)
    designs += _heights("volume_per_area", smooth, pattern="smooth")
    assert structure.judge_material(designs, COMPARER).judge()[0] == verdict


def test_smooth_shells_at_the_least_thickness_need_no_more():
    """All panels at the bound: the volumes per area are equal and certain."""
    thin = {"volume_per_area": 0.04, "panels_at_bound": 210}
    designs = _heights("volume_per_area", (0.05, 0.06, 0.08))
    designs += [make_design_result(thin, height_m=h, pattern="smooth") for h in (6.0, 10.0)]
    assert structure.judge_material(designs, COMPARER).judge()[0] == "holds"


@pytest.mark.parametrize(
    ("dome", "arch", "saddle", "verdict"),
    [
        (0.08, 0.06, 0.05, "holds"),
        (0.05, 0.06, 0.08, "fails"),
        (0.06, 0.05, 0.08, "mixed"),
        (0.05, 0.05, 0.05, "cannot_be_told"),
    ],
)
def test_surfaces(dome, arch, saddle, verdict):
    values = {"paraboloid": dome, "arch": arch, "hypar": saddle}
    designs = [make_design_result({"volume_per_area": v}, surface=s) for s, v in values.items()]
    claim = structure.judge_surfaces(designs, COMPARER)
    assert claim.judge()[0] == verdict
    assert len(claim.findings) == 3


def test_a_group_without_one_of_the_surfaces_is_left_out():
    designs = [make_design_result(surface=s) for s in ("paraboloid", "arch")]
    claim = structure.judge_surfaces(designs, COMPARER)
    assert claim.findings == [] and claim.judge()[0] == "cannot_be_told"


def _supported(variation, volume, moved):
    return [
        make_design_result(
            {"utilization_variation": a, "volume_per_area": b, "displacement": c}, support=support
        )
        for support, a, b, c in zip(("strip", "zigzag"), variation, volume, moved, strict=True)
    ]


@pytest.mark.parametrize(
    ("variation", "volume", "moved", "verdict"),
    [
        ((0.3, 0.5), (0.08, 0.05), (0.09, 0.05), "holds"),
        ((0.5, 0.3), (0.05, 0.08), (0.05, 0.09), "fails"),
        ((0.3, 0.5), (0.05, 0.08), (0.09, 0.05), "mixed"),
        ((0.5, 0.5), (0.05, 0.05), (0.05, 0.05), "cannot_be_told"),
    ],
)
def test_supports(variation, volume, moved, verdict):
    designs = _supported(variation, volume, moved)
    assert structure.judge_supports(designs, COMPARER).judge()[0] == verdict


def test_the_stronger_axis_is_judged_at_equal_thickness():
    designs = _supported((0.3, 0.5), (0.08, 0.05), (0.09, 0.05))
    weak = _supported((0.3, 0.5), (0.08, 0.05), (0.05, 0.09))
    verdict, parts = structure.judge_supports(designs, COMPARER, weak).judge()
    assert verdict == "mixed"
    assert parts["stronger zig-zag axis: more deflection at equal thickness"] == "fails"


@pytest.mark.parametrize(
    ("depth", "moved", "verdict"),
    [
        ((1.9, 0.9), (0.05, 0.09), "holds"),
        ((0.9, 1.9), (0.09, 0.05), "fails"),
        ((1.9, 0.9), (0.09, 0.05), "mixed"),
        ((None, None), (0.05, 0.05), "cannot_be_told"),
    ],
)
def test_zigzags(depth, moved, verdict):
    designs = [
        make_design_result({"depth": d, "displacement": w}, zigzag=n)
        for d, w, n in zip(depth, moved, (15, 30), strict=True)
    ]
    assert structure.judge_zigzags(designs, COMPARER).judge()[0] == verdict


def test_zigzags_are_compared_at_the_same_count_of_strips():
    designs = [make_design_result(zigzag=15, strip=16), make_design_result(zigzag=8, strip=32)]
    assert structure.judge_zigzags(designs, COMPARER).findings == []


@pytest.mark.parametrize(
    ("area", "variation", "verdict"),
    [
        ((2.0, 1.0), (0.5, 0.3), "holds"),
        ((1.0, 2.0), (0.3, 0.5), "fails"),
        ((2.0, 1.0), (0.3, 0.5), "mixed"),
        ((2.0, 1.0), (0.5, 0.5), "cannot_be_told"),
    ],
)
def test_strips(area, variation, verdict):
    designs = [
        make_design_result({"panel_area": a, "utilization_variation": v}, strip=n)
        for a, v, n in zip(area, variation, (16, 32), strict=True)
    ]
    assert structure.judge_strips(designs, COMPARER).judge()[0] == verdict


def test_exact_folds_do_not_enter():
    designs = [make_design_result({"displacement": w}, height_m=h, fold_mode="exact")
               for w, h in ((0.09, 6.0), (0.03, 10.0))]  # fmt: skip
    assert structure.judge_curvature(designs, COMPARER).findings == []
