"""Loads of the paper's Table 2, those of a design's own set, and combinations; kN/m2."""

from foldshell.settings.codes import RULES
from foldshell.settings.field import Factors, Group, setting, settings_group

LOAD_CASES = ("SW", "SDL", "LL", "WX", "WY")
"""Self-weight, superimposed dead load, live load, wind along x and along y."""


@settings_group
class Loads(Group):
    """Loads of Table 2 of the paper, per square metre: the set `paper` of the column `loads`."""

    superimposed_dead: float = setting(
        0.5, unit="kN/m2", minimum=0, maximum=1000,
        meaning="SDL, on the sheet, in the direction that `sdl_direction` says.",
    )  # fmt: skip
    live: float = setting(1.0, unit="kN/m2", minimum=0, maximum=1000, meaning="LL, along -z.")
    wind: float = setting(
        1.7, unit="kN/m2", minimum=0, maximum=1000, meaning="WX and WY, along x and y."
    )
    wind_fraction: float = setting(
        0.5, minimum=0, maximum=1,
        meaning="Part of the wind that acts on the shell, all vertices alike.",
    )  # fmt: skip
    area_basis: str = setting(
        "sheet", choices=("sheet", "plan_abs"), former={"mesh": "sheet", "plan": "plan_abs"},
        meaning="Area that LL and the wind refer to: that of the sheet, or its plan projection.",
    )  # fmt: skip
    uplift: bool = setting(
        False, stages=(),
        meaning="Add the strength combinations S6 and S7, 0.9 (SW + SDL) + 1.0 WX or WY, of "
        "ASCE 7.",
    )  # fmt: skip
    sdl_direction: str = setting(
        "normal", choices=("normal", "vertical"),
        meaning="SDL against the normal of each facet, as in the paper, which on facets that "
        "overhang pushes up, or straight down.",
    )  # fmt: skip
    rows: tuple[str, ...] = setting(
        (), internal=True,
        meaning="Loads of a design with a set of its own, a text each; without them the rest.",
    )  # fmt: skip


@settings_group
class Combinations(Group):
    """Factors of the load cases (SW, SDL, LL, WX, WY of the set `paper`) in each combination."""

    rule: str = setting(
        "listed", choices=("listed", *RULES), stages=(),
        meaning="The combinations listed here, or those that a rule makes of the cases of each "
        "design's set: factors of the paper, ASCE 7, or EN 1990 with the factors of `codes`; each "
        "with wind both ways.",
    )  # fmt: skip
    strength: Factors = setting(
        {
            "S1": {"SW": 1.4, "SDL": 1.4},
            "S2": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WX": 0.5},
            "S3": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WY": 0.5},
            "S4": {"SW": 1.2, "SDL": 1.2, "LL": 1.0, "WX": 1.0},
            "S5": {"SW": 1.2, "SDL": 1.2, "LL": 1.0, "WY": 1.0},
        },
        choices=LOAD_CASES, minimum=-100, maximum=100,
        meaning="Combinations that utilization is taken from.",
    )  # fmt: skip
    deflection: Factors = setting(
        {
            "D1": {"SW": 1.0, "SDL": 1.0},
            "D2": {"SW": 1.0, "SDL": 1.0, "LL": 1.0, "WX": 1.0},
            "D3": {"SW": 1.0, "SDL": 1.0, "LL": 1.0, "WY": 1.0},
        },
        choices=LOAD_CASES, minimum=-100, maximum=100,
        meaning="Combinations that the displacement is taken from.",
    )  # fmt: skip

    @property
    def all(self) -> Factors:
        """All combinations, strength first."""
        return {**self.strength, **self.deflection}


UPLIFT = {
    "S6": {"SW": 0.9, "SDL": 0.9, "WX": 1.0},
    "S7": {"SW": 0.9, "SDL": 0.9, "WY": 1.0},
}
"""What `uplift` adds to the strength combinations."""
