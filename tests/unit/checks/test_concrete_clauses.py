"""Strengths, cracks, shear, punching, covers: numbers worked from the clauses by hand."""

import numpy as np
import pytest

from foldshell.checks.concrete import cracking, detailing, punching, shear
from foldshell.checks.concrete.strengths import find_strengths, refuse_strength, tension_strength

C25 = find_strengths(25e3, 500e3)


def test_strengths_of_table_3_1():
    """f_ctm and E_cm of Table 3.1 (two digits there), nu of 6.6N."""
    assert C25.fcd == pytest.approx(16666.7, rel=1e-5)
    assert C25.strut / C25.fcd == pytest.approx(0.54)
    assert C25.fyd == pytest.approx(434782.6, rel=1e-6)
    for mpa, fctm in ((12, 1.6), (20, 2.2), (25, 2.6), (35, 3.2), (50, 4.1), (60, 4.4), (90, 5.0)):
        assert tension_strength(mpa * 1e3) / 1e3 == pytest.approx(fctm, abs=0.06)
    assert C25.ecm / 1e6 == pytest.approx(31, abs=0.5)


@pytest.mark.parametrize(
    ("fck", "fyk", "word"), [(11, 500, "fck"), (95, 500, "fck"), (25, 700, "fyk")]
)
def test_strengths_outside_the_code_are_named(fck, fyk, word):
    assert word in refuse_strength(fck * 1e3, fyk * 1e3, "bars")
    assert refuse_strength(25e3, 2000e3, "textile") == ""


def test_least_steel_of_a_sheet_that_cracks_at_104_kn():
    """f_ctm of 2.6 MPa on 40 mm is 104 kN/m: 2.08 cm2/m at 500 MPa, k = 1 and k_c = 1."""
    area = cracking.least_steel_area(np.array([0.04, 0.3, 0.8, 1.2]), 2600, 500e3)
    assert area[0] == pytest.approx(2.08e-4)
    assert area[1:] == pytest.approx(np.array([1, 0.65, 0.65]) * 2600 * [0.3, 0.8, 1.2] / 500e3)


def test_crack_width_of_a_tie():
    """rho 2 %, 300 MPa, c 15, phi 6: s = 3.4 15 + 0.8 0.425 6 / 0.02 = 153 mm; strain by 7.9."""
    ecm, es = 31e6, 200e6
    strain = (300e3 - 0.4 * 2600 / 0.02 * (1 + 200 / 31 * 0.02)) / es
    width = cracking.crack_width(
        np.array(300e3), np.array(0.02), np.array(0.015), 0.006, 2600, es, ecm
    )
    assert width == pytest.approx(0.153 * strain)
    low = cracking.mean_strain(np.array(50e3), np.array(0.005), 2600, es, ecm)
    assert low == pytest.approx(0.6 * 50e3 / es)


def test_cracks_across_both_bars_are_closer():
    spacing = np.array([[0.2, 0.2], [0.2, 0.2]])
    found = cracking.inclined_spacing(spacing, np.array([0.0, np.pi / 4]))
    assert found == pytest.approx([0.2, 0.2 / np.sqrt(2)])


def test_depth_in_tension_takes_the_least_of_three():
    assert cracking.effective_depth_in_tension(0.1, 0.021) == pytest.approx(0.05)
    assert cracking.effective_depth_in_tension(0.2, 0.021) == pytest.approx(0.0525)
    assert cracking.effective_depth_in_tension(0.2, 0.021, 0.08) == pytest.approx(0.04)


def test_shear_without_links_by_hand():
    """d 172 mm, rho 0.5 %, f_ck 25: k = 2 (1 + sqrt(200/172) > 2), 0.12 2 (12.5)^(1/3) = 0.557
    MPa; with 1 MPa of tension 0.15 MPa less. Without bars v_min = 0.035 2^1.5 5 = 0.495 MPa."""
    at = dict(fck=25e3, fcd=C25.fcd)
    found = shear.resistance_without_links(
        np.array(0.172), np.array([0.005, 0.005, 0.0]), np.array([0, 1e3, 0]), **at
    )
    bars = 0.12 * 2 * 12.5 ** (1 / 3) * 1e3
    assert found == pytest.approx(0.172 * np.array([bars, bars - 150, 0.035 * 2**1.5 * 5 * 1e3]))
    torn = shear.resistance_without_links(np.array(0.03), np.array(0.0), np.array(9e3), **at)
    assert torn == 0


def test_principal_shear_and_what_links_pull():
    size, direction = shear.principal_shear(np.array([[30.0, 40.0], [0, 0]]))
    assert size == pytest.approx([50, 0])
    assert direction[0] == pytest.approx([0.6, 0.8])
    pulled = shear.forces_of_links(np.array([30.0, 40.0]), 2.0)
    assert pulled == pytest.approx(2.0 / 50 * np.array([900, 1600, 1200]))
    assert pulled[:2].sum() == pytest.approx(50 * 2.0)


def test_links_and_their_struts_by_hand():
    """v 100 kN/m, z 150 mm, cot 2.5: 100 / (0.15 434.8e3 2.5) = 6.13 cm2/m2; v_Rd,max by 6.9."""
    assert shear.links_per_area(100.0, 0.15, 434.8e3, 2.5) == pytest.approx(6.133e-4, rel=1e-3)
    limit = shear.resistance_of_struts(np.array(0.15), np.array(0.0), 25e3, C25.fcd, 2.5)
    assert limit == pytest.approx(0.15 * 0.54 * C25.fcd / 2.9)


def test_punching_takes_both_directions():
    at = dict(fck=25e3, fcd=C25.fcd)
    found = punching.punching_resistance(
        np.array(0.1), np.array([0.01, 0.0025]), np.array([-1e3, -3e3]), **at
    )
    assert found == pytest.approx(0.1 * (0.12 * 2 * 12.5 ** (1 / 3) * 1e3 + 0.1 * 2e3))
    assert punching.face_resistance(0.1, 25e3, C25.fcd) == pytest.approx(0.4 * 0.54 * C25.fcd * 0.1)


@pytest.mark.parametrize(
    ("exposure", "structural", "deviation", "millimetres"),
    [("X0", "S4", 0, 10), ("XC1", "S4", 0, 15), ("XC4", "S4", 0, 30), ("XC4", "S4", 10, 40),
     ("XS3", "S4", 0, 45), ("XD3", "S6", 10, 65), ("XC3", "S2", 0, 15)],
)  # fmt: skip
def test_covers_of_table_4_4(exposure, structural, deviation, millimetres):
    found = detailing.least_cover(exposure, structural, 0.006, deviation / 1e3)
    assert found == pytest.approx(millimetres / 1e3)


def test_thick_bars_need_their_own_diameter_as_cover():
    assert detailing.least_cover("XC1", "S4", 0.025) == pytest.approx(0.025)


def test_what_fits():
    assert detailing.least_thickness_of_layers(0.015, 0.006) == pytest.approx(0.054)
    assert detailing.least_thickness_of_layers(0.010, 0.002) == pytest.approx(0.028)
    assert detailing.least_clear_distance(0.006, 0.008) == pytest.approx(0.020)
    assert detailing.least_clear_distance(0.032, 0.016) == pytest.approx(0.032)
    area = np.pi * 0.006**2 / 4 / 0.1
    assert detailing.bar_spacing(np.array([area, 0.0]), 0.006).tolist() == [
        pytest.approx(0.1), np.inf]  # fmt: skip
    assert detailing.crack_limit("XC1") == 0.0004 and detailing.crack_limit("XC4") == 0.0003
