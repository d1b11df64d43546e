"""The state that a loop ends with, looked at before its numbers are believed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from foldshell.checks.validity import (
    ModelState,
    find_support_runs,
    list_warnings,
    measure_form_radii,
    measure_widths,
)
from foldshell.shell.results import support_reactions

if TYPE_CHECKING:
    from foldshell.sizing.describe import Analysed


def find_warnings(done: Analysed) -> tuple[str, ...]:
    """Return one sentence for each bound of theory or mesh that the analysed state passes.

    Without displacements only the thicknesses are looked at.
    """
    model, task = done.case.model, done.task
    sized, supported = model.sized_panels, model.supported_nodes
    answered = done.utilization is not None
    reactions = None
    if answered:
        reactions = support_reactions(model, done.result, done.thickness, done.case.material)
    width = measure_widths(model.mesh)
    state = ModelState(
        thickness=task.thickness,
        width=width[:sized],
        radius=measure_form_radii(model.mesh, sized),
        span=task.span,
        displacement=done.downward[0] if answered else None,
        reactions=reactions,
        nodes=model.mesh.nodes[supported],
        runs=find_support_runs(model.mesh, supported),
        edge_beam=np.stack([model.fixed_thickness, width[sized:]]),
    )
    return (*done.case.notes, *list_warnings(state))
