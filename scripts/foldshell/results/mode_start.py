"""Modes that a search for buckling factors on another mesh, or of another state, begins with."""

from collections.abc import Sequence

import numpy as np

from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.shell.analysis import ShellModel
from foldshell.shell.effort import KNOWN, USUAL, Effort
from foldshell.shell.transfer import transfer_modes


def pick_modes(
    final: AnalysisArrays, names: Sequence[str], chosen: Sequence[str]
) -> np.ndarray | None:
    """Return the modes (free, c) of the chosen combinations among all names, None where one has
    none. Without unit.
    """
    modes = final.buckling_modes
    if modes is None or modes.shape[1] != len(names) or not set(chosen) <= set(names):
        return None
    return modes[:, [names.index(name) for name in chosen]]


def begin_with(
    start: tuple[ShellModel | None, np.ndarray] | None, model: ShellModel
) -> tuple[np.ndarray | None, Effort]:
    """Return the modes (free, c) with which the search for modes begins, and its effort.

    `start` is (model, modes) of a mesh before, or (None, modes) of this one where a search with
    random vectors has found them. Without unit.
    """
    if start is None:
        return None, USUAL
    before, modes = start
    if before is not None:
        return transfer_modes(before, model, modes), USUAL
    return (modes, KNOWN) if len(modes) == model.pattern.size else (None, USUAL)
