"""Strength criteria; stresses in kPa, tension positive."""

from collections.abc import Callable

import numpy as np

from foldshell.settings.material import Material

Criterion = Callable[[np.ndarray, Material], np.ndarray]
"""From stresses (..., 3) kPa to utilization (...)."""


def principal_stresses(stress: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the larger and smaller principal value of plane components (xx, yy, xy), (..., 3).

    Any unit, the same in and out; both (...).
    """
    centre = (stress[..., 0] + stress[..., 1]) / 2
    radius = np.hypot((stress[..., 0] - stress[..., 1]) / 2, stress[..., 2])
    return centre + radius, centre - radius


def utilization_von_mises(stress: np.ndarray, material: Material) -> np.ndarray:
    """sqrt(sx^2 - sx sy + sy^2 + 3 t^2) / f, as in the paper's loop; (..., 3) to (...).

    stress (..., 3) kPa as xx, yy, xy; returns (...) without unit.
    """
    x, y, xy = np.moveaxis(stress, -1, 0)
    return np.sqrt(x**2 - x * y + y**2 + 3 * xy**2) / material.strength


def utilization_rankine(stress: np.ndarray, material: Material) -> np.ndarray:
    """max(s1 / f_t, -s2 / f): largest principal tension or compression, each by its strength.

    stress (..., 3) kPa as xx, yy, xy; returns (...) without unit.
    """
    high, low = principal_stresses(stress)
    return np.maximum(high / material.strength_tension, -low / material.strength).clip(min=0.0)


def utilization_drucker_prager(stress: np.ndarray, material: Material) -> np.ndarray:
    """(alpha I1 + sqrt(J2)) / k through both uniaxial strengths (Drucker & Prager 1952).

    alpha = (f - f_t) / (sqrt(3) (f + f_t)), k = 2 f f_t / (sqrt(3) (f + f_t)).

    stress (..., 3) kPa as xx, yy, xy; returns (...) without unit.
    """
    x, y, xy = np.moveaxis(stress, -1, 0)
    root_j2 = np.sqrt((x**2 - x * y + y**2) / 3 + xy**2)
    compression, tension = material.strength, material.strength_tension
    total = np.sqrt(3) * (compression + tension)
    alpha, k = (compression - tension) / total, 2 * compression * tension / total
    return ((alpha * (x + y) + root_j2) / k).clip(min=0.0)


def utilization_capped_cone(stress: np.ndarray, material: Material) -> np.ndarray:
    """max(Drucker-Prager, -s2 / f): the cone, which is open towards equal biaxial compression.

    stress (..., 3) kPa as xx, yy, xy; returns (...) without unit.
    """
    return np.maximum(
        utilization_drucker_prager(stress, material), utilization_compression(stress, material)
    )


def utilization_compression(stress: np.ndarray, material: Material) -> np.ndarray:
    """-s2 / f, 0 without compression; stress (..., 3) kPa to (...) without unit."""
    return (-principal_stresses(stress)[1] / material.strength).clip(min=0.0)


def utilization_tension(stress: np.ndarray, material: Material) -> np.ndarray:
    """s1 / f_t, 0 without tension; stress (..., 3) kPa to (...) without unit."""
    return (principal_stresses(stress)[0] / material.strength_tension).clip(min=0.0)


CRITERIA: dict[str, Criterion] = {
    "von_mises": utilization_von_mises,
    "rankine": utilization_rankine,
    "drucker_prager": utilization_drucker_prager,
}
