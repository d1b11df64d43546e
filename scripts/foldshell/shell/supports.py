"""Supported edges of a folded sheet: pins on the border polylines of zig-zags or strips."""

import numpy as np

SUPPORTS = ("all", "zigzag", "strip")


def supported_pairs(
    pairs: np.ndarray, zigzag_index: np.ndarray, strip_index: np.ndarray, support: str
) -> np.ndarray:
    """Return those facet edges (K, 2) that lie on supported border polylines.

    Parameters
    ----------
    pairs : (C, 2) vertex numbers of all facet edges
    zigzag_index, strip_index : (V,) polylines that the vertices lie on
    support : "zigzag" pins the first and last zig-zag, "strip" those strips, "all" all four

    Raises
    ------
    ValueError
        for another word.
    """
    if support not in SUPPORTS:
        raise ValueError(f"support {support!r}: allowed are {', '.join(SUPPORTS)}")
    chosen = np.zeros(len(pairs), dtype=bool)
    for name, index in (("zigzag", zigzag_index), ("strip", strip_index)):
        if support in (name, "all"):
            ends = index[pairs]
            for border in (index.min(), index.max()):
                chosen |= (ends == border).all(axis=1)
    return pairs[chosen]
