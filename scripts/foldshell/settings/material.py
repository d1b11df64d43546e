"""The material of a shell; stresses in kPa."""

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Material:
    """An isotropic elastic material: moduli and strengths in kPa, unit weight in kN/m3."""

    name: str
    youngs_modulus: float
    poissons_ratio: float
    unit_weight: float
    strength: float
    strength_tension: float
    criterion: str = "von_mises"


def age_material(material: Material, creep_coefficient: float) -> Material:
    """Return the material under sustained load: E / (1 + phi), the effective modulus of creep."""
    return replace(material, youngs_modulus=material.youngs_modulus / (1 + creep_coefficient))
