"""Material, load cases and combinations in words, for pages and calculation sheets."""

from collections.abc import Sequence
from dataclasses import dataclass

from foldshell.loads.cases import DOWN, GLOBAL_X, GLOBAL_Y, WEIGHT, SurfaceLoad, make_load_cases
from foldshell.records.entry import SIGNS
from foldshell.report.markup import Table, format_number, make_table
from foldshell.settings.field import list_settings
from foldshell.settings.loads import Combinations
from foldshell.settings.material import Material
from foldshell.settings.stage import StageSettings

DIRECTIONS = {
    None: ("against the normal of each facet", "normal"),
    DOWN: ("down", "down"),
    GLOBAL_X: ("along x", "x"),
    GLOBAL_Y: ("along y", "y"),
}
"""Directions of load cases in words, and how their arrows point in a sketch."""


WORDS = {"youngs_modulus": "Young's modulus", "poissons_ratio": "Poisson's ratio"}


@dataclass(frozen=True)
class LoadCase:
    """A load case: its name, what it is, its size, and how its arrows point in a sketch: down,
    normal, along x or along y."""

    name: str
    words: str
    size: str
    arrows: str


@dataclass(frozen=True)
class LoadsText:
    """What stands about material, loads and combinations."""

    cases: tuple[LoadCase, ...]
    combinations: Table
    material: Table


def describe_loads(settings: StageSettings) -> LoadsText:
    """Return load cases, combinations and material of the settings of stage `size`."""
    cases = make_load_cases(settings.loads, settings.material.unit_weight)
    return LoadsText(
        tuple(_describe_case(case) for case in cases),
        _list_combinations(settings.combinations, cases),
        _list_material(settings.material),
    )


def _describe_case(case: SurfaceLoad) -> LoadCase:
    words, arrows = DIRECTIONS.get(case.direction, (f"along {case.direction}", "down"))
    basis = "of sheet" if case.area == "sheet" else "of plan"
    size = f"{case.value:g} kN/m² {basis}"
    if case.kind == WEIGHT:
        size = f"{case.value:g} kN/m³ x thickness"
    return LoadCase(case.case, f"{case.words} {words}", size, arrows)


def _list_combinations(combinations: Combinations, cases: Sequence[SurfaceLoad]) -> Table:
    names = [case.case for case in cases]
    rows = [
        (name, kind, *(factors.get(case) for case in names))
        for kind in ("strength", "deflection")
        for name, factors in getattr(combinations, kind).items()
    ]
    return make_table(["combination", "of", *names], rows)


def _list_material(material: Material) -> Table:
    rows = []
    for name, about in list_settings(Material).items():
        value = getattr(material, name)
        if isinstance(value, float | int):
            value = format_number(value / about.convert(1.0))
        unit = f" [{SIGNS.get(about.unit, about.unit)}]" if about.unit else ""
        words = WORDS.get(name, name.replace("_", " "))
        rows.append((f"{words}{unit}", str(value).replace("_", " ")))
    return make_table(("property", "value"), rows)
