"""The order at which values settle, observed on a third mesh, and whether it is one at all.

The mesh error takes an order for granted (`mesh_errors.ORDER`). With values on three meshes
it can be seen: (v1 - v2) / (v2 - v3) = (h1^p - h2^p) / (h2^p - h3^p). Where the values turn back,
or come nearer slower than in proportion to the element size, the extrapolated limit means little:
the meshes are not in the asymptotic range.
Source: Roache (1998), Verification and Validation in Computational Science and Engineering, ch. 5.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from foldshell.records.mesh_convergence import (
    MeshConvergenceRecord,
    MeshStudy,
    ReferenceMesh,
    ThirdMesh,
)
from foldshell.records.plain import to_plain
from foldshell.results.mean_fold import is_folded
from foldshell.results.mesh_convergence import DesignOnMeshes, MechanismError, study_design
from foldshell.results.mesh_errors import FACTOR, QUANTITIES, make_record
from foldshell.shell.curved_panels import PARTS, is_curved

CURVED_PARTS = 2
"""Quads along the side of a smooth panel on the third mesh."""

ORDER_LEAST, ORDER_MOST = 1.0, 20.0
"""Least order that counts as asymptotic; largest that is told from the difference of meshes."""

SETTLED = 0.01
"""Relative difference of all meshes below which a value has settled, whatever its order."""


def choose_third(
    folded: Mapping[str, np.ndarray], subdivisions: int
) -> tuple[ReferenceMesh, float]:
    """Return a third mesh, and the subdivisions that it counts for.

    Of folded sheets it is finer than the mesh in use, of others coarser.

    `folded` holds the arrays of folded.npz.
    """
    if is_curved(folded):
        return ReferenceMesh(panel_parts=CURVED_PARTS), subdivisions * CURVED_PARTS / PARTS
    size = 2 * subdivisions if is_folded(folded) else max(1, subdivisions // 2)
    return ReferenceMesh(subdivisions=size), float(size)


def study_meshes(
    design: DesignOnMeshes, subdivisions: int, third: bool
) -> tuple[MeshConvergenceRecord, MeshStudy]:
    """Return mesh_convergence.json, with a third mesh where asked for, and primary.json."""
    record = make_record(study_design(design, subdivisions))
    return (add_third_mesh(record, design) if third else record), study_facets(record, design)


def add_third_mesh(record: MeshConvergenceRecord, design: DesignOnMeshes) -> MeshConvergenceRecord:
    """Return mesh_convergence.json with what a third mesh says of the order."""
    mesh, size = choose_third(design.folded, record.subdivisions)
    own = {"subdivisions": record.subdivisions} | to_plain(mesh)
    try:
        values = design.analyse(own).values
    except MechanismError:
        return record
    found = {
        name: {key: getattr(one, key) for key in (*QUANTITIES, FACTOR)}
        for name, one in values.items()
    }
    orders, doubtful = compare_meshes(record.study, found, size)
    third = ThirdMesh(
        mesh=mesh, subdivisions=size, values=found, observed_order=orders,
        not_asymptotic=bool(doubtful), doubtful=tuple(doubtful),
    )  # fmt: skip
    return replace(record, third=third)


def study_facets(record: MeshConvergenceRecord, design: DesignOnMeshes) -> MeshStudy:
    """Return primary.json, on whose facets the independent code stands: of a smooth shell those of
    the mesh in use, whose finer mesh is then one of more subdivisions."""
    if not is_curved(design.folded):
        return record.study
    finer = ReferenceMesh(subdivisions=2 * record.subdivisions)
    return study_design(design, record.subdivisions, finer)


def compare_meshes(
    study: MeshStudy, third: Mapping[str, Mapping[str, float]], size: float
) -> tuple[dict[str, dict[str, float | None]], list[str]]:
    """Return the order of each quantity by combination, None for none, and those in doubt.

    `third` are the values on a mesh that counts for `size` subdivisions.
    """
    orders: dict[str, dict[str, float | None]] = {}
    doubtful = []
    for name, values in third.items():
        orders[name] = {}
        for key, value in values.items():
            pair = getattr(study.combinations[name], key)
            meshes = sorted(zip((*study.subdivisions, size), (*pair, value), strict=True))
            sizes, found = zip(*meshes, strict=True)
            orders[name][key] = observe_order(sizes, found)
            if not is_asymptotic(found, orders[name][key]):
                doubtful.append(f"{name} {key}: " + ", ".join(f"{one:.4g}" for one in found))
    return orders, doubtful


def observe_order(subdivisions: Sequence[float], values: Sequence[float]) -> float | None:
    """Return p with v = limit + c h^p on three meshes, h = 1 / subdivisions; None for no such p.

    Subdivisions rise. There is none where the values turn back, or near faster than `ORDER_MOST`.
    """
    first, second = values[0] - values[1], values[1] - values[2]
    if first * second <= 0:
        return None
    h = 1 / np.asarray(subdivisions, dtype=float)
    order = np.linspace(1e-3, ORDER_MOST, 4000)[:, None]
    powers = (h / h[0]) ** order
    ratio = (powers[:, 0] - powers[:, 1]) / (powers[:, 1] - powers[:, 2])
    if not ratio[0] <= first / second <= ratio[-1]:
        return None
    return float(np.interp(first / second, ratio, order[:, 0]))


def is_asymptotic(values: Sequence[float], order: float | None) -> bool:
    """Tell whether values on three meshes have settled, or come nearer at an order that is one."""
    largest = max(abs(value) for value in values)
    if max(values) - min(values) <= SETTLED * largest:
        return True
    return order is not None and order >= ORDER_LEAST
