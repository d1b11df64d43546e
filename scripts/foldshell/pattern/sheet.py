"""A sheet to be folded: flat state, rest state, and the frames of its folding path."""

import math
from dataclasses import dataclass, field

import numpy as np

from foldshell.pattern.grid import Grid
from foldshell.pattern.miura import Miura, flat_vertices, folded_vertices, rest_fold_angle

FRAMES = 9
"""States of the folding path that files and animations have."""


@dataclass(frozen=True)
class Frame:
    """One folded state: name and vertices (V, 3) [m]."""

    title: str
    vertices: np.ndarray


@dataclass(frozen=True)
class Sheet:
    """A crease grid with its flat state and the rest state that folding starts from.

    `kind` is miura, a derivative's name, smooth or flat; `settings` is plain data to record.
    `unrolled` is a rest state without its curvature, when it has any: x and y become arc
    lengths on the target, z the distance from it.
    """

    kind: str
    grid: Grid
    flat: np.ndarray
    rest: np.ndarray
    path: tuple[Frame, ...] = ()
    settings: dict = field(default_factory=dict)
    unrolled: np.ndarray | None = None

    @property
    def placement(self) -> np.ndarray:
        """Coordinates (V, 3) [m] by which the sheet is laid on a target."""
        return self.rest if self.unrolled is None else self.unrolled


def make_miura_sheet(
    pattern: Miura, frames: int = FRAMES, poisson: float = -1.0, widths: np.ndarray | None = None
) -> Sheet:
    """Standard Miura sheet with `frames` states of its path, flat to nearly folded flat.

    Its rest state is that whose in-plane Poisson's ratio is `poisson`; `widths` (strip_count - 1,)
    are its strips' widths over `side_b`, all 1 unless given.
    """
    rest = rest_fold_angle(pattern.sector_angle, poisson)
    angles = np.linspace(0, math.pi / 2, frames + 1)[:-1] if frames else []
    path = tuple(
        Frame(f"folded {math.degrees(angle):.1f} deg", folded_vertices(pattern, angle, widths))
        for angle in angles
    )
    return Sheet(
        kind="miura",
        grid=pattern.grid,
        flat=flat_vertices(pattern, widths),
        rest=folded_vertices(pattern, rest, widths),
        path=path,
        settings={
            "side_a_m": pattern.side_a,
            "side_b_m": pattern.side_b,
            "sector_angle_deg": math.degrees(pattern.sector_angle),
            "rest_fold_angle_deg": math.degrees(rest),
        },
    )
