"""The stress-ratio rule: long steps far from the target, the dead band's end."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.settings.sizing import Sizing
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.case import make_case
from foldshell.sizing.loop import run_loop
from foldshell.sizing.rules import start_state
from foldshell.sizing.stress_ratio import limit_step, stress_ratio
from sizing_case import SPAN, corrugated_sheet, given

LIMITS = Sizing(rule="stress_ratio")


def state(utilization, thickness=0.2, **changes):
    used = np.asarray(utilization, float)
    return replace(start_state(np.full(len(used), thickness), 0.1), utilization=used, **changes)


def test_steps_are_the_ratio_between_the_step_and_its_limit():
    """t u / 0.6 at u = 0.5 and 0.36, at most 45 % at 0.2, at least the step of 10 % at 0.58; the
    band stands and what is above it grows by the step."""
    new = stress_ratio(state([0.5, 0.36, 0.2, 0.58, 0.6, 1.0, 1.4]), LIMITS)
    expected = 0.2 * np.array([0.5 / 0.6, 0.6, 0.55, 0.9, 1.0, 1.0, 1.1])
    assert new.thickness == pytest.approx(expected, rel=1e-12)


def test_a_membrane_panel_reaches_the_band_in_one_step():
    """A bar under a force of its own has u = c / t: fully stressed design is exact for it."""
    force = 0.06
    new = stress_ratio(state([force / 0.15], 0.15), replace(LIMITS, utilization_min=0.65))
    assert force / new.thickness[0] == pytest.approx(0.65)


def test_a_panel_that_has_turned_goes_by_its_own_step_halved_at_every_turn():
    now = state([1.2])
    shares = []
    for used in (0.3, 1.2, 0.3, 0.3, 1.2):
        before = now.thickness[0]
        now = stress_ratio(replace(now, utilization=np.array([used])), LIMITS)
        shares.append(now.thickness[0] / before - 1)
    assert shares == pytest.approx([-0.45, 0.05, -0.025, -0.025, 0.0125])


@pytest.mark.parametrize(
    ("factor", "share", "longest"),
    [
        (np.inf, 0.0, 1.0),
        (24.0, 0.0, 0.5),
        (3.0, 0.0, 0.0),
        (1.6, 0.0, 0.0),
        (24.0, 0.512, 0.2),
    ],
)
def test_long_steps_keep_stability_and_displacement_by_a_cubic_law(factor, share, longest):
    """(1 - s)^3 = 2 x 1.5 / 24 leaves half of the thickness; 0.8^3 = 0.512."""
    now = state([0.1], least_factor=factor, displacement_share=share)
    assert limit_step(now, LIMITS) == pytest.approx(longest)
    new = stress_ratio(now, LIMITS)
    assert new.thickness[0] == pytest.approx(0.2 * (1 - np.clip(longest, 0.1, 0.45)))


def test_nothing_thins_where_it_is_not_allowed():
    new = stress_ratio(state([0.2, 1.2], may_thin=False), LIMITS)
    assert new.thickness == pytest.approx([0.2, 0.22])


@pytest.mark.parametrize("support", ["all", "zigzag"])
def test_it_ends_near_the_dead_band_in_fewer_analyses(support):
    """On the small sheet: the same end, stable on the way, less analyses, and a volume within half
    a step of 10 %: either end is one of many in the band."""
    mesh, ends = mesh_folded_sheet(corrugated_sheet(), support, 2), {}
    for rule in ("dead_band", "stress_ratio"):
        sizing = {"rule": rule, "least_thickness": 0.01}
        case = make_case(mesh, given("analyse", **sizing))
        ends[rule] = run_loop(case, SPAN, given("size", **sizing).sizing)
    slow, quick = ends["dead_band"], ends["stress_ratio"]
    assert quick.final.verdict == slow.final.verdict
    assert all(one.state == "ok" for one in quick.analyses)
    assert len(quick.analyses) < 0.8 * len(slow.analyses)
    assert quick.final.volume_m3 == pytest.approx(slow.final.volume_m3, rel=0.05)
