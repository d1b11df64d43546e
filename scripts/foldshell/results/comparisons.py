"""Which charts over the designs of a study compare anything, told from the table of designs."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

from foldshell.settings import design as design_table
from foldshell.settings.design import SUPPORTS, SURFACES

UNFOLDED = ("smooth", "flat")


class Layout(Protocol):
    """What a chart sorts designs by."""

    tags: Sequence[str]
    pattern: str
    surface: str
    support: str
    span_height: str
    density: str


Design = TypeVar("Design", bound=Layout)


@dataclass(frozen=True)
class TableDesign:
    """A row of designs.tsv as charts sort it."""

    tags: tuple[str, ...]
    pattern: str
    surface: str
    support: str
    span_height: str
    density: str


@dataclass(frozen=True)
class Comparison:
    """Which designs a figure compares: a column of charts for each value of `column`, a line or
    bar for each value of `series`."""

    title: str
    tag: str
    column: Callable[[Layout], str]
    series: Callable[[Layout], str]
    chosen: Callable[[Layout], bool] = lambda design: True


COMPARISONS: dict[str, Comparison] = {
    "supports": Comparison("Supported edges", "supports", lambda d: d.surface, lambda d: d.support),
    "surface": Comparison(
        "Surfaces", "supports", lambda d: f"{d.support} edges supported", lambda d: d.surface
    ),
    "curvature": Comparison(
        "Span / height [m]",
        "curvature",
        lambda d: f"{d.surface}, {d.support} edges supported",
        lambda d: d.span_height,
    ),
    "density_zigzag": Comparison(
        "Zig-zags x strips, zig-zag edges supported",
        "density",
        lambda d: d.surface,
        lambda d: d.density,
        lambda d: d.support == "zigzag",
    ),
    "density_strip": Comparison(
        "Zig-zags x strips, strip edges supported",
        "density",
        lambda d: d.surface,
        lambda d: d.density,
        lambda d: d.support == "strip",
    ),
}


def make_table_design(design: design_table.Design) -> TableDesign:
    """Return a design of the table as charts sort it."""
    size = f"{design.span:g}/{design.height:g}"
    density = f"{design.zigzag}x{design.strip}"
    kind = design.pattern, design.surface, design.support
    return TableDesign(design.tags, *kind, size, density)


def sort_into_columns(
    designs: Iterable[Design], comparison: Comparison
) -> dict[str, dict[str, Design]]:
    """Return {column: {series: design}} of the designs of a comparison.

    Surfaces and supports keep the order of the paper, other series that of the summary. A column
    with one design compares nothing and is left out.
    """
    chosen = [d for d in designs if comparison.tag in d.tags and comparison.chosen(d)]
    chosen.sort(key=lambda d: (_place(d.surface, SURFACES), _place(d.support, SUPPORTS)))
    columns: dict[str, dict[str, Design]] = {}
    for design in chosen:
        columns.setdefault(comparison.column(design), {})[comparison.series(design)] = design
    return {name: members for name, members in columns.items() if len(members) > 1}


def pair_supports(designs: Sequence[Design]) -> list[tuple[Design, Design]]:
    """Return pairs that differ only in being supported on zig-zag or on strip edges (Fig. 8)."""
    key = {
        (d.pattern, d.surface, d.span_height, d.density, d.support): d
        for d in designs
        if "density" in d.tags
    }
    pairs = [
        (design, key[(*rest, "strip")])
        for (*rest, support), design in key.items()
        if support == "zigzag" and (*rest, "strip") in key
    ]
    return sorted(pairs, key=lambda pair: _place(pair[0].surface, SURFACES))


def choose_panel_surfaces(designs: Iterable[Layout]) -> list[str]:
    """Return the surfaces of folded designs, those of the paper first."""
    found = {d.surface for d in designs if d.pattern not in UNFOLDED}
    return sorted(found, key=lambda name: (_place(name, SURFACES), name))


def explain_left_out(table: Iterable[design_table.Design]) -> dict[str, str]:
    """Return the charts that designs of the table give nothing to compare for, and why."""
    designs = [make_table_design(one) for one in table]
    reasons = {
        name: _explain(designs, comparison.tag)
        for name, comparison in COMPARISONS.items()
        if not sort_into_columns(designs, comparison)
    }
    if not pair_supports(designs):
        reasons["axes"] = "no two designs tagged density differ in their supported edges alone"
    if not choose_panel_surfaces(designs):
        reasons["planarity_utilization"] = "no folded design"
    return reasons


def _explain(designs: Sequence[Design], tag: str) -> str:
    """Return why designs make no chart of a tag: too few have it, or none fits beside another."""
    count = sum(tag in design.tags for design in designs)
    if count < 2:
        return f"no two designs tagged {tag} to compare"
    return f"of the {count} designs tagged {tag} no two can be compared in one group of this chart"


def _place(value: str, order: Sequence[str]) -> int:
    return order.index(value) if value in order else len(order)
