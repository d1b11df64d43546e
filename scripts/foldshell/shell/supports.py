"""Supported edges of a folded sheet: pins on the border polylines of zig-zags or strips."""

from dataclasses import dataclass

import numpy as np


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
    chosen = np.zeros(len(pairs), dtype=bool)
    families = {"zigzag": zigzag_index, "strip": strip_index}
    for name in support.where:
        index = families[name]
        ends = index[pairs]
        for border in (index.min(), index.max()):
            chosen |= (ends == border).all(axis=1)
    return pairs[chosen]
