"""Reactions of each support by itself: their sums, and which way a support holds a thrust."""

import numpy as np

from crosscheck.mesh import Mesh
from crosscheck.model import Model


def sum_supports(model: Model, mesh: Mesh, reactions: np.ndarray) -> dict[str, np.ndarray]:
    """Sum of the reactions (S, 3, c) of skeleton nodes over each support: {name: (3, c)} in kN.

    A node where two supports meet, at a corner, counts by half for each.
    """
    shares = share_nodes(model, mesh)
    return {name: np.einsum("s,sxc->xc", share, reactions) for name, share in shares.items()}


def share_nodes(model: Model, mesh: Mesh) -> dict[str, np.ndarray]:
    """How much of each skeleton node (S,) counts for each support; supports of a node share it."""
    place = {tuple(edge): k for k, edge in enumerate(mesh.edges.tolist())}
    on = {}
    for support in model.supports:
        sides = [place[tuple(side)] for side in np.sort(support.edges, axis=1).tolist()]
        on[support.name] = np.zeros(mesh.skeleton)
        on[support.name][mesh.edge_nodes[sides].ravel()] = 1.0
    count = np.maximum(sum(on.values()), 1.0)
    return {name: held / count for name, held in on.items()}


def find_thrusts(model: Model) -> dict[str, np.ndarray]:
    """The horizontal unit vector (3,) along which each support holds the thrust of the shell.

    At right angles to the line through the support's vertices in plan, towards the middle of the
    shell; towards the middle alone where they are one point in plan.
    """
    plan = model.vertices[:, :2]
    middle = plan.mean(axis=0)
    result = {}
    for support in model.supports:
        points = plan[np.unique(support.edges)]
        centre = points.mean(axis=0)
        inward = middle - centre
        _, spread, axes = np.linalg.svd(points - centre)
        if spread[0] > 0:
            inward = axes[1] * np.sign(axes[1] @ inward or 1.0)
        length = np.linalg.norm(inward)
        result[support.name] = np.append(inward / length if length > 0 else (1.0, 0.0), 0.0)
    return result
