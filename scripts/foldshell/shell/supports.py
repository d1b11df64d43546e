"""Supported edges of a folded sheet: pins on the border polylines of zig-zags or strips."""

import numpy as np

SUPPORTS = ("all", "zigzag", "strip")


def supported_pairs(
    pairs: np.ndarray, zigzag: np.ndarray, strip: np.ndarray, support: str
) -> np.ndarray:
    """Return those facet edges (K, 2) that lie on supported border polylines.

    Parameters
    ----------
    pairs : (C, 2) vertex numbers of all facet edges
    zigzag, strip : (V,) polyline indices of the vertices
    support : "zigzag" pins the first and last zig-zag, "strip" those strips, "all" all four

    Raises
    ------
    ValueError
        for another word.
    """
    if support not in SUPPORTS:
        raise ValueError(f"support {support!r}: allowed are {', '.join(SUPPORTS)}")
    chosen = np.zeros(len(pairs), dtype=bool)
    for name, index in (("zigzag", zigzag), ("strip", strip)):
        if support in (name, "all"):
            ends = index[pairs]
            for border in (index.min(), index.max()):
                chosen |= (ends == border).all(axis=1)
    return pairs[chosen]
