"""What an exploration searches: variables with ranges, aims, limits, how it goes on."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from foldshell.settings.design import MIURA_COLUMNS, OTHER_PARAMETERS, PARAMETERS
from foldshell.settings.field import Group, Plain, setting, settings_group
from foldshell.settings.sizing import REINFORCED, Sizing
from foldshell.settings.stage import to_plain
from foldshell.settings.support_row import PlainRow

METHODS = ("gaussian_process", "sobol")
AIMS = {
    "volume_m3": 1,
    "panels": 1,
    "crease_length_m": 1,
    "displacement_vertical_max_m": 1,
    "buckling_factor_min": -1,
    "area_m2": 1,
    "engineering_volume_m3": 1,
    "steel_kg": 1,
    "co2_kg": 1,
    "cost": 1,
}
"""What a search may aim at: 1 where less is better, -1 where more is."""
ENGINEERING_AIMS = ("engineering_volume_m3", "steel_kg", "co2_kg", "cost")
"""Aims that need the engineering checks of every candidate."""
AS_SET = "as_set"
"""Stands for the measure of the study's settings."""
PAPER, ENGINEERING, BOTH = "paper", "engineering", "both"
SPAN_RATIO = "span_ratio"
"""A variable that is no column: sides of the plan, x over y."""
ALL_PARAMETERS = (*MIURA_COLUMNS, *OTHER_PARAMETERS)


@settings_group
class SearchLimits(Group):
    """What a design must keep to be chosen; those of architecture are choices, not findings."""

    plan_coverage_min: float = setting(
        0.946, minimum=0, maximum=1.1, meaning="Least share of the plan that the sheet covers."
    )
    edge_strain_max: float = setting(
        0.05, minimum=0, maximum=1, meaning="Largest strain of an edge in folding."
    )
    planarity_max: float = setting(
        1, minimum=0, maximum=10,
        meaning="Largest distance of a panel's diagonals over their length.",
    )  # fmt: skip
    depth_min_m: float = setting(
        0, minimum=0, maximum=100, meaning="Least depth of the folds in the rest state, m."
    )
    depth_max_m: float = setting(
        100, above=0, maximum=100, meaning="Largest depth of the folds in the rest state, m."
    )
    buckling_factor_min: float = setting(
        4, minimum=0, maximum=100, meaning="Least buckling factor of the final state."
    )
    verdicts: str = setting(
        PAPER, choices=(PAPER, ENGINEERING, BOTH),
        meaning="Verdicts that have to hold: that of the paper's criteria, the engineering one "
        "(which costs its analyses for each design), or both.",
    )  # fmt: skip


@settings_group
class Search(Group):
    """How designs are proposed and confirmed."""

    method: str = setting(
        "gaussian_process", choices=METHODS,
        meaning="A model of what was found proposes (Gaussian process with expected improvement), "
        "or an even spread goes on (Sobol).",
    )  # fmt: skip
    seed: int = setting(1, minimum=1, maximum=1_000_000, meaning="Seed of all chance.")
    first: int = setting(
        20, unit="designs", minimum=2, maximum=500, meaning="Designs of the even spread, round 1."
    )
    rounds: int = setting(
        10, minimum=0, maximum=99, meaning="Rounds after it, each with `batch` designs."
    )
    batch: int = setting(
        4, unit="designs", minimum=1, maximum=50, meaning="Designs proposed at once."
    )
    screened: int = setting(
        8, unit="designs", minimum=0, maximum=200,
        meaning="Designs of each round that are folded and analysed once, as a cheap answer, "
        "before `batch` of them are sized. 0: none.",
    )  # fmt: skip
    subdivisions: int = setting(
        2, minimum=1, maximum=8, meaning="Subdivisions of a facet edge in the search."
    )
    confirmed: int = setting(
        3, unit="designs", minimum=0, maximum=50,
        meaning="Best designs that the ordinary rules size and check anew, on their own mesh.",
    )  # fmt: skip
    rule: str = setting(
        "dead_band", choices=("dead_band", "optimality", "filtered_dead_band"),
        meaning="Sizing rule of search and confirmation.",
    )  # fmt: skip
    measure: str = setting(
        AS_SET, choices=(AS_SET, "panel_mean", "element_max", "strip", REINFORCED),
        meaning="What sizing.measure is in search and confirmation; as_set takes that of the "
        "study's settings. reinforced sizes concrete and steel (aim engineering_volume_m3).",
    )  # fmt: skip
    slopes: int = setting(
        1, unit="designs", minimum=0, maximum=20,
        meaning="Best designs whose slopes dV/dx are computed; multipliers are exact for the rule "
        "optimality alone, the residual says how far they are from it.",
    )  # fmt: skip
    gradient_step: bool = setting(
        False,
        meaning="The last design of each batch goes from the best so far down its slopes; it "
        "counts like any other, so it stays only where it helps.",
    )


@settings_group
class DerivedColumns(Group):
    """Variables that are no columns, but set some."""

    span_ratio: float = setting(
        1, minimum=0.2, maximum=5,
        meaning="Side of the plan along x over that along y, at the plan area of span_m squared.",
    )  # fmt: skip


@dataclass(frozen=True)
class Variable:
    """One variable: a column of the table of designs with its range, or with its choices."""

    name: str
    low: float = 0.0
    high: float = 1.0
    whole: bool = False
    choices: tuple[str, ...] = ()

    def to_value(self, share: float) -> float | int | str:
        """Return the value at a share from 0 to 1 of the range."""
        if self.choices:
            return self.choices[min(int(share * len(self.choices)), len(self.choices) - 1)]
        if self.whole:
            count = int(self.high) - int(self.low) + 1
            return int(self.low) + min(int(share * count), count - 1)
        return float(f"{self.low + share * (self.high - self.low):.6g}")

    def to_share(self, value: object) -> float:
        """Return the share of a value, in the middle of its part for wholes and choices."""
        if self.choices:
            return (self.choices.index(str(value)) + 0.5) / len(self.choices)
        if self.whole:
            return (float(value) - self.low + 0.5) / (self.high - self.low + 1)
        return (float(value) - self.low) / (self.high - self.low)


@dataclass(frozen=True)
class Exploration:
    """An exploration: its name, the columns of the base design, variables, aims, limits, search,
    the rows of the sets of supports that it names."""

    name: str
    base: Plain
    variables: tuple[Variable, ...]
    aims: tuple[str, ...]
    limits: SearchLimits
    search: Search
    supports: Mapping[str, list[PlainRow]] = field(default_factory=dict)

    @property
    def needs_engineering(self) -> bool:
        """Whether each candidate is judged by the engineering checks."""
        asked = bool(set(self.aims) & set(ENGINEERING_AIMS))
        return asked or self.limits.verdicts != PAPER

    @property
    def columns(self) -> list[str]:
        """The columns that vary, after the one that the designs of round 0 differ in."""
        return ["pattern", *(v.name for v in self.variables if v.name != "pattern")]

    @property
    def evaluations(self) -> int:
        """Number of designs that are sized."""
        return self.search.first + self.search.rounds * self.search.batch

    def count_batch(self, number: int) -> int:
        """Return the number of designs of a round, from 1."""
        return self.search.first if number == 1 else self.search.batch

    def to_plain(self) -> Plain:
        """Return all of it as plain data, as Snakemake's `params` hold it."""
        variables = [
            [v.name, v.low, v.high, v.whole, list(v.choices)] for v in self.variables
        ]  # fmt: skip
        return {
            "name": self.name, "base": dict(self.base), "variables": variables,
            "aims": list(self.aims), "limits": to_plain(self.limits),
            "search": to_plain(self.search), "supports": dict(self.supports),
        }  # fmt: skip

    def make_row(self, name: str, values: Mapping[str, object]) -> Plain:
        """Return a row of the table of designs: the base with the given columns; parameters that
        its pattern does not have are 0."""
        row = {"design": name, **self.base, **values}
        has = PARAMETERS.get(str(row["pattern"]), ()) if "pattern" in row else ALL_PARAMETERS
        row |= {key: 0.0 for key in ALL_PARAMETERS if key in row and key not in has}
        if SPAN_RATIO in row:
            side, root = float(row["span_m"]), math.sqrt(float(row.pop(SPAN_RATIO)))
            x, y = (float(f"{one:.6g}") for one in (side * root, side / root))
            row |= {"span_m": min(x, y), "span_x_m": x, "span_y_m": y}
        return row


def restore_exploration(plain: Plain) -> Exploration:
    """Return the exploration of such plain data."""
    return Exploration(
        plain["name"],
        dict(plain["base"]),
        tuple(Variable(*rest, tuple(choices)) for *rest, choices in plain["variables"]),
        tuple(plain["aims"]),
        SearchLimits(**plain["limits"]),
        Search(**plain["search"]),
        dict(plain["supports"]),
    )


def list_sizing(exploration: Exploration, sizing: Sizing) -> Plain:
    """Return the settings of the group sizing that are those of a search: rule, measure, and the
    buckling factor that it keeps."""
    search, factor = exploration.search, exploration.limits.buckling_factor_min
    return {
        "rule": search.rule,
        "measure": sizing.measure if search.measure == AS_SET else search.measure,
        "thinning_buckling_factor_min": max(sizing.thinning_buckling_factor_min, factor),
    }
