"""Reactions of each support by itself: their sums, and which way a support holds a thrust."""

import numpy as np

from crosscheck.mesh import Mesh
from crosscheck.model import Model
from crosscheck.supports import share_nodes


def sum_supports(model: Model, mesh: Mesh, reactions: np.ndarray) -> dict[str, np.ndarray]:
    """Sum of the reactions (S, 3, c) of skeleton nodes over each support: {name: (3, c)} in kN.

    A node where two supports meet, at a corner, counts by half for each.
    """
    shares = share_nodes(model.supports, mesh)
    return {name: np.einsum("sx,sxc->xc", share, reactions) for name, share in shares.items()}


def find_thrusts(model: Model) -> dict[str, np.ndarray]:
    """The horizontal unit vector (3,) along which each support holds the thrust of the shell.

    At right angles to the line through the support's vertices in plan, towards the middle of the
    shell; towards the middle alone where they are one point in plan.
    """
    plan = model.vertices[:, :2]
    middle = plan.mean(axis=0)
    result = {}
    for support in model.supports:
        points = plan[np.union1d(support.edges, support.vertices).astype(int)]
        centre = points.mean(axis=0)
        inward = middle - centre
        _, spread, axes = np.linalg.svd(points - centre)
        if spread[0] > 0:
            inward = axes[1] * np.sign(axes[1] @ inward or 1.0)
        length = np.linalg.norm(inward)
        result[support.name] = np.append(inward / length if length > 0 else (1.0, 0.0), 0.0)
    return result
