"""What every picture of a design is made of: surface, creases, supports, words."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from foldshell.figures.camera import STANDARD_DIRECTION
from foldshell.figures.layout import INK, SOFT, Caption, Key
from foldshell.figures.scene import Lines, Scene
from foldshell.results.colour_scales import MISSING, ColourScale
from foldshell.results.creases import cut_dashes
from foldshell.results.design_view import DesignView, count_analyses

DENSE = 350
"""Sheets of more panels get thinner lines, and fewer."""


@dataclass(frozen=True)
class FigureSpec:
    """A scene with its words, before it is rendered; `direction` is that towards the eye."""

    scene: Scene
    caption: Caption
    direction: tuple[float, float, float] = STANDARD_DIRECTION


def specify_field(
    view: DesignView,
    title: str,
    facts: str,
    quantity: str,
    values: np.ndarray,
    scale: ColourScale,
    above: str = "",
    points: np.ndarray | None = None,
    extra: tuple[Lines, ...] = (),
    keys: tuple[Key, ...] = (),
) -> FigureSpec:
    """Return the sheet coloured by values of its cells (C,) or nodes (N,).

    Values keep the unit of their scale; points (N, 3) m.
    """
    state = view.state
    points = state.cells.nodes if points is None else points
    lines, line_keys = crease_lines(view, points)
    scene = Scene(
        points, state.triangles, scale.colour(values), (*lines, *extra),
        *support_marks(view),
    )  # fmt: skip
    all_keys = (*line_keys, *keys, Key("support", "pinned edges"))
    words = (facts, describe_verdict(state.report))
    return FigureSpec(
        scene, Caption(f"{title}: {state.name}", words, quantity, scale, above, all_keys)
    )


def specify_nothing(view: DesignView, title: str, words: str) -> FigureSpec:
    """Return the grey sheet with words that say what is missing."""
    state = view.state
    lines, keys = crease_lines(view, state.cells.nodes)
    colours = np.tile(np.array(MISSING, dtype=np.uint8), (len(state.triangles), 1))
    scene = Scene(state.cells.nodes, state.triangles, colours, lines, *support_marks(view))
    verdict = describe_verdict(state.report)
    keys = (*keys, Key("support", "pinned edges"))
    return FigureSpec(scene, Caption(f"{title}: {state.name}", (words, verdict), keys=keys))


def describe_verdict(report: Mapping[str, Any]) -> str:
    """Return verdict, count of analyses and reason as one line."""
    words = f"{str(report.get('verdict')).replace('_', ' ')} after {count_analyses(report)}"
    return f"{words}: {report['reason']}" if report.get("reason") else words


def crease_lines(view: DesignView, points: np.ndarray) -> tuple[tuple[Lines, ...], tuple[Key, ...]]:
    """Return mountains as lines, valleys as dashes, other panel borders thin, and their keys.

    points (V, 3) m are the sheet's vertices where they are drawn.
    """
    creases = view.creases
    dashes = cut_dashes(points[creases.valley], view.size / 90)
    width = 2.5 * min(1.0, (DENSE / len(view.state.final["thickness"])) ** 0.5)
    lines = (
        Lines(points[creases.border], INK, 0.8 * width),
        Lines(points[creases.flat], SOFT, 0.4 * width),
        Lines(points[creases.mountain], INK, width),
        Lines(dashes, INK, width),
    )
    keys = [Key("solid", "mountain crease"), Key("dashed", "valley crease")]
    if not len(creases.mountain) + len(creases.valley):
        keys = [Key("solid", "panel border", SOFT)]
    return lines, tuple(keys)


def support_marks(view: DesignView) -> tuple[np.ndarray, float]:
    """Return the vertices on supported edges (S, 3) m, and the size of their marks, m."""
    state = view.state
    vertices = np.unique(state.shell["support_pairs"])
    return state.shell["vertices"][vertices], view.size / 60


def lines_before(view: DesignView) -> Lines:
    """Return the undisplaced creases, of a dense sheet the border alone."""
    creases = view.creases
    kinds = [creases.border]
    if len(view.state.final["thickness"]) <= DENSE:
        kinds += [creases.mountain, creases.valley, creases.flat]
    return Lines(view.state.cells.nodes[np.concatenate(kinds)], (150, 150, 150), 1.5, 0.0)
