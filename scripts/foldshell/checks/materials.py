"""Which criterion holds for which kind of material in the engineering verdict."""

from dataclasses import dataclass

from foldshell.checks.strength import (
    CRITERIA,
    Criterion,
    utilization_capped_cone,
    utilization_rankine,
    utilization_von_mises,
)
from foldshell.settings.material import Material

CONCRETE, STEEL = "concrete", "steel"
CRITERION_WORDS = {
    "von_mises": "von Mises",
    "rankine": "Rankine",
    "drucker_prager": "Drucker-Prager",
}


@dataclass(frozen=True)
class StrengthCheck:
    """Criterion and strengths (kPa) of a kind of material, and what it means to fail."""

    criterion: Criterion
    material: Material
    words: str
    failure: str


def choose_strength_check(material: Material, partial_factor: float) -> StrengthCheck:
    """Return the check of a material: of concrete without steel that of Rankine, of steel that of
    von Mises, of a user's material its own criterion; strengths over gamma_M but for concrete."""
    divided = material.changed(
        strength=material.strength / partial_factor,
        strength_tension=material.strength_tension / partial_factor,
    )
    tension, strength = material.strength_tension / 1e3, divided.strength / 1e3
    if material.kind == CONCRETE:
        words, failure = f"Rankine, tension {tension:.4g} MPa", "tension without reinforcement"
        return StrengthCheck(utilization_rankine, material, words, failure)
    if material.kind == STEEL:
        return StrengthCheck(
            utilization_von_mises, divided, f"von Mises, {strength:.4g} MPa", "steel"
        )
    criterion, words = CRITERIA[material.criterion], CRITERION_WORDS[material.criterion]
    if material.criterion == "drucker_prager":
        criterion, words = utilization_capped_cone, f"{words} with a cap of compression"
    return StrengthCheck(criterion, divided, f"{words}, {strength:.4g} MPa", "strength")
