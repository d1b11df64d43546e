"""The material of a shell; stresses in kPa."""

from dataclasses import replace

from foldshell.settings.field import Group, setting, settings_group


@settings_group
class Material(Group):
    """Material of the shell; the default is the paper's concrete."""

    name: str = setting("C25/30", longest=60, meaning="Name in tables and workbooks.")
    youngs_modulus: float = setting(
        31, unit="GPa", above=0, maximum=1000, meaning="Young's modulus."
    )
    poissons_ratio: float = setting(0.2, above=-1, below=0.5, meaning="Poisson's ratio.")
    unit_weight: float = setting(
        25, unit="kN/m3", above=0, maximum=250, meaning="Weight of a unit volume."
    )
    strength: float = setting(
        16.7, unit="MPa", above=0, maximum=10000,
        meaning="Strength in compression, and the only strength of the von Mises criterion.",
    )  # fmt: skip
    strength_tension: float = setting(
        1.67, unit="MPa", above=0, maximum=10000,
        meaning="Strength in tension, which the criteria of Rankine and of Drucker and Prager use.",
    )  # fmt: skip
    kind: str = setting(
        "concrete", choices=("concrete", "steel", "user"), stages=("size", "study", "crosscheck"),
        meaning="Which engineering checks hold: of concrete (without steel, tension is limited by "
        "strength_tension), of steel (von Mises), or of a material with the criterion below.",
    )  # fmt: skip
    criterion: str = setting(
        "von_mises", choices=("von_mises", "rankine", "drucker_prager"),
        meaning="Stress that is compared with the strength.",
    )  # fmt: skip
    thermal_expansion: float = setting(
        1e-5, unit="1/K", minimum=0, maximum=1e-3,
        meaning="Expansion by temperature, for loads of that kind.",
    )  # fmt: skip


def age_material(material: Material, creep_coefficient: float) -> Material:
    """Return the material under sustained load: E / (1 + phi), the effective modulus of creep."""
    return replace(material, youngs_modulus=material.youngs_modulus / (1 + creep_coefficient))
