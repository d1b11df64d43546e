"""What comparison.json holds: one class a kind of record, each field with its unit and meaning."""

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields
from typing import Annotated, Any, get_type_hints

MULTIFRONTAL, SCIPY = "multifrontal", "scipy"
"""How this code solves: the fast path, and the plain one."""


@dataclass(frozen=True)
class Said:
    """What a field means, in which unit; `name` is its key in the file where it differs."""

    meaning: str
    unit: str = ""
    name: str = ""


Passed = Said("whether the difference is within its tolerance", name="pass")
OF_UNIT = "that of `unit`"


@dataclass(frozen=True)
class Quantity:
    """One quantity of one combination by both codes, each on its finest mesh."""

    primary: Annotated[float, Said("value of the primary code", OF_UNIT)]
    independent: Annotated[float, Said("value of the independent code", OF_UNIT)]
    relative_difference: Annotated[float, Said("between them, or the larger imbalance", "-")]
    tolerance: Annotated[float, Said("largest relative difference allowed", "-")]
    passed: Annotated[bool, Passed]
    unit: Annotated[str, Said("of both values: m, kN, kNm or -")]


@dataclass(frozen=True)
class Limit(Quantity):
    """A quantity on the meshes of each code: `primary` and `independent` are their limits."""

    primary_meshes: Annotated[list[float], Said("value of each mesh, coarse to fine", OF_UNIT)]
    primary_order: Annotated[float | None, Said("of the extrapolation; null: finest mesh", "-")]
    primary_mesh_error: Annotated[float, Said("finest mesh against the limit, relative", "-")]
    independent_meshes: Annotated[list[float], Said("value of each mesh, coarse to fine", OF_UNIT)]
    independent_order: Annotated[float | None, Said("of the extrapolation; null: finest mesh", "-")]
    independent_mesh_error: Annotated[float, Said("finest mesh against the limit, relative", "-")]


@dataclass(frozen=True)
class SupportReaction:
    """The reaction of one support in one combination by both codes, extrapolated."""

    primary_kn: Annotated[list[float], Said("along x, y, z, primary code", "kN")]
    independent_kn: Annotated[list[float], Said("along x, y, z, independent code", "kN")]
    primary_thrust_kn: Annotated[float, Said("horizontal, at right angles to the edge", "kN")]
    independent_thrust_kn: Annotated[float, Said("the same by the independent code", "kN")]
    relative_difference: Annotated[
        float, Said("length of the difference over the largest resultant of all supports", "-")
    ]
    tolerance: Annotated[float, Said("largest relative difference allowed", "-")]
    passed: Annotated[bool, Passed]


@dataclass(frozen=True)
class ShearShare:
    """What shear deformation adds to a value that a criterion limits, by the independent code."""

    combination: Annotated[str, Said("that governs the criterion")]
    share: Annotated[float, Said("relative increase of the value, of first order", "-")]
    share_meshes: Annotated[list[float], Said("the same on each mesh, coarse to fine", "-")]
    value: Annotated[float, Said("primary code, mesh in use, without shear", "m or -")]
    limit: Annotated[float, Said("what the criterion allows", "m or -")]
    with_shear: Annotated[float, Said("value times (1 + share)", "m or -")]
    refined_with_shear: Annotated[float, Said("extrapolated value times (1 + share)", "m or -")]
    turns: Annotated[bool, Said("whether shear alone turns the verdict")]
    turns_refined: Annotated[bool, Said("whether shear and mesh error together turn it")]


@dataclass(frozen=True)
class ReinforcementComparison:
    """Steel that each code designs by its own forces; beside `pass`, which it does not decide."""

    combinations: Annotated[list[str], Said("strength combinations that it is designed for")]
    passed: Annotated[bool, Said("whether kg/m2 and largest steel are within 10 %", name="pass")]
    quantities: Annotated[
        dict[str, Limit],
        Said("steel, largest moment and shear; finest meshes, not extrapolated"),
    ]
    reason: Annotated[str | None, Said("why not; else left out")] = None


Subdivisions = Said("elements along a block's side, each mesh", "elements")
ByName = Said("by `<combination> <quantity>`, `<combination> Th.II <quantity>` to second order")
BySupport = Said("by `<combination> <support>`, `<combination> Th.II <support>` to second order")
NotSettled = Said("quantities whose iteration the independent code ended early: no number")


@dataclass(frozen=True)
class FirstComparison:
    """What a first comparison found, where one on finer meshes replaced it."""

    independent_subdivisions: Annotated[list[int], Subdivisions]
    quantities: Annotated[dict[str, Quantity], ByName]
    reactions: Annotated[dict[str, SupportReaction], BySupport]
    not_settled: Annotated[list[str], NotSettled]


@dataclass(frozen=True)
class Comparison:
    """Both codes on the final state of a design, quantity by quantity."""

    passed: Annotated[bool | None, Said("null: nothing to compare, see `reason`", name="pass")]
    quantities: Annotated[dict[str, Quantity], ByName]
    reactions: Annotated[dict[str, SupportReaction], BySupport]
    not_compared: Annotated[list[str], Said("quantities that one code alone gives")]
    not_settled: Annotated[list[str], NotSettled]
    primary_subdivisions: Annotated[list[float], Said("parts of a facet's side, each mesh")]
    independent_subdivisions: Annotated[list[int], Subdivisions]
    solver: Annotated[str, Said("of the independent code: multifrontal or scipy")]
    governing: Annotated[
        dict[str, str],
        Said("compared combination that governs displacement, utilization, buckling"),
    ] = field(default_factory=dict)
    shear: Annotated[dict[str, ShearShare], Said("by the name of the limited quantity")] = field(
        default_factory=dict
    )
    reason: Annotated[str | None, Said("why nothing is compared; else left out")] = None
    first: Annotated[FirstComparison | None, Said("of two comparisons; else left out")] = None
    reinforcement: Annotated[
        ReinforcementComparison | None, Said("where steel is designed; else left out")
    ] = None


def list_fields(record: type) -> Iterator[tuple[str, Any, Said]]:
    """Yield (attribute, type, what is said of it) of the fields of a record class."""
    hints = get_type_hints(record, include_extras=True)
    for one in fields(record):
        kind, said = hints[one.name].__origin__, hints[one.name].__metadata__[0]
        yield one.name, kind, said


def to_data(value: Any) -> Any:
    """Plain data of a record under the names of the file, without what holds its default."""
    if hasattr(value, "__dataclass_fields__"):
        default = {one.name: one.default for one in fields(value)}
        return {
            said.name or name: to_data(getattr(value, name))
            for name, _, said in list_fields(type(value))
            if default[name] is MISSING or getattr(value, name) != default[name]
        }
    if isinstance(value, Mapping):
        return {name: to_data(held) for name, held in value.items()}
    return value
