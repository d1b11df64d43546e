"""Sums of element values at nodes.

Done with numpy alone: importing `scipy.sparse` would take a third of the time of a small analysis.
Values of a node stand beside each other, so that rows are copied whole.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from foldshell.shell.mesh import ShellMesh


class NodeSum:
    """The order in which element values are added up at nodes, found once for a mesh.

    The first value of every node is gathered, the second one added where there is one, and so on:
    most nodes lie within one element or between two.
    """

    def __init__(self, elements: np.ndarray, count: int) -> None:
        flat = elements.ravel()
        order = np.argsort(flat, kind="stable")
        used, begin, times = np.unique(flat[order], return_index=True, return_counts=True)
        self._count, self._used, self._rounds = count, used, []
        for number in range(int(times.max()) if len(times) else 0):
            more = np.flatnonzero(times > number)
            self._rounds.append((more, order[begin[more] + number]))

    def add(self, values: np.ndarray) -> np.ndarray:
        """Sum element values (E n, k) at the nodes in the order of the elements, (N, k).

        Any unit.
        """
        (_, first), *later = self._rounds
        total = values[first]
        for place, rows in later:
            total[place] += values[rows]
        if len(total) == self._count:
            return total
        whole = np.zeros((self._count, values.shape[1]))
        whole[self._used] = total
        return whole


def gather_forces(mesh: ShellMesh, element: np.ndarray) -> np.ndarray:
    """Sum element node forces (E, n, 3, c) into global ones (dofs, c). kN."""
    columns = element.shape[3]
    total = np.zeros((mesh.dof_count, columns))
    summed = mesh.node_sum.add(element.reshape(-1, 3 * columns))
    total[: 3 * len(mesh.nodes)] = summed.reshape(-1, columns)
    return total
