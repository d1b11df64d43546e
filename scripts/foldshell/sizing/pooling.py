"""Panels of one group as one panel, so that every rule sizes groups without knowing of them."""

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from foldshell.sizing.constraints import Constraints
from foldshell.sizing.panel_limits import gather
from foldshell.sizing.rules import SizingState

Members = npt.NDArray[np.int64]


def pool_state(state: SizingState, member: Members) -> SizingState:
    """Return a state of G groups from one of P panels: the most used panel speaks for its group.

    `member` (P,) is the number of each panel's group.
    """
    first = np.unique(member, return_index=True)[1]
    least, largest = state.least, state.largest
    return replace(
        state,
        thickness=gather(np.maximum, state.thickness, member),
        utilization=gather(np.maximum, state.utilization, member),
        step=gather(np.minimum, state.step, member),
        direction=state.direction[first],
        sign_changes=gather(np.maximum, state.sign_changes, member),
        constraints=state.constraints and _pool_constraints(state.constraints, member),
        least=None if least is None else least[first],
        largest=None if largest is None else largest[first],
    )


def _pool_constraints(constraints: Constraints, member: Members) -> Constraints:
    """Add up gradients and areas: dg/dT of a thickness T that panels share."""
    sums = np.array([np.bincount(member, row) for row in constraints.gradient])
    thinning = constraints.thinning
    return replace(
        constraints,
        gradient=sums.reshape(len(constraints.value), member.max() + 1),
        area=np.bincount(member, constraints.area),
        thinning=None if thinning is None else gather(np.minimum, thinning, member),
    )


def spread_state(state: SizingState, member: Members, panels: SizingState) -> SizingState:
    """Return what a rule made of groups as a state of the panels (P,) in them."""
    return replace(
        panels,
        thickness=state.thickness[member],
        step=state.step[member],
        direction=state.direction[member],
        sign_changes=state.sign_changes[member],
    )
