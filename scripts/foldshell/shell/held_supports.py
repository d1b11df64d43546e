"""The supports of mesh.npz: what each holds, and its share of the reactions."""

from collections.abc import Mapping

import numpy as np

from foldshell.shell.analysis import ShellModel, build_model
from foldshell.shell.boundary import Boundary, Hold, join_holds, list_nodes, spread_springs
from foldshell.shell.mesh import ShellMesh, translation_dofs
from foldshell.shell.supports import BORDERS, share_supported_nodes


def list_holds(arrays: Mapping[str, np.ndarray]) -> dict[str, Hold]:
    """Return what each support of mesh.npz holds, by name; borders where no set is named.

    The arrays are those of `MeshArrays`, in the axes and units that it states.
    """
    pairs, row = arrays["support_pairs"], arrays["support_border"]
    if arrays.get("support_names") is None:
        pin, free, none = np.ones(3, dtype=bool), np.zeros(3), np.empty(0, dtype=np.int64)
        return {
            BORDERS[number]: Hold(pairs[row == number], none, pin, False, free)
            for number in np.unique(row).tolist()
        }
    vertices, vertex_row = arrays["support_vertices"], arrays["support_vertex_row"]
    return {
        str(name): Hold(
            pairs[row == k],
            vertices[vertex_row == k],
            arrays["support_fix"][k].astype(bool),
            bool(arrays["support_clamp"][k]),
            arrays["support_spring"][k],
        )
        for k, name in enumerate(arrays["support_names"].tolist())
    }


def find_boundary(mesh: ShellMesh, arrays: Mapping[str, np.ndarray]) -> Boundary | None:
    """Return what the supports of mesh.npz hold, None where all are pinned borders.

    The arrays are those of `MeshArrays`, in the axes and units that it states.
    """
    if arrays.get("support_names") is None:
        return None
    return join_holds(mesh, list(list_holds(arrays).values()))


def list_supported_vertices(arrays: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the vertices (S,) on edges that are held, or held by themselves, of mesh.npz.

    They are numbers.
    """
    alone = arrays.get("support_vertices")
    pairs = arrays["support_pairs"]
    return np.unique(pairs) if alone is None else np.union1d(pairs.ravel(), alone)


def list_fixed(mesh: ShellMesh, arrays: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the numbers (k,) of all freedoms that the supports of mesh.npz hold.

    The arrays are those of `MeshArrays`, in the axes and units that it states.
    """
    boundary = find_boundary(mesh, arrays)
    return translation_dofs(arrays["supported_nodes"]) if boundary is None else boundary.fixed


def build_supported_model(
    mesh: ShellMesh, arrays: Mapping[str, np.ndarray], poissons_ratio: float
) -> ShellModel:
    """Build the model of a mesh on the supports of mesh.npz, with its edge beam.

    The arrays are those of `MeshArrays`, in the axes and units that it states. Raises `ValueError`
    where they leave the whole shell free to turn.
    """
    beam, boundary = arrays.get("fixed_thickness"), find_boundary(mesh, arrays)
    if boundary is None:
        pinned = arrays["supported_nodes"]
        return build_model(mesh, pinned, poissons_ratio, fixed_thickness=beam)
    none = np.empty(0, dtype=np.int64)
    return build_model(mesh, none, poissons_ratio, boundary.fixed, beam, boundary.springs)


def share_nodes(
    mesh: ShellMesh, holds: Mapping[str, Hold], nodes: np.ndarray
) -> dict[str, np.ndarray]:
    """Return how much of the reaction of each node (S,) counts for each support, (S, 3).

    A node that several hold along an axis counts for each alike; where one holds it, the springs of
    others take nothing; springs share by their stiffness. The shares have no unit.
    """
    fixed, spring = {}, {}
    for name, hold in holds.items():
        own = np.zeros((len(mesh.nodes), 3))
        own[list_nodes(mesh, hold)] = hold.fix
        fixed[name], spring[name] = own[nodes], spread_springs(mesh, hold)[nodes]
    count = sum(fixed.values())
    total = np.where(count > 0, 0.0, sum(spring.values()))
    return {
        name: np.where(
            count > 0,
            fixed[name] / np.maximum(count, 1),
            spring[name] / np.where(total > 0, total, 1.0),
        )
        * ((count > 0) | (total > 0))
        for name in holds
    }


def sum_supports(
    mesh: ShellMesh, arrays: Mapping[str, np.ndarray], nodes: np.ndarray, reactions: np.ndarray
) -> dict[str, np.ndarray]:
    """Return the resultant (3, c) kN of each support's reactions, by name.

    Parameters
    ----------
    arrays : those of mesh.npz, see `MeshArrays`
    nodes : (S,) nodes at which supports act
    reactions : (S, 3, c) kN
    """
    if arrays.get("support_names") is None:
        pairs, border = arrays["support_pairs"], arrays["support_border"]
        shares = share_supported_nodes(mesh, pairs, border, nodes)
        return {name: np.tensordot(share, reactions, 1) for name, share in shares.items()}
    shares = share_nodes(mesh, list_holds(arrays), nodes)
    return {name: np.einsum("sx,sxc->xc", share, reactions) for name, share in shares.items()}
