"""What a renderer is given: a coloured surface, lines on it, supports."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

AMBIENT, DIFFUSE = 0.72, 0.32
"""Light from all sides, and from the eye: enough to tell facets apart, too little to mislead."""
SUPPORT_COLOUR = (64, 64, 64)
LIFT = 0.0015
"""Lines stand this share of the eye's distance in front of the surface they lie on."""


@dataclass(frozen=True)
class Lines:
    """Polylines (K, n, 3) m of one colour and width (pixels of the final image)."""

    points: np.ndarray
    colour: tuple[int, int, int]
    width: float
    lift: float = LIFT


@dataclass(frozen=True)
class Scene:
    """What is in one picture.

    Attributes
    ----------
    points, triangles : surface (N, 3) m, (C, 3)
    colours : (C, 3) or (N, 3) uint8, of the triangles or of the points
    lines : polylines
    supports : (S, 3) m, points that carry a support mark
    support_size : height of that mark, m
    """

    points: np.ndarray
    triangles: np.ndarray
    colours: np.ndarray
    lines: Sequence[Lines] = field(default_factory=tuple)
    supports: np.ndarray | None = None
    support_size: float = 0.0
