"""Slopes of sized designs: the rest of a first order, and designs that were sized anew."""

import numpy as np
import pytest

from foldshell.explore import rounds
from foldshell.explore.slopes import (
    ACTIVE,
    Slope,
    differentiate,
    find_slopes,
    respond,
    size_state,
)
from foldshell.settings.design import Design
from foldshell.settings.exploration import Exploration, Search, SearchLimits, Variable
from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import SEARCHED, search_parameters

SETTINGS = make_settings({})
STAGE = read_stage(search_parameters(SETTINGS), *SEARCHED)
SECTOR, FOLD, GRADING = VARIABLES = (
    Variable("sector_angle_deg", 48.0, 75.0), Variable("rest_fold_angle_deg", 30.0, 62.0),
    Variable("strip_grading", -0.6, 0.6),
)  # fmt: skip


def make_exploration(subdivisions, variables=VARIABLES, **changed):
    """Return a search about a roof of 28 m with 11 x 12 lines on zig-zag edges, and its row."""
    plain = Design(name="base", **vars(SETTINGS.defaults)).to_row()
    row = {key: value for key, value in plain.items() if key not in ("design", "tags")}
    row |= {"span_m": 28.0, "height_m": 10.0, "zigzag": 11, "strip": 12, "support": "zigzag",
            "sector_angle_deg": 60.0, "rest_fold_angle_deg": 45.0} | changed  # fmt: skip
    search = Search(rule="optimality", subdivisions=subdivisions)
    return Exploration("t", row, variables, ("volume_m3",), SearchLimits(), search), row


def list_rests(given, state, variable):
    """Return the root mean square of f(x +- h) - f(x) -+ h f'(x) at 6 steps, each half the one
    before: of volume, then of the constraints, (6, 1 + m)."""

    def value(step):
        moved = {**state.columns, variable.name: state.columns[variable.name] + step}
        found = respond(state, moved, STAGE, given)
        return np.append(found.volume, found.values)

    found = differentiate(state, variable, STAGE, given, step=2e-4)
    slope, start = np.append(found.volume, found.values), value(0.0)
    steps = 0.06 * (variable.high - variable.low) / 2.0 ** np.arange(6)
    rests = [[value(sign * step) - start - sign * step * slope for sign in (1, -1)]
             for step in steps]  # fmt: skip
    return np.sqrt((np.array(rests) ** 2).mean(axis=1))


@pytest.mark.slow
def test_slopes_are_of_first_order():
    """The rest of a first order falls with h^2, order 2.0 +- 0.2 as is due of a derivative: volume,
    and each active constraint: utilization, displacement and buckling factor (second order).

    Fixed thickness, refolded until 1e-12. A panel's utilization is the mean of the larger of two
    surfaces, which has kinks where a point changes sides: so both directions, and the median of
    five halvings. By the grading the utilizations hardly bend (rests of 1e-7), which tells nothing.
    """
    given, row = make_exploration(1, surface="hypar", strip_grading=0.1)
    state = size_state(row, STAGE, given)
    known = state.constraints
    counts = [1, len(known.panels), len(known.nodes), len(known.factors)]
    kind = np.repeat(["volume", "utilization", "displacement", "factor"], counts)
    active = np.append(True, (known.value > ACTIVE) & (state.multipliers > 0))
    assert {name: int((active & (kind == name)).sum()) for name in kind} == {
        "volume": 1, "utilization": 13, "displacement": 1, "factor": 2,
    }  # fmt: skip
    for variable in VARIABLES:
        told = active & ((variable is not GRADING) | (kind != "utilization"))
        rests = list_rests(given, state, variable)[:, told]
        order = np.median(np.log2(rests[:-1] / rests[1:]), axis=0)
        assert np.abs(order - 2).max() < 0.2, (variable.name, order)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("surface", "variable", "half", "tolerance"),
    [("paraboloid", FOLD, 1.6, 0.2), ("hypar", FOLD, 1.6, 0.02), ("hypar", SECTOR, 1.0, 0.02)],
)
def test_slope_of_the_resized_volume(surface, variable, half, tolerance):
    """Against a central difference of designs sized anew until their volume is stationary.

    20 % is due. The loop on the hypar ends with its optimality condition met to 0.6 % and volumes
    scatter by 0.002 to 0.006 m3 about a parabola: 2 % holds. On the paraboloid it is met to 25 %,
    volumes scatter by 0.17 m3, 3 % of the difference.
    """
    given, row = make_exploration(2, (variable,), surface=surface)
    stage = STAGE.changed(STAGE.sizing.changed(stop="stationary"))
    (slope,) = find_slopes(size_state(row, stage, given), stage, given)
    low, high = (
        size_state({**row, variable.name: row[variable.name] + side}, stage, given).volume
        for side in (-half, half)
    )
    assert slope.volume == pytest.approx((high - low) / (2 * half), rel=tolerance)


def test_a_step_goes_down_the_slopes_and_stays_in_the_box(monkeypatch):
    """A tenth of the ranges along -dV/dx; a variable at the end that it heads for stands still."""
    from test_proposals import candidate, exploration

    best = candidate("01-00", (0.5, 0.0))
    slopes = [Slope("sector_angle_deg", 1.0, 1.0, 3.0), Slope("rest_fold_angle_deg", 1.0, 1.0, 4.0)]
    monkeypatch.setattr(rounds, "size_state", lambda *given: None)
    monkeypatch.setattr(rounds, "find_slopes", lambda *given: slopes)
    (point,) = rounds._go_down(exploration(), [best], None)
    np.testing.assert_allclose(point, [0.4, 0.0], atol=1e-6)
    inside = candidate("01-00", (0.5, 0.5))
    (point,) = rounds._go_down(exploration(), [inside], None)
    np.testing.assert_allclose(point, [0.5 - 0.06, 0.5 - 0.08], atol=1e-6)
    assert rounds._go_down(exploration(), [], None) == []
