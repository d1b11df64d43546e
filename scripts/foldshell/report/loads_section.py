"""Material, load cases and combinations in words, for pages and calculation sheets."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from foldshell.report.markup import Table, format_number, make_table


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


def describe_loads(settings: Mapping[str, Any]) -> LoadsText:
    """Return load cases, combinations and material of plain settings (kN, m, kPa)."""
    loads, material = settings["loads"], settings["material"]
    basis = "of sheet" if loads["area_basis"] == "mesh" else "of plan"
    wind = loads["wind"] * loads["wind_fraction"]
    size = f"{wind:g} kN/m² {basis} ({loads['wind']:g} x {loads['wind_fraction']:g})"
    cases = (
        LoadCase("SW", "self-weight, down",
                 f"{material['unit_weight']:g} kN/m³ x thickness", "down"),
        LoadCase("SDL", "superimposed dead load, against the normal of each facet",
                 f"{loads['superimposed_dead']:g} kN/m² of sheet", "normal"),
        LoadCase("LL", "live load, down", f"{loads['live']:g} kN/m² {basis}", "down"),
        LoadCase("WX", "wind along x", size, "x"),
        LoadCase("WY", "wind along y", size, "y"),
    )  # fmt: skip
    names = [case.name for case in cases]
    rows = [
        (name, group, *(factors.get(case) for case in names))
        for group, combinations in settings["combinations"].items()
        for name, factors in combinations.items()
    ]
    return LoadsText(cases, make_table(["combination", "of", *names], rows), _material(material))


def _material(material: Mapping[str, Any]) -> Table:
    strength = {"strength": "compressive strength [MPa]",
                "strength_tension": "tensile strength [MPa]"}  # fmt: skip
    rows = [
        ("material", material["name"]),
        ("Young's modulus [GPa]", format_number(material["youngs_modulus"] / 1e6)),
        ("Poisson's ratio [-]", format_number(material["poissons_ratio"])),
        ("unit weight [kN/m³]", format_number(material["unit_weight"])),
        *((words, format_number(material[key] / 1e3)) for key, words in strength.items()
          if material.get(key) is not None),
        ("strength criterion", str(material.get("criterion", "")).replace("_", " ")),
    ]  # fmt: skip
    return make_table(("property", "value"), rows)
