"""Facets as substructures: everything inside a flat facet is condensed onto its outline.

In a flat facet membrane (u, v) and plate (w, bx, by) are uncoupled, so each is condensed alone,
first from the insides of the blocks, then from the spokes. No drilling rotation exists inside.
Unknowns are ordered so that what is kept comes first: parts of a matrix are then slices.
"""

from dataclasses import dataclass

import numpy as np

from crosscheck.mesh import ReferenceFacet


@dataclass(frozen=True)
class Condensation:
    """What is needed to go from the b outer values back to the i inner ones of some matrices."""

    back: np.ndarray  # (..., i, i + b) inverse(Kii) [1 | -Kib]: from inner loads and outer values

    @property
    def push(self) -> np.ndarray:
        """What inner loads, kN and kNm, add to outer ones, -Kbi inverse(Kii): (..., b, i)."""
        return np.swapaxes(self.back[..., self.back.shape[-2] :], -1, -2)


@dataclass(frozen=True)
class Substructure:
    """How one field (membrane or plate) of facets was condensed, in two steps."""

    dofs: int  # unknowns a node
    reference: ReferenceFacet
    blocks: Condensation  # (F, 3, ...)
    spokes: Condensation  # (F, ...)

    @property
    def border(self) -> int:
        """How many unknowns stand on the outline, the first of a facet's."""
        return self.reference.outline * self.dofs

    @property
    def kept(self) -> int:
        """How many stand on the outline and the spokes."""
        return self.border + self.reference.spokes * self.dofs

    @property
    def outer(self) -> np.ndarray:
        """A facet's unknowns on the outline of each block, as its condensation has them: (3, b)."""
        return spread_dofs(self.reference.blocks[:, self.reference.block_boundary], self.dofs)


def spread_dofs(nodes: np.ndarray, dofs: int) -> np.ndarray:
    """Dof numbers (..., k dofs) of nodes (..., k), node by node."""
    return (nodes[..., None] * dofs + np.arange(dofs)).reshape(*nodes.shape[:-1], -1)


def condense(matrix: np.ndarray, kept: int) -> tuple[np.ndarray, Condensation]:
    """S = Kbb - Kbi inverse(Kii) Kib for symmetric matrices (..., n, n); b is the first `kept`.

    Stiffness in kN/m, kN and kNm, facet by facet.
    """
    coupled = matrix[..., kept:, :kept]
    inverse = np.linalg.inv(matrix[..., kept:, kept:])
    coupling = inverse @ coupled
    schur = matrix[..., :kept, :kept] - np.swapaxes(coupled, -1, -2) @ coupling
    schur = (schur + np.swapaxes(schur, -1, -2)) / 2
    return schur, Condensation(np.concatenate([inverse, -coupling], axis=-1))


def assemble_blocks(element_matrices: np.ndarray, reference: ReferenceFacet) -> np.ndarray:
    """Sum element matrices (F, 3, m^2, 9d, 9d) into block matrices (F, 3, nd, nd).

    Nodes on a block's outline come first, those inside it last.
    """
    dofs = element_matrices.shape[-1] // 9
    order = np.concatenate([reference.block_boundary, reference.block_interior])
    position = np.argsort(order)
    size = len(order) * dofs
    total = np.zeros((*element_matrices.shape[:2], size, size))
    for k, nodes in enumerate(reference.elements):
        place = spread_dofs(position[nodes], dofs)
        total[..., place[:, None], place] += element_matrices[:, :, k]
    return total


def condense_facets(
    element_matrices: np.ndarray, reference: ReferenceFacet
) -> tuple[np.ndarray, Substructure]:
    """Condense element matrices (F, 3, m^2, 9d, 9d) onto the facet outlines.

    Returns the stiffness of the outlines (F, 12m d, 12m d) and the way back from them.
    """
    dofs = element_matrices.shape[-1] // 9
    edge = len(reference.block_boundary) * dofs
    block, blocks = condense(assemble_blocks(element_matrices, reference), edge)
    kept = (reference.outline + reference.spokes) * dofs
    facet = np.zeros((len(block), kept, kept))
    for k in range(3):
        place = spread_dofs(reference.blocks[k][reference.block_boundary], dofs)
        facet[:, place[:, None], place] += block[:, k]
    stiffness, spokes = condense(facet, reference.outline * dofs)
    return stiffness, Substructure(dofs, reference, blocks, spokes)


def allocate(part: Substructure, count: int) -> Substructure:
    """An empty substructure of `count` facets, with the sizes of `part`."""

    def like(step: Condensation) -> Condensation:
        """The array of one step."""
        return Condensation(np.empty((count, *step.back.shape[1:])))

    return Substructure(part.dofs, part.reference, like(part.blocks), like(part.spokes))


def store(whole: Substructure, facets: np.ndarray, part: Substructure) -> None:
    """Put the condensation of some facets (S,), as numbers, in its place in that of all."""
    for into, step in ((whole.blocks, part.blocks), (whole.spokes, part.spokes)):
        into.back[facets] = step.back


def reduce_load(part: Substructure, load: np.ndarray) -> np.ndarray:
    """Move loads (F, R d, c) outward: Fb - Kbi inverse(Kii) Fi, in both steps.

    Entries of the outline are then the condensed load; the inner ones serve `recover_facets`.

    Loads in kN and kNm.
    """
    border, kept = part.border, part.kept
    total = load.copy()
    push = part.blocks.push @ _view_blocks(part, total)
    for k, outer in enumerate(part.outer):
        total[:, outer] += push[:, k]
    total[:, :border] += part.spokes.push @ total[:, border:kept]
    return total


def recover_facets(part: Substructure, reduced: np.ndarray, outline: np.ndarray) -> np.ndarray:
    """Values at all facet nodes (F, R d, c) from outline values and loads of `reduce_load`.

    Values are m or rad, loads kN or kNm.
    """
    border, kept = part.border, part.kept
    full = np.empty_like(reduced)
    full[:, :border] = outline
    both = np.concatenate([reduced[:, border:kept], outline], axis=1)
    full[:, border:kept] = part.spokes.back @ both
    outer = full.take(part.outer, axis=1)
    inner = part.blocks.back @ np.concatenate([_view_blocks(part, reduced), outer], axis=2)
    full[:, kept:] = inner.reshape(len(full), -1, full.shape[-1])
    return full


def _view_blocks(part: Substructure, values: np.ndarray) -> np.ndarray:
    """Values (F, R d, c) inside the three blocks: (F, 3, i, c)."""
    return values[:, part.kept :].reshape(len(values), 3, -1, values.shape[-1])
