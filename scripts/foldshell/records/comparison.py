"""comparison.json: both codes side by side, as the independent code writes it and ours reads it."""

from dataclasses import dataclass
from pathlib import Path

from foldshell.records.entry import COUNT, entry
from foldshell.records.files import read_record


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
class FirstComparison:
    """What a comparison found before the meshes were refined."""

    independent_subdivisions: tuple[int, ...] = entry("elements along a block side", COUNT)
    quantities: dict[str, ComparedQuantity] = entry("quantities by combination and key")
    not_settled: tuple[str, ...] = entry("quantities whose iteration ended before it settled")


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
