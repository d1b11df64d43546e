"""A sketch of a design with dimensions: plan and elevation, supports, governing places, as SVG."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from foldshell.report.markup import render
from foldshell.results.design_view import DesignView

WIDTH, PLAN, GAP, MARGIN = 690, 400, 46, 60
"""Of the SVG, of the plan's longer side, between plan and elevation, around them; its units."""
BARS = (1, 2, 5, 10, 20, 50, 100)
"""Lengths that a scale bar may have, m."""


@dataclass(frozen=True)
class Mark:
    """A governing place (3,) m, the letter that stands there, and what it means."""

    letter: str
    words: str
    place: Sequence[float]


@dataclass(frozen=True)
class Frame:
    """Where a drawing stands: `origin` in units of the SVG is the place of `low` in m."""

    origin: tuple[float, float]
    low: tuple[float, float]
    scale: float

    def place(self, points: np.ndarray) -> np.ndarray:
        """Return points (..., 2) m in units of the SVG, y down."""
        x = self.origin[0] + self.scale * (points[..., 0] - self.low[0])
        y = self.origin[1] - self.scale * (points[..., 1] - self.low[1])
        return np.stack([x, y], axis=-1).round(1)


def draw_sketch(view: DesignView, marks: Sequence[Mark] = ()) -> Markup:
    """Return plan and elevation to one scale, with extents, scale bar and a key to the edges."""
    nodes = view.state.cells.nodes
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    size = high - low
    scale = PLAN / max(size[0], size[1])
    plan = Frame((MARGIN, MARGIN / 2 + scale * size[1]), (low[0], low[1]), scale)
    base = plan.origin[1] + GAP + scale * size[2]
    side = Frame((MARGIN, base), (low[0], low[2]), scale)
    bar = max((length for length in BARS if length <= size[0] / 3), default=BARS[0])
    return render(
        "sketch.svg",
        width=WIDTH,
        height=round(base + 46, 1),
        plan=_draw_edges(view, plan, (0, 1)),
        side=_draw_edges(view, side, (0, 2)),
        edges=_find_edges(view, plan),
        marks=[(mark, *plan.place(np.array(mark.place)[:2]).tolist()) for mark in marks],
        left=MARGIN,
        right=round(MARGIN + scale * size[0], 1),
        top=round(MARGIN / 2, 1),
        middle=round(plan.origin[1], 1),
        base=round(base, 1),
        crown=round(base - scale * size[2], 1),
        extents=[f"{value:.2f} m" for value in size],
        bar=(bar, round(bar * scale, 1)),
    )


def _draw_edges(view: DesignView, frame: Frame, axes: tuple[int, int]) -> dict[str, str]:
    """Return an SVG path of each kind of crease, seen along the third axis."""
    nodes = view.state.cells.nodes[:, axes]
    creases = view.creases
    kinds = {name: getattr(creases, name) for name in ("flat", "valley", "mountain", "border")}
    return {name: _write_path(frame.place(nodes[lines][:, [0, -1]]))
            for name, lines in kinds.items() if len(lines)}  # fmt: skip


def _write_path(lines: np.ndarray) -> str:
    """Return segments (K, 2, 2) as an SVG path."""
    return "".join(f"M{a:g} {b:g}L{c:g} {d:g}" for a, b, c, d in lines.reshape(-1, 4).tolist())


def _find_edges(view: DesignView, frame: Frame) -> Mapping[str, tuple[str, bool]]:
    """Return the border polylines in plan as SVG paths, and whether they are supported."""
    folded, vertices = view.state.folded, view.state.shell.vertices
    held = {tuple(sorted(pair)) for pair in view.state.shell.support_pairs.tolist()}
    if folded.zigzag is None:
        return _find_border(view, frame, held)
    found = {}
    for kind in ("zigzag", "strip"):
        index = getattr(folded, kind)
        other = folded.strip if kind == "zigzag" else folded.zigzag
        paths, supported = [], False
        for border in (index.min(), index.max()):
            line = np.flatnonzero(index == border)
            line = line[np.argsort(other[line])]
            pairs = np.stack([line[:-1], line[1:]], axis=1)
            supported |= all(tuple(sorted(pair)) in held for pair in pairs.tolist())
            paths.append(_write_path(frame.place(vertices[pairs][:, :, :2])))
        found[kind] = ("".join(paths), supported)
    return found


def _find_border(
    view: DesignView, frame: Frame, held: set[tuple[int, int]]
) -> Mapping[str, tuple[str, bool]]:
    """The border of a sheet that is no grid, what is supported of it apart from what is not."""
    folded, vertices = view.state.folded, view.state.shell.vertices
    border = folded.edges[folded.edge_kind == 0]
    on = np.array([tuple(sorted(pair)) in held for pair in border.tolist()], dtype=bool)
    return {
        kind: (_write_path(frame.place(vertices[border[chosen]][:, :, :2])), supported)
        for kind, chosen, supported in (("held", on, True), ("free", ~on, False))
        if chosen.any()
    }
