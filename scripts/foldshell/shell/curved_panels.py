"""A smooth shell in finer facets: each panel as quads whose corners lie on the surface itself."""

from collections.abc import Mapping

import numpy as np

PARTS = 3
"""Quads along the side of a smooth panel. One flat quad a panel makes a shallow dome of 14 x 15
panels a third too soft; with three quads of half the subdivisions the displacement is within 1.5 %
of six."""


def is_curved(folded: Mapping[str, np.ndarray]) -> bool:
    """Tell whether folded.npz holds points of a smooth surface between its vertices."""
    return folded.get("surface") is not None


def divide_subdivisions(subdivisions: int) -> int:
    """Return the subdivisions of each of the finer facets: half of what flat facets get."""
    return max(1, subdivisions // 2)


def refine_panels(folded: Mapping[str, np.ndarray], parts: int) -> dict[str, np.ndarray]:
    """Return the arrays of folded.npz with `parts` x `parts` quads a panel, two facets each.

    Vertices of the panels keep their numbers, the others follow. Panels keep theirs in
    `facet_panel`; zig-zag and strip of a vertex between two lines are fractions. Raises
    `ValueError` for parts that the points of the surface do not have.
    """
    points = folded["surface"]
    rows, columns = int(folded["zigzag"].max()), int(folded["strip"].max())
    steps = (len(points) - 1) // rows
    if steps % parts:
        raise ValueError(f"{parts} parts: a divisor of {steps} is allowed")
    points = points[:: steps // parts, :: steps // parts]
    number = _number_points(folded, points.shape[:2], parts)
    vertices = np.empty((number.size, 3))
    vertices[number] = points
    lines = np.empty((2, number.size))
    lines[:, number] = np.stack(np.indices(number.shape)) / parts
    facets = _divide_facets(folded, number, parts)
    return {
        **folded,
        "vertices": vertices,
        "facets": facets.reshape(-1, 3),
        "facet_panel": np.repeat(np.arange(rows * columns), 2 * parts**2),
        "zigzag": lines[0],
        "strip": lines[1],
    }


def _number_points(folded, shape: tuple[int, int], parts: int) -> np.ndarray:
    """Return the number (Y, K) of each point, those of the panels' vertices first."""
    count = len(folded["vertices"])
    number = np.full(shape, -1)
    number[parts * folded["zigzag"], parts * folded["strip"]] = np.arange(count)
    others = number < 0
    number[others] = count + np.arange(int(others.sum()))
    return number


def _divide_facets(folded, number: np.ndarray, parts: int) -> np.ndarray:
    """Return the facets (P, parts^2, 2, 3): each quad cut as its panel is."""
    facets = folded["facets"].reshape(-1, 2, 3)
    place = np.stack([folded["zigzag"][facets], folded["strip"][facets]], axis=-1)
    first = place.min(axis=(1, 2), keepdims=True)
    quad = np.stack(np.indices((parts, parts)), axis=-1).reshape(1, -1, 1, 1, 2)
    at = parts * first[:, None] + quad + (place - first)[:, None]
    return number[at[..., 0], at[..., 1]]
