"""The buckling factor that a shell needs: elastic, perfect and young as it was computed."""

import math
from dataclasses import dataclass

from foldshell.settings.checks import Checks

STEP = 0.5
"""The factor that is required is rounded up to a multiple of this."""


@dataclass(frozen=True)
class RequiredFactor:
    """gamma_E (1 + phi_ef) / (a_imperfection a_cracking), its terms and the rounded value."""

    partial_factor: float
    effective_creep: float
    imperfection: float
    cracking: float

    @property
    def product(self) -> float:
        """The factor by its terms."""
        gone = self.imperfection * self.cracking
        return self.partial_factor * (1 + self.effective_creep) / gone

    @property
    def value(self) -> float:
        """The same, rounded up."""
        return math.ceil(round(self.product / STEP, 9)) * STEP


def require_factor(checks: Checks, kind: str) -> RequiredFactor:
    """gamma_E (1 + phi_ef) / (a_imperfection a_cracking), phi_ef = phi x permanent share.

    Steel neither creeps nor cracks; only concrete cracks.
    """
    creep = 0.0 if kind == "steel" else checks.creep_coefficient * checks.permanent_share
    cracking = checks.buckling_cracking if kind == "concrete" else 1.0
    return RequiredFactor(
        checks.buckling_partial_factor, creep, checks.buckling_imperfection, cracking
    )


def correct_factor(factor: float, mesh_error: float | None) -> float:
    """factor / (1 + error): what the error of the mesh may take from a buckling factor."""
    return factor / (1 + (mesh_error or 0.0))
