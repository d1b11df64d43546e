"""What an exploration searches: a file of its own, read strictly."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.settings.check import Reader
from foldshell.settings.config_file import read_config
from foldshell.settings.design import Design, DesignColumns
from foldshell.settings.field import Group, Plain, Setting, list_settings, setting, settings_group
from foldshell.settings.nearest import hint_nearest
from foldshell.settings.stage import to_plain

NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,63}")
METHODS = ("gaussian_process", "sobol")
AIMS = {
    "volume_m3": 1,
    "panels": 1,
    "crease_length_m": 1,
    "displacement_vertical_max_m": 1,
    "buckling_factor_min": -1,
    "area_m2": 1,
}
"""What a search may aim at: 1 where less is better, -1 where more is."""
VARIABLES_MAX = 12


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
    """An exploration: its name, the columns of the base design, variables, aims, limits, search."""

    name: str
    base: Plain
    variables: tuple[Variable, ...]
    aims: tuple[str, ...]
    limits: SearchLimits
    search: Search

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
            "search": to_plain(self.search),
        }  # fmt: skip

    def make_row(self, name: str, values: Mapping[str, object]) -> Plain:
        """Return a row of the table of designs: the base with the given columns."""
        return {"design": name, **self.base, **values}


def read_exploration(path: str | Path, defaults: DesignColumns) -> Exploration:
    """Read and check a file of an exploration; its name is that of the file.

    Raises
    ------
    InputError
        for anything that is not as config/explorations/README.md says.
    """
    path = Path(path)
    if not NAME.fullmatch(path.stem):
        raise InputError(
            f"{path}: a name of lower-case letters, digits, - and _ is due, as for designs"
        )
    data = read_config(path)
    known = {"base", "variables", "aims", "limits", "search"}
    for key in data:
        if key not in known:
            hint = hint_nearest(str(key), known) or f", allowed are {', '.join(sorted(known))}"
            raise InputError(f"{path}: {key}: unknown key{hint}")
    reader = Reader(str(path))
    base = _read_base(reader, data.get("base", {}))
    variables = _read_variables(reader, data.get("variables"))
    return Exploration(
        path.stem,
        _complete(base, defaults),
        variables,
        _read_aims(reader, data.get("aims", ["volume_m3"])),
        reader.read_group(SearchLimits, data.get("limits", {}), "limits"),
        reader.read_group(Search, data.get("search", {}), "search"),
    )


def restore_exploration(plain: Plain) -> Exploration:
    """Return the exploration of such plain data."""
    return Exploration(
        plain["name"],
        dict(plain["base"]),
        tuple(Variable(*rest, tuple(choices)) for *rest, choices in plain["variables"]),
        tuple(plain["aims"]),
        SearchLimits(**plain["limits"]),
        Search(**plain["search"]),
    )


def _complete(base: Plain, defaults: DesignColumns) -> Plain:
    row = Design(name="base", **(vars(defaults))).to_row()
    return {key: row[key] for key in row if key not in ("design", "tags")} | base


def _columns() -> dict[str, Setting]:
    return {known.key: known for known in list_settings(DesignColumns).values()}


def _find_column(reader: Reader, name: str, place: str) -> Setting:
    columns = _columns()
    if name not in columns:
        hint = hint_nearest(name, columns) or f", columns are {', '.join(columns)}"
        raise InputError(f"{reader.source}: {place}.{name}: unknown column of designs{hint}")
    return columns[name]


def _read_base(reader: Reader, data: object) -> Plain:
    if not isinstance(data, Mapping):
        raise reader.refuse("base", data, "a group of columns with values")
    return {
        name: reader.read_value(_find_column(reader, str(name), "base"), value, f"base.{name}")
        for name, value in data.items()
    }


def _read_variables(reader: Reader, data: object) -> tuple[Variable, ...]:
    if not isinstance(data, Mapping) or not 1 <= len(data) <= VARIABLES_MAX:
        raise reader.refuse(
            "variables", data, f"1 to {VARIABLES_MAX} columns of designs, each with [least, most]"
        )
    return tuple(_read_variable(reader, str(name), value) for name, value in data.items())


def _read_variable(reader: Reader, name: str, value: object) -> Variable:
    place = f"variables.{name}"
    known = _find_column(reader, name, "variables")
    if not isinstance(value, list) or len(value) < 2:
        raise reader.refuse(place, value, "a list of [least, most], or of words to choose from,")
    given = [reader.read_value(known, item, place) for item in value]
    if known.kind is str:
        if len(set(given)) < len(given):
            raise reader.refuse(place, value, "a list of words, each once,")
        return Variable(name, choices=tuple(given))
    if len(given) != 2 or not float(given[0]) < float(given[1]):
        raise reader.refuse(place, value, "a list of [least, most], the least first,")
    if any(not math.isfinite(float(item)) for item in given):
        raise reader.refuse(place, value, "a list of two finite numbers")
    return Variable(name, float(given[0]), float(given[1]), known.kind is int)


def _read_aims(reader: Reader, data: object) -> tuple[str, ...]:
    words = ", ".join(AIMS)
    if not isinstance(data, list) or len(data) not in (1, 2) or data[1:] == data[:1]:
        raise reader.refuse("aims", data, f"a list of one or two of {words}")
    for aim in data:
        if aim not in AIMS:
            hint = hint_nearest(str(aim), AIMS) or f", allowed are {words}"
            raise InputError(f"{reader.source}: aims: {aim!r}: no design has this value{hint}")
    return tuple(data)
