"""Facets as substructures: everything inside a flat facet is condensed onto its outline.

In a flat facet membrane (u, v) and plate (w, bx, by) are uncoupled, so each is condensed alone,
first from the insides of the blocks, then from the spokes. No drilling rotation exists inside.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from crosscheck.mesh import ReferenceFacet


@dataclass(frozen=True)
class Condensation:
    """What is needed to go from outline values back to inner values of a batch of matrices."""

    boundary: np.ndarray  # (b,) dofs kept
    interior: np.ndarray  # (i,) dofs eliminated
    coupling: np.ndarray  # (..., i, b) inverse(Kii) Kib
    inverse: np.ndarray  # (..., i, i) inverse(Kii)


@dataclass(frozen=True)
class Substructure:
    """One field (membrane or plate) of all facets, condensed in two steps."""

    dofs: int  # unknowns a node
    reference: ReferenceFacet
    blocks: Condensation  # (F, 3, ...)
    spokes: Condensation  # (F, ...)
    stiffness: np.ndarray  # (F, outline dofs, outline dofs)


def spread_dofs(nodes: np.ndarray, dofs: int) -> np.ndarray:
    """Dof numbers of nodes, node by node."""
    return (nodes[..., None] * dofs + np.arange(dofs)).reshape(*nodes.shape[:-1], -1)


def condense(
    matrix: np.ndarray, boundary: np.ndarray, interior: np.ndarray
) -> tuple[np.ndarray, Condensation]:
    """S = Kbb - Kbi inverse(Kii) Kib for a batch of symmetric matrices (..., n, n)."""
    coupled = matrix[..., interior[:, None], boundary]
    inner = matrix[..., interior[:, None], interior]
    coupling = np.linalg.solve(inner, coupled)
    schur = matrix[..., boundary[:, None], boundary] - np.swapaxes(coupled, -1, -2) @ coupling
    schur = (schur + np.swapaxes(schur, -1, -2)) / 2
    return schur, Condensation(boundary, interior, coupling, np.linalg.inv(inner))


def assemble_blocks(element_matrices: np.ndarray, reference: ReferenceFacet) -> np.ndarray:
    """Sum element matrices (F, 3, m^2, 9d, 9d) into block matrices (F, 3, nd, nd)."""
    dofs = element_matrices.shape[-1] // 9
    size = reference.blocks.shape[1] * dofs
    total = np.zeros((*element_matrices.shape[:2], size, size))
    for k, nodes in enumerate(reference.elements):
        place = spread_dofs(nodes, dofs)
        total[..., place[:, None], place] += element_matrices[:, :, k]
    return total


def condense_facets(element_matrices: np.ndarray, reference: ReferenceFacet) -> Substructure:
    """Condense element matrices (F, 3, m^2, 9d, 9d) onto the facet outlines."""
    dofs = element_matrices.shape[-1] // 9
    outer = spread_dofs(reference.block_boundary, dofs)
    inner = spread_dofs(reference.block_interior, dofs)
    block, blocks = condense(assemble_blocks(element_matrices, reference), outer, inner)
    kept = reference.outline + reference.spokes
    facet = np.zeros((len(block), kept * dofs, kept * dofs))
    for k in range(3):
        place = spread_dofs(reference.blocks[k][reference.block_boundary], dofs)
        facet[:, place[:, None], place] += block[:, k]
    border = np.arange(reference.outline * dofs)
    middle = np.arange(reference.outline * dofs, kept * dofs)
    stiffness, spokes = condense(facet, border, middle)
    return Substructure(dofs, reference, blocks, spokes, stiffness)


def join_parts(parts: Sequence[Substructure]) -> Substructure:
    """One substructure from those of successive ranges of facets."""

    def join(name: str) -> Condensation:
        """One of the two steps of all parts."""
        steps = [getattr(part, name) for part in parts]
        return Condensation(
            steps[0].boundary,
            steps[0].interior,
            np.concatenate([step.coupling for step in steps]),
            np.concatenate([step.inverse for step in steps]),
        )

    stiffness = np.concatenate([part.stiffness for part in parts])
    first = parts[0]
    return Substructure(first.dofs, first.reference, join("blocks"), join("spokes"), stiffness)


def reduce_load(part: Substructure, load: np.ndarray) -> np.ndarray:
    """Move loads (F, R d, c) outward: Fb - Kbi inverse(Kii) Fi, in both steps.

    Entries of the outline are then the condensed load; the inner ones serve `recover_facets`.
    """
    total = load.copy()
    for k in range(3):
        inner, outer = _block_dofs(part, k)
        coupling = np.swapaxes(part.blocks.coupling[:, k], -1, -2)
        total[:, outer] -= coupling @ total[:, inner]
    spokes = part.spokes
    total[:, spokes.boundary] -= np.swapaxes(spokes.coupling, -1, -2) @ total[:, spokes.interior]
    return total


def recover_facets(part: Substructure, reduced: np.ndarray, outline: np.ndarray) -> np.ndarray:
    """Values at all facet nodes (F, R d, c) from outline values and loads of `reduce_load`."""
    full = np.empty_like(reduced)
    spokes = part.spokes
    full[:, spokes.boundary] = outline
    full[:, spokes.interior] = (
        spokes.inverse @ reduced[:, spokes.interior] - spokes.coupling @ outline
    )
    for k in range(3):
        inner, outer = _block_dofs(part, k)
        full[:, inner] = (
            part.blocks.inverse[:, k] @ reduced[:, inner]
            - part.blocks.coupling[:, k] @ full[:, outer]
        )
    return full


def _block_dofs(part: Substructure, k: int) -> tuple[np.ndarray, np.ndarray]:
    """Facet dofs inside and on the outline of block k, in the order of its condensation."""
    nodes, reference = part.reference.blocks[k], part.reference
    inner = spread_dofs(nodes[reference.block_interior], part.dofs)
    return inner, spread_dofs(nodes[reference.block_boundary], part.dofs)
