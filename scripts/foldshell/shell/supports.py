"""Supported edges of a folded sheet: pins on the border polylines of zig-zags or strips."""

from dataclasses import dataclass

import numpy as np

from foldshell.shell.mesh import ShellMesh, edge_polyline_nodes


@dataclass(frozen=True)
class Support:
    """Where a sheet is held, and how.

    Attributes
    ----------
    name : word of the table of designs
    where : families whose first and last polyline are held: "zigzag", "strip"
    fix : global directions in which their nodes are held
    """

    name: str
    where: tuple[str, ...]
    fix: tuple[str, ...] = ("x", "y", "z")


SUPPORT_SETS = {
    support.name: support
    for support in (
        Support("all", ("zigzag", "strip")),
        Support("zigzag", ("zigzag",)),
        Support("strip", ("strip",)),
    )
}
"""The three supports of the paper, by name."""


def find_support(name: str) -> Support:
    """Return a support by its name; raises `ValueError` for another word."""
    if name not in SUPPORT_SETS:
        raise ValueError(f"support {name!r}: allowed are {', '.join(SUPPORT_SETS)}")
    return SUPPORT_SETS[name]


BORDERS = (
    "first zig-zag edge", "last zig-zag edge", "first strip edge", "last strip edge", "border",
)  # fmt: skip
"""Names of the border polylines, each a supported edge of its own where it is held; the last one is
all of the border of a sheet that has no zig-zags and strips."""
WHOLE_BORDER = len(BORDERS) - 1


def supported_pairs(
    pairs: np.ndarray, zigzag_index: np.ndarray, strip_index: np.ndarray, support: Support
) -> np.ndarray:
    """Return those facet edges (K, 2) that lie on supported border polylines.

    Parameters
    ----------
    pairs : (C, 2) vertex numbers of all facet edges
    zigzag_index, strip_index : (V,) polylines that the vertices lie on
    support : holds the first and the last polyline of each family that it names
    """
    border = find_borders(pairs, zigzag_index, strip_index)
    families = np.repeat(["zigzag", "strip"], 2)
    return pairs[np.isin(border, np.flatnonzero(np.isin(families, support.where)))]


def find_borders(
    pairs: np.ndarray, zigzag_index: np.ndarray, strip_index: np.ndarray
) -> np.ndarray:
    """Return the border on which each facet edge (K, 2) lies: (K,) into BORDERS, -1 for none.

    Parameters
    ----------
    pairs : (K, 2) vertex numbers
    zigzag_index, strip_index : (V,) polylines that the vertices lie on
    """
    border = np.full(len(pairs), -1)
    families = (zigzag_index, strip_index)
    lines = [(index, end) for index in families for end in (index.min(), index.max())]
    for number, (index, end) in enumerate(lines):
        border[(index[pairs] == end).all(axis=1)] = number
    return border


def share_supported_nodes(
    mesh: ShellMesh, pairs: np.ndarray, border: np.ndarray, supported: np.ndarray
) -> dict[str, np.ndarray]:
    """Return how much of the reaction of each supported node counts for each border.

    A node at a corner, where two borders meet, counts by half for each: the shares of all borders
    sum to one, and the reactions of all borders to those of the shell.

    Parameters
    ----------
    pairs : (K, 2) supported facet edges as vertices
    border : (K,) the border of each, into BORDERS
    supported : (S,) supported mesh nodes

    Returns
    -------
    {name of BORDERS: (S,)}
    """
    on = {
        BORDERS[number]: np.isin(supported, edge_polyline_nodes(mesh, pairs[border == number]))
        for number in np.unique(border)
    }
    count = np.maximum(sum(held.astype(int) for held in on.values()), 1)
    return {name: held / count for name, held in on.items()}
