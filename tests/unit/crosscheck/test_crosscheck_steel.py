"""The independent code's steel: states worked by hand, and both codes on random ones."""

import numpy as np
import pytest

from crosscheck.steel import Bars, reinforce, reinforce_membrane
from foldshell.checks.concrete.demand import find_demand
from foldshell.checks.concrete.layout import lay_out
from foldshell.settings.reinforcement import Reinforcement

STATES = [
    ((100, -50, 150), (250, 100, 300)),
    ((-300, 50, 150), (0, 125, 375)),
    ((50, -300, 150), (125, 0, 375)),
    ((200, 100, 50), (250, 150, 100)),
    ((-300, -200, 300), (0, 100, 600)),
    ((-300, -200, 150), (0, 0, 408.1139)),
]
"""n, and bars along x, y and strut, kN/m; worked by hand from EN 1992-1-1 F.2 to F.7."""


@pytest.mark.parametrize(("force", "expected"), STATES)
def test_membranes_worked_by_hand(force, expected):
    found = reinforce_membrane(*(np.array([float(one)]) for one in force))
    assert [float(one[0]) for one in found] == pytest.approx(expected, abs=1e-4)


def test_both_codes_design_the_same_steel_for_the_same_forces():
    """Equations written twice: 1e-9 of the largest component, round-off."""
    rng = np.random.default_rng(11)
    count = 20000
    force = rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(0, 3, (count, 1))
    moment = rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(-2, 1, (count, 1))
    thickness = rng.uniform(0.04, 0.2, count)
    theirs = reinforce(force, moment, thickness, Bars())
    layout = lay_out(Reinforcement())
    apart = (one.T[:, :, None, None] for one in (force, moment))
    own = find_demand(*apart, thickness, layout, 0.45)
    scale = np.abs(force).max(axis=1) + np.abs(moment).max(axis=1) / 0.01
    gap = np.abs(own.steel.reshape(count, 4) - theirs).max(axis=1) / scale
    assert gap.max() < 1e-9
