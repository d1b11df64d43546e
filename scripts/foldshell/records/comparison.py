"""comparison.json: both codes side by side, as the independent code writes it and ours reads it."""

from dataclasses import dataclass
from pathlib import Path

from foldshell.records.entry import COUNT, entry
from foldshell.records.files import read_record

Force = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class ComparedQuantity:
    """One quantity of one combination; mesh values go from coarse to fine."""

    primary: float = entry("value of the primary code, in `unit`")
    independent: float = entry("value of the independent code, in `unit`")
    relative_difference: float = entry(
        "difference over the larger of both; of the balance of reactions the larger defect", "-"
    )
    tolerance: float = entry("largest relative difference allowed", "-")
    passed: bool = entry("whether the difference is within the tolerance", key="pass")
    unit: str = entry("unit of the values")
    primary_meshes: tuple[float, ...] | None = entry(
        "values of the primary code on its meshes, in `unit`", left_out=True
    )
    primary_order: float | None = entry(
        "order that they were extrapolated with; null where the finest mesh stands", "-",
        default=None,
    )  # fmt: skip
    primary_mesh_error: float | None = entry(
        "relative difference of the finest mesh from the limit", "-", left_out=True
    )
    independent_meshes: tuple[float, ...] | None = entry(
        "values of the independent code on its meshes, in `unit`", left_out=True
    )
    independent_order: float | None = entry(
        "order that they were extrapolated with; null where the finest mesh stands", "-",
        default=None,
    )  # fmt: skip
    independent_mesh_error: float | None = entry(
        "relative difference of the finest mesh from the limit", "-", left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class SupportReaction:
    """The reaction of one supported edge in one combination, extrapolated by each code."""

    primary_kn: Force = entry("of the primary code along x, y, z", "kN")
    independent_kn: Force = entry("of the independent code along x, y, z", "kN")
    primary_thrust_kn: float = entry(
        "horizontal part at right angles to the edge, inward positive, primary code", "kN"
    )
    independent_thrust_kn: float = entry("the same by the independent code", "kN")
    relative_difference: float = entry(
        "length of the difference of forces over the largest force on any edge", "-"
    )
    tolerance: float = entry("largest relative difference allowed", "-")
    passed: bool = entry("whether the difference is within the tolerance", key="pass")


@dataclass(frozen=True, kw_only=True)
class ShearShare:
    """What shear deformation adds to a value that a criterion limits, by the independent code."""

    combination: str = entry("the combination that governs the criterion")
    share: float = entry("relative increase of the value, of first order", "-")
    share_meshes: tuple[float, ...] = entry("the same on each mesh, coarse to fine", "-")
    value: float = entry("value of the primary code on the mesh in use, m or -")
    limit: float = entry("what the criterion allows, m or -")
    with_shear: float = entry("value times (1 + share), m or -")
    refined_with_shear: float = entry("extrapolated value times (1 + share), m or -")
    turns: bool = entry("whether shear alone turns the verdict")
    turns_refined: bool = entry("whether shear and mesh error together turn it")


@dataclass(frozen=True, kw_only=True)
class FirstComparison:
    """What a comparison found before the meshes were refined."""

    independent_subdivisions: tuple[int, ...] = entry("elements along a block side", COUNT)
    quantities: dict[str, ComparedQuantity] = entry("quantities by combination and key")
    reactions: dict[str, SupportReaction] | None = entry(
        "reactions by combination and supported edge", left_out=True
    )
    not_settled: tuple[str, ...] = entry("quantities whose iteration ended before it settled")


@dataclass(frozen=True, kw_only=True)
class ReinforcementComparison:
    """Steel that each code designs by its own forces, for the same strength combinations."""

    combinations: tuple[str, ...] = entry("strength combinations that it is designed for")
    passed: bool = entry("whether kg/m2 and largest steel are within 10 %", key="pass")
    quantities: dict[str, ComparedQuantity] = entry(
        "steel_kg_m2 (no least steel), steel_max_kn_m (one layer and direction), moment_max_knm_m "
        "and shear_max_kn_m (largest means of facets and strips), finest meshes, first order"
    )
    reason: str | None = entry("why a difference is larger", left_out=True)


@dataclass(frozen=True, kw_only=True)
class ComparisonRecord:
    """The contents of comparison.json."""

    design: str = entry("name of the design")
    passed: bool | None = entry(
        "whether every quantity is within its tolerance; null where there is nothing to compare",
        key="pass",
    )
    reason: str | None = entry("why there is nothing to compare", left_out=True)
    quantities: dict[str, ComparedQuantity] = entry("quantities by combination and key")
    reactions: dict[str, SupportReaction] | None = entry(
        "reactions by combination and supported edge", left_out=True
    )
    governing: dict[str, str] | None = entry(
        "compared combination that governs displacement, utilization and buckling", left_out=True
    )
    shear: dict[str, ShearShare] | None = entry(
        "share of shear deformation by the limited quantity", left_out=True
    )
    not_compared: tuple[str, ...] = entry("what only one code gives")
    not_settled: tuple[str, ...] = entry("quantities whose iteration ended before it settled")
    primary_subdivisions: tuple[float, ...] = entry(
        "parts of a facet's side on each mesh of the primary code", COUNT
    )
    independent_subdivisions: tuple[int, ...] = entry(
        "elements along a block's side on each mesh of the independent code", COUNT
    )
    solver: str = entry("path of the independent code: multifrontal or scipy")
    first: FirstComparison | None = entry(
        "the first comparison, where a second one on finer meshes stands", left_out=True
    )
    reinforcement: ReinforcementComparison | None = entry(
        "steel by both codes; beside `pass`, which it does not decide", left_out=True
    )

    @property
    def outcome(self) -> str | None:
        """pass or fail, `not possible` for a mechanism."""
        if self.passed is None:
            return "not possible"
        return "pass" if self.passed else "fail"


def read_comparison(path: str | Path) -> ComparisonRecord:
    """Read comparison.json; keys that the independent code adds are left alone.

    Raises `InputError` for a damaged file.
    """
    return read_record(path, ComparisonRecord, closed=False)
