"""Combinations by the paper, ASCE 7 and EN 1990: every factor against the printed rule."""

import pytest

from foldshell.settings.codes import Codes, En1990
from foldshell.settings.combination_rules import Action, generate_combinations
from foldshell.settings.load_rows import LoadRow
from foldshell.settings.load_sets import PAPER_ACTIONS, list_actions
from foldshell.settings.loads import Combinations

ROOF = (
    Action("G", "permanent"),
    Action("S1", "snow"),
    Action("S2", "snow"),
    Action("W", "wind", True),
    Action("T", "temperature", True),
    Action("LL", "imposed"),
)


def values(found):
    return [dict(sorted(one.items())) for one in found.values()]


def test_the_papers_factors_are_among_those_of_its_rule_with_wind_both_ways():
    """Table 2 of the paper; WX, WY and their negatives in S2 to S5 and D2, D3."""
    made = generate_combinations("paper", PAPER_ACTIONS, Codes())
    given = Combinations()
    assert all(
        dict(sorted(one.items())) in values(made.strength) for one in given.strength.values()
    )
    assert all(dict(sorted(one.items())) in values(made.characteristic)
               for one in given.deflection.values())  # fmt: skip
    assert len(made.strength) == 9 and len(made.characteristic) == 5
    assert {"LL": 1.0, "SDL": 1.2, "SW": 1.2, "WY": -1.0} in values(made.strength)


def test_asce7_of_the_papers_cases():
    """ASCE/SEI 7-16 section 2.3.1, combinations 1 to 5."""
    found = values(generate_combinations("asce7", PAPER_ACTIONS, Codes()).strength)
    for wind in ("WX", "WY"):
        for way in (1.0, -1.0):
            assert {"SDL": 0.9, "SW": 0.9, wind: way} in found
            assert {"LL": 1.0, "SDL": 1.2, "SW": 1.2, wind: way} in found
            assert {"LL": 1.6, "SDL": 1.2, "SW": 1.2, wind: way / 2} in found
    assert {"SDL": 1.4, "SW": 1.4} in found and {"LL": 1.6, "SDL": 1.2, "SW": 1.2} in found
    assert len(found) == 18


def test_asce7_with_snow_and_temperature():
    found = values(generate_combinations("asce7", ROOF, Codes()).strength)
    assert {"G": 1.2, "S2": 1.6, "W": -0.5} in found
    assert {"G": 1.2, "LL": 1.6, "S1": 0.5} in found
    assert {"G": 1.2, "LL": 1.0, "S1": 0.5, "W": 1.0} in found
    assert {"G": 1.2, "T": -1.2} in found
    assert not any("S1" in one and "S2" in one for one in found)  # they exclude each other


def test_en1990_leading_and_accompanying_actions():
    """(6.10): 1.35 G + 1.5 Q1 + 1.5 psi0 Qi with psi0 0.5 snow, 0.6 wind, 0.6 temperature, 0
    imposed on roofs of category H (Table A1.1)."""
    made = generate_combinations("en1990", ROOF, Codes())
    found = values(made.strength)
    assert {"G": 1.35, "S1": 1.5, "T": 0.9, "W": -0.9} in found
    assert {"G": 1.35, "S2": 0.75, "W": 1.5} in found
    assert {"G": 1.0, "W": -1.5} in found
    assert {"G": 1.35, "LL": 1.5, "S1": 0.75, "W": 0.9} in found
    assert not any(one.get("LL") not in (None, 1.5) for one in found)
    assert values(made.quasi_permanent) == [{"G": 1.0}]
    assert {"G": 1.0, "S1": 1.0, "W": 0.6} in values(made.characteristic)


def test_en1990_takes_its_factors_from_the_settings():
    codes = Codes(en1990=En1990(imposed_psi0=0.7, imposed_psi2=0.3, permanent_unfavourable=1.2))
    made = generate_combinations("en1990", PAPER_ACTIONS, codes)
    assert {"LL": 1.05, "SDL": 1.2, "SW": 1.2, "WX": 1.5} in values(made.strength)
    assert values(made.quasi_permanent) == [{"SDL": 1.0, "SW": 1.0},
                                            {"LL": 0.3, "SDL": 1.0, "SW": 1.0}]  # fmt: skip


def test_settlements_are_there_or_not():
    made = generate_combinations("en1990", (*PAPER_ACTIONS[:3], Action("U", "settlement")), Codes())
    found = values(made.strength)
    assert {"LL": 1.5, "SDL": 1.35, "SW": 1.35} in found
    assert {"LL": 1.5, "SDL": 1.35, "SW": 1.35, "U": 1.2} in found
    assert {"SDL": 1.0, "SW": 1.0, "U": 1.0} in values(made.quasi_permanent)


@pytest.mark.parametrize("rule", ["paper", "asce7", "en1990"])
def test_names_are_numbered_and_no_combination_stands_twice(rule):
    made = generate_combinations(rule, ROOF, Codes())
    for prefix, group in (("ULS", made.strength), ("SLS", made.characteristic),
                          ("QP", made.quasi_permanent)):  # fmt: skip
        assert list(group) == [f"{prefix}{k + 1}" for k in range(len(group))]
        found = [tuple(one.items()) for one in values(group)]
        assert len(set(found)) == len(found) and all(found)
        assert all(factor for one in group.values() for factor in one.values())


def test_a_flood_of_combinations_is_refused():
    many = [Action(f"W{k}", "wind", True) for k in range(12)]
    many += [Action(f"S{k}", "snow") for k in range(12)]
    with pytest.raises(ValueError, match="at most 120"):
        generate_combinations("en1990", [Action("G", "permanent"), *many], Codes())


def test_wind_along_an_axis_turns_round_and_pressures_on_facets_do_not():
    rows = [
        LoadRow("WX", "pressure", 1.0, "x", action="wind"),
        LoadRow("WP", "pressure", 1.0, "-normal", action="wind"),
        LoadRow("WQ", "pressure", 1.0, "-normal", action="wind", sign="both"),
        LoadRow("WM", "pressure", 1.0, "x", action="wind"),
        LoadRow("WM", "pressure", 1.0, "-normal", action="wind"),
    ]
    assert [one.both_ways for one in list_actions(rows)] == [True, False, True, False]
