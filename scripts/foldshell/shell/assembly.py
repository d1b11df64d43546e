"""Scatter element matrices into one sparse lower triangle whose pattern is found once.

Freedoms are grouped by the vertex, edge or inside of an element they belong to. All freedoms of
a group are joined with the same others, so the pattern is found from groups, seven per element,
and an entry's place follows by arithmetic. Groups stand in an order of little fill.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldshell.files.threads import LARGE, divide_rows, run_parts
from foldshell.shell.dissection import rank_by_dissection
from foldshell.shell.mesh import ShellMesh
from foldshell.shell.reference import lattice_indices
from foldshell.shell.stiffness import ShellOperators

CHUNK = 64
"""Elements handled at once, so that temporary arrays stay in cache."""

PLACED = 4096
"""Elements whose entries are placed at once on a large mesh."""

HELD = -(1 << 40)
"""Place of a freedom that is held: negative even after any other has been added."""


@dataclass(frozen=True, eq=False)
class LowerPattern:
    """Compressed columns of the lower triangle over the free degrees of freedom.

    Attributes
    ----------
    free : (D,) bool, the degrees of freedom that are not supported
    dofs : (size,) the degree of freedom of each row
    indptr, indices : compressed columns, rows in ascending order, int64
    put : (E, d(d+1)/2) where each packed element entry is added; one past the end for none;
        int32 where that holds them
    springs : (size,) kN/m of elastic supports on the diagonal, None for none
    """

    free: np.ndarray
    dofs: np.ndarray
    indptr: np.ndarray
    indices: np.ndarray
    put: np.ndarray
    springs: np.ndarray | None = None

    @property
    def size(self) -> int:
        """Number of free degrees of freedom."""
        return len(self.indptr) - 1

    @cached_property
    def ascending(self) -> np.ndarray:
        """Rows (size,) in the order of their degrees of freedom. As numbers."""
        return np.argsort(self.dofs)


def find_pattern(
    operators: ShellOperators, fixed: np.ndarray, springs: np.ndarray | None = None
) -> LowerPattern:
    """Find where each packed element entry goes once the `fixed` freedoms are left out.

    `fixed` (k,) are numbers of freedoms, `springs` (dofs,) kN/m of elastic supports.
    """
    mesh = operators.mesh
    free = np.ones(mesh.dof_count, dtype=bool)
    free[np.asarray(fixed, dtype=np.int64)] = False
    groups, local_group = _element_groups(mesh)
    member = np.zeros(mesh.dof_count, dtype=np.int64)
    member[operators.dofs] = groups[:, local_group]
    size = np.bincount(member[free], minlength=int(groups.max()) + 1)
    rank = _find_rank(mesh, groups, size)
    dofs = np.flatnonzero(free)
    dofs = dofs[np.argsort(rank[member[dofs]], kind="stable")]
    ranked = np.empty_like(size)
    ranked[rank] = size
    columns = _group_columns(rank[groups], ranked)
    first = np.concatenate([[0], np.cumsum(ranked)])
    number = np.full(mesh.dof_count, -1)
    number[dofs] = np.arange(len(dofs))
    offset = np.where(free, number - first[rank[member]], HELD)
    put = _packed_places(operators.dofs, offset, rank[groups], local_group, columns)
    own = None if springs is None else np.asarray(springs, dtype=float)[dofs]
    return LowerPattern(free, dofs, columns.indptr, columns.indices, put, own)


def assemble_stiffness(
    operators: ShellOperators,
    pattern: LowerPattern,
    thickness: np.ndarray,
    youngs_modulus: float | np.ndarray,
) -> np.ndarray:
    """Return the nonzeros of K = E (t K_m + t^3 K_b) + springs in the order of `pattern`.

    Parameters
    ----------
    thickness : (E,) m, of each element
    youngs_modulus : kPa, of all or (E,) of each element
    """
    t = (youngs_modulus * np.asarray(thickness))[:, None]
    cubed = t * thickness[:, None] ** 2
    width = operators.membrane.shape[1]
    values = np.zeros(len(pattern.indices) + 1)
    for start in range(0, len(t), CHUNK):
        part = slice(start, start + CHUNK)
        packed = operators.bending[part] * cubed[part]
        packed[:, :width] += operators.membrane[part] * t[part]
        np.add.at(values, pattern.put[part].ravel(), packed.ravel())
    values = values[:-1]
    if pattern.springs is not None:
        values[pattern.indptr[:-1]] += pattern.springs  # each column begins with its diagonal
    return values


@dataclass(frozen=True)
class _GroupColumns:
    """Compressed columns, with the rows above each row group in a column group.

    `keys` are column group * groups + row group, ascending; `above` counts the rows of the column
    group's panel that stand above the row group; `start` and `height` are of each column group.
    """

    indptr: np.ndarray
    indices: np.ndarray
    keys: np.ndarray
    above: np.ndarray
    start: np.ndarray
    height: np.ndarray


def _element_groups(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray]:
    """Return the groups (E, 7) of an element, and which of the seven each local freedom is in."""
    nodes, edges = len(mesh.nodes), mesh.edge_count
    inside = nodes + edges + np.arange(len(mesh.elements))
    groups = np.concatenate([mesh.corners, nodes + mesh.element_edges, inside[:, None]], axis=1)
    _, compact = np.unique(groups, return_inverse=True)
    on_side = lattice_indices(mesh.order) == 0
    edge_opposite = np.array([4, 5, 3])
    local = np.full(len(on_side), 6)
    local[on_side.sum(axis=1) == 1] = edge_opposite[
        on_side[on_side.sum(axis=1) == 1].argmax(axis=1)
    ]
    corner = on_side.sum(axis=1) == 2
    local[corner] = (~on_side[corner]).argmax(axis=1)
    rotation = np.repeat([3, 4, 5], mesh.order)
    return compact.reshape(groups.shape), np.concatenate([np.repeat(local, 3), rotation])


def _find_rank(mesh: ShellMesh, groups: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return the place of each group: by minimum degree, on large meshes by dissection too."""
    rank = _fill_reducing_rank(groups, size)
    if size.sum() <= LARGE:
        return rank
    _, panel = np.unique(mesh.panel, return_inverse=True)
    points = mesh.nodes[mesh.corners].mean(axis=1)
    return rank_by_dissection(groups, size, panel, points, rank)


def _fill_reducing_rank(groups: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return the place of each group in an approximate-minimum-degree order of their graph.

    Without cvxopt the groups keep their order: SuperLU finds its own.
    """
    count = len(size)
    try:
        from cvxopt import amd, matrix, spmatrix
    except ImportError:
        return np.arange(count)
    low, high = np.tril_indices(groups.shape[1], -1)
    ends = np.sort(np.stack([groups[:, low].ravel(), groups[:, high].ravel()]), axis=0)
    keys = np.unique(ends[0] * count + ends[1])
    column, row = np.divmod(keys, count)
    every = np.arange(count)
    row, column = np.concatenate([row, every]), np.concatenate([column, every])
    graph = spmatrix(1.0, matrix(row), matrix(column), (count, count))
    rank = np.empty(count, dtype=np.int64)
    rank[np.array(amd.order(graph)).ravel()] = every
    return rank


def _group_columns(groups: np.ndarray, size: np.ndarray) -> _GroupColumns:
    """Expand the graph of ranked groups (E, 7) of given sizes to compressed columns."""
    count = len(size)
    low, high = np.tril_indices(groups.shape[1])
    ends = np.sort(np.stack([groups[:, low].ravel(), groups[:, high].ravel()]), axis=0)
    keys = np.unique(ends[0] * count + ends[1])
    column, row = np.divmod(keys, count)
    pointer = np.searchsorted(column, np.arange(count + 1))
    total = np.concatenate([[0], np.cumsum(size[row])])
    above = total[:-1] - total[pointer[column]]
    height = total[pointer[1:]] - total[pointer[:-1]]
    first = np.concatenate([[0], np.cumsum(size)])
    # column b of a group of s freedoms holds the panel's rows from b on
    panel_rows = np.repeat(first[row], size[row]) + _count_up(size[row])
    owner = np.repeat(np.arange(count), size)
    within = _count_up(size)
    length = height[owner] - within
    indptr = np.concatenate([[0], np.cumsum(length)])
    begin = total[pointer[:-1]][owner] + within
    shift = np.repeat(begin - indptr[:-1], length)
    shift += np.arange(len(shift))
    indices = panel_rows[shift]
    return _GroupColumns(indptr, indices, keys, above, indptr[first[:-1]], height)


def _packed_places(dofs, offset, groups, local_group, columns: _GroupColumns) -> np.ndarray:
    """Return the place of every packed entry (E, d(d+1)/2) among the nonzeros."""
    width, none = dofs.shape[1], len(columns.indices)
    members = [np.flatnonzero(local_group == k) for k in range(groups.shape[1])]
    kind = np.int32 if none < np.iinfo(np.int32).max else np.int64
    put = np.empty((len(dofs), width * (width + 1) // 2), dtype=kind)

    def fill(part: slice) -> None:
        """Put in the places of some elements."""
        own = put[part]
        for place, i, j in _list_places(dofs[part], offset, groups[part], members, columns):
            i, j = np.maximum(i, j), np.minimum(i, j)
            own[:, i * (i + 1) // 2 + j] = np.where(place < 0, none, place)

    list(run_parts(fill, divide_rows(len(dofs), len(columns.indptr), PLACED)))
    return put


def _list_places(dofs, offset, groups, members, columns: _GroupColumns):
    """Yield for each pair of groups the places (E, k) of its entries, and their freedoms (k,)."""
    for a, rows in enumerate(members):
        for b, others in enumerate(members[: a + 1]):
            one, two = groups[:, a], groups[:, b]
            first, second = offset[dofs[:, rows]], offset[dofs[:, others]]
            column = np.minimum(one, two)
            found = np.searchsorted(columns.keys, column * len(columns.height) + one + two - column)
            base = columns.start[column] + columns.above[found]
            tall = columns.height[column, None]
            if a == b:
                i, j = np.tril_indices(len(rows))
                low, high = first[:, i], first[:, j]
                place = _column_start(np.minimum(low, high), tall) + np.maximum(low, high)
                place += base[:, None]
                yield place, rows[i], rows[j]
            else:
                later = (one > two)[:, None]
                first = np.where(later, first, _column_start(first, tall)) + base[:, None]
                second = np.where(later, _column_start(second, tall), second)
                place = (first[:, :, None] + second[:, None, :]).reshape(len(dofs), -1)
                yield place, np.repeat(rows, len(others)), np.tile(others, len(rows))


def _column_start(offset: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Return where row 0 of each column of a panel would stand."""
    return np.where(offset < 0, HELD, offset * height - offset * (offset + 1) // 2)


def _count_up(lengths: np.ndarray) -> np.ndarray:
    """Return 0 .. n-1 for each n, one after the other."""
    total = np.cumsum(lengths)
    return np.arange(total[-1] if len(total) else 0) - np.repeat(total - lengths, lengths)
