"""Supports at the nodes of a mesh for FE programs: restraints, clamps and springs."""

import numpy as np

from foldshell.exchange.fe_mesh import QuadMesh
from foldshell.exchange.model import ExportModel, Support
from foldshell.files.errors import InputError

ALONG_AXIS = 1 - 1e-9
"""Cosine from which an edge runs along a global axis."""
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6
TRAPEZOID = np.array([1.0, 1.0]) / 2
Directions = tuple[bool, bool, bool]


def held_nodes(model: ExportModel, mesh: QuadMesh) -> dict[int, Directions]:
    """Return which of x, y, z is fixed at each supported node, by all supports that it lies on."""
    held: dict[int, Directions] = {}
    for k, support in enumerate(model.supports):
        if any(support.fixed):
            for node in mesh.supported[k].tolist():
                own = held.get(node, (False, False, False))
                held[node] = tuple(a or b for a, b in zip(own, support.fixed, strict=True))
    return dict(sorted(held.items()))


def held_rotations(model: ExportModel, mesh: QuadMesh) -> dict[int, Directions]:
    """Return about which of x, y, z the rotation is fixed at each node on a clamped edge.

    Raises `InputError` for a clamp that no program here can be told, see `clamp_axes`.
    """
    held: dict[int, Directions] = {}
    for k, support in enumerate(model.supports):
        if support.clamp:
            for axes, nodes in zip(clamp_axes(model, support), mesh.chains[k], strict=True):
                for node in nodes.tolist():
                    own = held.get(node, (False, False, False))
                    held[node] = tuple(a or b for a, b in zip(own, axes, strict=True))
    return dict(sorted(held.items()))


def clamp_axes(model: ExportModel, support: Support) -> list[Directions]:
    """Return about which of x, y, z each edge of a clamp is held: the axis that it runs along.

    An edge along none is held about all, which says the same where its translations are fixed: they
    hold the other two rotations of the edge. Raises `InputError` where they are not.
    """
    ends = model.vertices[support.edges]
    along = np.abs(ends[:, 1] - ends[:, 0])
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    found: list[Directions] = []
    for edge, pair in zip(along, support.edges.tolist(), strict=True):
        on_axis = edge >= ALONG_AXIS
        if not on_axis.any() and not all(support.fixed):
            raise InputError(
                f"{model.design}: exports: support {support.name!r}: edge {pair[0]}-{pair[1]} is "
                "clamped, runs along no axis and is not fixed along x, y and z: other programs are "
                "told rotations about axes alone"
            )
        found.append(tuple((on_axis if on_axis.any() else np.ones(3, bool)).tolist()))
    return found


def spring_nodes(model: ExportModel, mesh: QuadMesh) -> dict[int, tuple[float, float, float]]:
    """Return the springs along x, y, z at nodes, kN/m: those of edges by the rule of the elements.

    Simpson's where sides have middle nodes, else the trapezoid's.
    """
    total = np.zeros_like(mesh.nodes)
    rule = SIMPSON if mesh.middles.shape[1] else TRAPEZOID
    for k, support in enumerate(model.supports):
        if not any(support.spring):
            continue
        np.add.at(total, mesh.alone[k], support.spring)
        chain, step = mesh.chains[k], len(rule) - 1
        for start in range(0, chain.shape[1] - 1, step):
            part = chain[:, start : start + step + 1]
            size = np.linalg.norm(mesh.nodes[part[:, -1]] - mesh.nodes[part[:, 0]], axis=1)
            share = size[:, None, None] * rule[:, None] * np.array(support.spring)
            np.add.at(total, part, share)
    rows = np.flatnonzero(total.any(axis=1))
    return {int(row): tuple(total[row].tolist()) for row in rows}
