"""A final state under the combinations of the engineering verdict: analyses of its own."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from foldshell.checks.materials import CONCRETE, STEEL
from foldshell.checks.strength import utilization_tension
from foldshell.checks.strips import Strips, find_strips, largest_of_panels, utilization_of_strips
from foldshell.settings.checks import Checks
from foldshell.settings.combination_rules import CombinationSet
from foldshell.settings.material import Material
from foldshell.shell.analysis import AnalysisResult, ShellAnalysis
from foldshell.shell.effort import KNOWN, USUAL, Effort
from foldshell.shell.results import support_reactions, translations
from foldshell.shell.stress import StressResultants, stress_resultants
from foldshell.sizing.accuracy import HIDDEN_FACTOR
from foldshell.sizing.iteration import AnalysisCase


@dataclass(frozen=True)
class EngineeringState:
    """Results that the engineering checks look at.

    Attributes
    ----------
    short : strength combinations, then characteristic ones, at E
    long_term, cracked : quasi-permanent ones at E / (1 + phi), and with panels cracked as well
    cracked_panels : (P + B,) bool
    resultants : of `short`; strips : rows of weights; both None for a mechanism
    thickness : (E,) m of elements
    """

    case: AnalysisCase
    combinations: CombinationSet
    thickness: np.ndarray
    short: AnalysisResult
    long_term: AnalysisResult | None = None
    cracked: AnalysisResult | None = None
    cracked_panels: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=bool))
    strips: Strips | None = None
    resultants: StressResultants | None = None

    @property
    def strength_count(self) -> int:
        """Number of strength combinations, which are the first columns of `short`."""
        return len(self.combinations.strength)

    @property
    def analyses(self) -> int:
        """Number of analyses that were made."""
        return len(
            {id(one) for one in (self.short, self.long_term, self.cracked) if one is not None}
        )

    def reactions(self) -> np.ndarray:
        """Return those of the supported nodes under `short`, (S, 3, c) kN."""
        return support_reactions(self.case.model, self.short, self.thickness, self.case.material)

    def load_sums(self) -> np.ndarray:
        """Return the resultants of the loads of `short`, (3, c) kN."""
        return translations(self.case.model, self.short.loads).sum(axis=0)


def analyse_final_state(
    case: AnalysisCase,
    combinations: CombinationSet,
    panel_thickness: np.ndarray,
    checks: Checks,
    modes: np.ndarray | None = None,
) -> EngineeringState:
    """Analyse strength and characteristic combinations at E, quasi-permanent ones at E / (1 + phi).

    Concrete is analysed once more with the stiffness of cracked panels reduced. Steel does not
    creep.

    Parameters
    ----------
    panel_thickness : (P,) m
    modes : (free, c) buckling modes of the loop, to begin with
    """
    model, material = case.model, case.material
    thickness = model.to_elements(panel_thickness)
    both = {**combinations.strength, **combinations.characteristic}
    short = _analyse(case, thickness, material, both, modes, USUAL)
    if short.state == "mechanism":
        return EngineeringState(case, combinations, thickness, short)
    strips = find_strips(model.operators, checks.strip_width)
    modulus = material.youngs_modulus
    found = stress_resultants(
        model.operators, short.displacement, thickness, modulus, short.imposed
    )
    creep = 0.0 if material.kind == STEEL else checks.creep_coefficient
    aged, sustained = _age(material, creep), combinations.quasi_permanent
    known = modes if short.buckling is None else short.buckling.modes
    long_term = _analyse(case, thickness, aged, sustained, known, KNOWN)
    cracked, which = None, np.zeros(int(model.mesh.panel.max()) + 1, dtype=bool)
    if material.kind == CONCRETE and checks.cracked_stiffness < 1:
        which = find_cracked(strips, found, thickness, material, len(combinations.strength))
        left = np.where(which[model.mesh.panel], checks.cracked_stiffness, 1.0)
        soft = aged.changed(youngs_modulus=aged.youngs_modulus * left)
        given = case, thickness, soft, sustained, known, KNOWN
        cracked = _analyse(*given) if which.any() else long_term
    return EngineeringState(
        case, combinations, thickness, short, long_term, cracked, which, strips, found
    )


def _age(material: Material, creep: float) -> Material:
    return material.changed(youngs_modulus=material.youngs_modulus / (1 + creep))


def _analyse(
    case: AnalysisCase,
    thickness: np.ndarray,
    material: Material,
    combinations: Mapping[str, Mapping[str, float]],
    modes: np.ndarray | None,
    effort: Effort,
) -> AnalysisResult:
    """Analyse with the loop's options; the last modes, repeated as they are needed, begin the
    search.

    Of sustained loads a factor decides no more than whether there is a state at all: known modes
    suffice for that, but where the least factor is so low that one they do not see could matter.
    """
    given = case.model, thickness, material, case.placed, combinations, case.options
    analysis, start = ShellAnalysis(*given), None
    if modes is not None:
        start = modes[:, -1 - np.arange(len(combinations)) % modes.shape[1]]
    result = analysis.run(USUAL if start is None else effort, start)
    low = result.least_factor is not None and result.least_factor < HIDDEN_FACTOR
    return analysis.run(USUAL, start) if effort is not USUAL and low else result


def find_cracked(
    strips: Strips,
    resultants: StressResultants,
    thickness: np.ndarray,
    material: Material,
    first: int,
) -> np.ndarray:
    """Return whether the tension of a facet or strip of each panel passes f_ct, (P + B,) bool.

    Of the columns from `first` on; thickness (E,) m.
    """
    later = StressResultants(
        resultants.force[..., first:], resultants.moment[..., first:], resultants.jump
    )
    used = utilization_of_strips(strips, later, thickness, material, utilization_tension)
    return largest_of_panels(strips, used).max(axis=1) > 1
