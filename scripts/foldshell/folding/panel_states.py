"""States of panels on their way from flat, to be shown one after the other."""

import numpy as np

from foldshell.folding.free_fold import FRACTIONS, fold_freely
from foldshell.folding.net import make_net
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.sheet import Frame

PATH_SHARE = 0.35
"""Of shut, to which a pattern without angles is folded for an animation."""


def list_path(mesh: PanelMesh, frames: tuple[Frame, ...]) -> list[np.ndarray]:
    """Return states (V, 3) m of the way of panels from flat: those of a file, else freely folded.

    Raises `ValueError` for a sheet without a flat state.
    """
    if mesh.flat is None:
        raise ValueError("its flat sheet is not known: there is no way of folding to show")
    if frames:
        states = [frame.vertices for frame in frames]
        return states if mesh.folded is None else [*states, mesh.folded]
    net = make_net(mesh)
    share = 1.0 if net.given else PATH_SHARE
    states = [mesh.flat]
    for part in FRACTIONS:
        begun = states[-1] if len(states) > 1 else None
        states.append(fold_freely(net, part * share, 1e-8, begun).vertices)
    return states
