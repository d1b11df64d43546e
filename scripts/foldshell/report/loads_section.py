"""Material, load cases and combinations in words, for pages and calculation sheets."""

from collections.abc import Sequence
from dataclasses import dataclass

from foldshell.loads.cases import WEIGHT, SurfaceLoad, group_cases, make_load_cases
from foldshell.loads.words import DIRECTIONS, describe_direction, describe_load, unit_of
from foldshell.records.entry import SIGNS
from foldshell.report.markup import Table, format_number, make_table
from foldshell.settings.field import list_settings
from foldshell.settings.loads import Combinations
from foldshell.settings.material import Material
from foldshell.settings.stage import StageSettings

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
        tuple(_describe_case(own) for own in group_cases(cases).values()),
        _list_combinations(settings.combinations, list(group_cases(cases))),
        _list_material(settings.material),
    )


def _describe_case(loads: Sequence[SurfaceLoad]) -> LoadCase:
    """Return a case of one load in the words of the paper, of others load by load."""
    one = loads[0]
    arrows = DIRECTIONS.get(one.direction, ("", "down"))[1]
    if len(loads) > 1 or not one.is_uniform:
        words = "; ".join(describe_load(own).partition(": ")[2] for own in loads)
        sizes = "; ".join(f"{own.value:g} {SIGNS.get(unit_of(own), unit_of(own))}" for own in loads)
        return LoadCase(one.case, words, sizes, arrows)
    size = f"{one.value:g} kN/m² {'of sheet' if one.area == 'sheet' else 'of plan'}"
    if one.kind == WEIGHT:
        size = f"{one.value:g} kN/m³ x thickness"
    return LoadCase(one.case, f"{one.words} {describe_direction(one)}", size, arrows)


def _list_combinations(combinations: Combinations, names: Sequence[str]) -> Table:
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
