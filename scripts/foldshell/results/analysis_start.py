"""What an analysis on another mesh, or of a state that is known, begins with."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.records.analysis import AnalysisRecord
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.settings.field import Factors
from foldshell.shell.analysis import AnalysisResult, ShellAnalysis, ShellModel
from foldshell.shell.buckling import BucklingResult
from foldshell.shell.effort import KNOWN, USUAL
from foldshell.shell.transfer import raise_order, transfer_modes


@dataclass(frozen=True)
class KnownState:
    """What a full analysis has found of combinations.

    Attributes
    ----------
    modes : (free, c) buckling modes
    factors : (c,) buckling factors, None where one is missing
    displacement : (dofs, c) m and rad of second order, None without
    """

    modes: np.ndarray
    factors: np.ndarray | None = None
    displacement: np.ndarray | None = None


@dataclass(frozen=True)
class MeshBefore:
    """A mesh that has been analysed: its model, modes (free, c), and what second order adds to the
    displacements of first order, (dofs, c) m and rad, None where there is none."""

    model: ShellModel
    modes: np.ndarray
    added: np.ndarray | None


def pick_known(
    final: AnalysisArrays, report: AnalysisRecord, combinations: Factors, chosen: Sequence[str]
) -> KnownState | None:
    """Return what final.npz and final.json say of the chosen combinations, None without modes."""
    names, modes = list(combinations), final.buckling_modes
    if modes is None or modes.shape[1] != len(names) or not set(chosen) <= set(names):
        return None
    columns = [names.index(name) for name in chosen]
    factors = [report.buckling_factor.get(name) for name in chosen]
    moved = final.displacement
    return KnownState(
        modes[:, columns],
        None if None in factors else np.array(factors),
        None if moved is None or not np.isfinite(moved).all() else moved[:, columns],
    )


def analyse_known(
    analysis: ShellAnalysis, model: ShellModel, known: KnownState | None
) -> AnalysisResult:
    """Return the analysis of a state of which all is known but first order: second order, begun
    with its answer, takes a step that confirms it, and buckling is not searched for again."""
    if known is None or len(known.modes) != model.pattern.size:
        return analysis.run(USUAL)
    moved = known.displacement
    start = moved if moved is not None and len(moved) == model.mesh.dof_count else None
    if known.factors is None or start is None or analysis.first_order is None:
        return analysis.run(KNOWN, known.modes, start)
    count = len(known.factors)
    buckling = BucklingResult(known.factors, known.modes, np.zeros(count), 0, True)
    return analysis.bend(buckling, KNOWN, start)


def analyse_after(
    analysis: ShellAnalysis, model: ShellModel, before: MeshBefore | None
) -> AnalysisResult:
    """Return the analysis on a mesh, begun with what another one has found where both have the
    same elements."""
    modes = before and transfer_modes(before.model, model, before.modes)
    if modes is None or before.added is None or analysis.first_order is None:
        return analysis.run(USUAL, modes)
    added = raise_order(before.model.mesh, model.mesh, before.added)
    return analysis.run(USUAL, modes, analysis.first_order + added)


def remember(model: ShellModel, result: AnalysisResult) -> MeshBefore | None:
    """Return what the next mesh begins with, None where nothing buckles."""
    if result.buckling is None:
        return None
    bent = result.second_order is not None
    added = result.displacement - result.first_order if bent else None
    return MeshBefore(model, result.buckling.modes, added)
