"""Formulas against structuralcodes of the fib (pip install structuralcodes): integrals of strain
profiles at collapse, shear without links, crack widths, least steel."""

import math

import numpy as np
import pytest

from foldshell.checks.concrete import cracking, shear
from foldshell.checks.concrete.sandwich import Levels, design_sandwich
from foldshell.checks.concrete.strengths import find_strengths

pytestmark = pytest.mark.slow

STRENGTHS = find_strengths(25e3, 500e3, es=200e6)


@pytest.fixture(scope="module")
def code():
    return pytest.importorskip("structuralcodes.codes.ec2_2004")


def make_section(thickness, distance, bottom, top):
    """1 m of shell with a rectangular stress block of f_cd (lambda = 1, as in a sandwich: whole
    depth at f_cd) and bars (mm2) at a distance from either face, in mm and MPa."""
    pytest.importorskip("structuralcodes")
    from structuralcodes.geometry import RectangularGeometry, add_reinforcement
    from structuralcodes.materials.concrete import create_concrete
    from structuralcodes.materials.constitutive_laws import UserDefined
    from structuralcodes.materials.reinforcement import create_reinforcement
    from structuralcodes.sections import BeamSection

    fcd = STRENGTHS.fcd / 1e3
    block = UserDefined([-0.01, -1e-9, 0.0, 0.1], [-fcd, -fcd, 0.0, 0.0], name="block")
    concrete = create_concrete(fck=25, design_code="ec2_2004", constitutive_law=block)
    steel = create_reinforcement(
        fyk=500, Es=200e3, ftk=500, epsuk=0.05, design_code="ec2_2004",
        constitutive_law="elasticperfectlyplastic",
    )  # fmt: skip
    section = RectangularGeometry(1000, thickness, concrete)
    for area, y in ((bottom, distance - thickness / 2), (top, thickness / 2 - distance)):
        if area > 0:
            section = add_reinforcement(section, (0.0, y), math.sqrt(4 * area / math.pi), steel)
    return BeamSection(section, integrator="marin")


def integrate(section, strain, curvature):
    """N (kN/m) and m (kNm/m, tension at the bottom positive) of a strain profile."""
    found = section.section_calculator.integrate_strain_profile([strain, curvature, 0])
    return found.n / 1e3, found.m_y / 1e6


@pytest.mark.parametrize("force", [80.0, 250.0])
def test_membrane_tension_to_four_digits(force):
    """All steel yields and the concrete is torn: N is the force designed for."""
    levels = Levels(0.021, STRENGTHS.fcd, STRENGTHS.strut)
    found = design_sandwich(np.array([force, 0, 0]), np.zeros(3), np.array(0.1), levels)
    area = found.steel[:, 0] / STRENGTHS.fyd * 1e6
    section = make_section(100, 21, *area)
    normal, moment = integrate(section, 0.005, 0.0)
    assert normal == pytest.approx(force, rel=1e-4)
    assert moment == pytest.approx(0.0, abs=1e-6 * force)


@pytest.mark.parametrize(("thickness", "distance", "m"), [(100, 21, 5.0), (200, 28, 50.0)])
def test_slabs_within_one_per_cent(thickness, distance, m):
    """The neutral axis stands where the block balances the bars; 1 %: passes of the lever and
    fibres of the integral."""
    levels = Levels(distance / 1e3, STRENGTHS.fcd, STRENGTHS.strut)
    found = design_sandwich(np.zeros(3), np.array([m, 0, 0]), np.array(thickness / 1e3), levels)
    area = found.steel[0, 0] / STRENGTHS.fyd * 1e6
    section = make_section(thickness, distance, area, 0.0)
    depth = found.steel[0, 0] / STRENGTHS.fcd * 1e3
    curvature = 0.001 / depth
    normal, moment = integrate(section, curvature * (thickness / 2 - depth), -curvature)
    assert normal == pytest.approx(0.0, abs=0.01 * found.steel[0, 0])
    assert abs(moment) == pytest.approx(m, rel=0.01)


@pytest.mark.parametrize("stress", [-3e3, 0.0, 1.2e3, 4e3])
@pytest.mark.parametrize(("depth", "ratio"), [(0.03, 0.002), (0.079, 0.01), (0.25, 0.03)])
def test_shear_without_links_is_equal(code, depth, ratio, stress):
    own = shear.resistance_without_links(
        np.array(depth), np.array(ratio), np.array(stress), 25e3, STRENGTHS.fcd
    )
    theirs = code.VRdc(
        fck=25, d=1e3 * depth, Asl=ratio * depth * 1e6, bw=1000, NEd=-stress * depth * 1e3,
        Ac=depth * 1e6, fcd=STRENGTHS.fcd / 1e3,
    )  # fmt: skip
    assert own == pytest.approx(theirs / 1e3, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("stress", [60e3, 200e3, 400e3])
@pytest.mark.parametrize("ratio", [0.005, 0.02, 0.08])
def test_crack_widths_are_equal(code, stress, ratio):
    at = STRENGTHS.fctm, STRENGTHS.es, STRENGTHS.ecm
    own = cracking.crack_width(np.array(stress), np.array(ratio), np.array(0.015), 0.006, *at)
    strain = code.eps_sm_eps_cm(stress / 1e3, at[1] / at[2], ratio, 0.4, at[0] / 1e3, at[1] / 1e3)
    theirs = code.wk(code.sr_max_close(15, 6, ratio, 0.8, 1.0), strain)
    assert 1e3 * own == pytest.approx(theirs, rel=1e-12)
    spacing = cracking.inclined_spacing(np.array([0.15, 0.2]), np.array(0.4))
    assert spacing == pytest.approx(code.sr_max_theta(0.15, 0.2, 0.4), rel=1e-12)


def test_least_steel_is_equal(code):
    own = cracking.least_steel_area(np.array(0.04), STRENGTHS.fctm, 500e3)
    theirs = code.As_min(40e3, 500, STRENGTHS.fctm / 1e3, 1.0, 1.0)
    assert 1e6 * own == pytest.approx(theirs, rel=1e-12)
