"""What every picture of a design is made of: surface, creases, supports, words."""

from dataclasses import dataclass

import numpy as np

from foldshell.figures.camera import STANDARD_DIRECTION
from foldshell.figures.layout import INK, SOFT, Caption, Key
from foldshell.figures.scene import LIFT, Lines, Scene
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.arrays import list_arrays
from foldshell.results.colour_scales import MISSING, ColourScale, round_step
from foldshell.results.creases import cut_dashes
from foldshell.results.design_view import DesignView, count_analyses
from foldshell.shell.held_supports import list_supported_vertices

DENSE = 350
"""Sheets of more panels get thinner lines, and fewer."""

ZIGZAG, STRIP = (0, 81, 138), (200, 95, 0)
"""Colours of the edges that a pattern has, as on calculation sheets."""
EDGE_WIDTH = 4.0


@dataclass(frozen=True)
class FigureSpec:
    """A scene with its words, before it is rendered.

    `direction` is that towards the eye, `marks` are places (3,) m with their words (a ring where
    the flag says so), `close_up` a place, a radius m and a direction to look at it from.
    """

    scene: Scene
    caption: Caption
    direction: tuple[float, float, float] = STANDARD_DIRECTION
    marks: tuple[tuple[np.ndarray, str, bool], ...] = ()
    close_up: tuple[np.ndarray, float, tuple[float, float, float]] | None = None


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
    all_keys = (*line_keys, *keys, Key("support", name_supports(view)))
    words = (facts, describe_verdict(state.report))
    return FigureSpec(scene, Caption(title, words, quantity, scale, above, all_keys, state.name))


def specify_nothing(view: DesignView, title: str, words: str) -> FigureSpec:
    """Return the grey sheet with words that say what is missing."""
    state = view.state
    lines, keys = crease_lines(view, state.cells.nodes)
    colours = np.tile(np.array(MISSING, dtype=np.uint8), (len(state.triangles), 1))
    scene = Scene(state.cells.nodes, state.triangles, colours, lines, *support_marks(view))
    verdict = describe_verdict(state.report)
    keys = (*keys, Key("support", name_supports(view)))
    return FigureSpec(scene, Caption(title, (words, verdict), keys=keys, name=state.name))


def describe_verdict(report: AnalysisRecord) -> str:
    """Return verdict, count of analyses and reason as one line."""
    verdict = report.verdict.replace("_", " ")
    words = f"{verdict} by the paper's criteria after {count_analyses(report)}"
    return f"{words}: {report.reason}" if report.reason else words


def crease_lines(view: DesignView, points: np.ndarray) -> tuple[tuple[Lines, ...], tuple[Key, ...]]:
    """Return mountains as lines, valleys as dashes, other panel borders thin, and their keys.

    points (V, 3) m are the sheet's vertices where they are drawn.
    """
    creases = view.creases
    dashes = cut_dashes(points[creases.valley], view.size / 90)
    width = 2.5 * min(1.0, (DENSE / len(view.state.final.thickness)) ** 0.5)
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


def name_supports(view: DesignView) -> str:
    """Return what the marks of supports stand for."""
    return "pinned edges" if view.state.shell.support_names is None else "supports"


def support_marks(view: DesignView) -> tuple[np.ndarray, float]:
    """Return the vertices on supported edges (S, 3) m, and the size of their marks, m."""
    state = view.state
    vertices = list_supported_vertices(list_arrays(state.shell))
    return state.shell.vertices[vertices], view.size / 60


def lines_before(view: DesignView) -> Lines:
    """Return the undisplaced creases, of a dense sheet the border alone."""
    creases = view.creases
    kinds = [creases.border]
    if len(view.state.final.thickness) <= DENSE:
        kinds += [creases.mountain, creases.valley, creases.flat]
    return Lines(view.state.cells.nodes[np.concatenate(kinds)], (150, 150, 150), 1.5, 0.0)


def edge_lines(view: DesignView) -> tuple[tuple[Lines, ...], tuple[Key, ...]]:
    """Return zig-zag edges and strip edges in colours of their own, wide, and their keys; of a
    sheet without them its border."""
    folded, vertices = view.state.folded, view.state.shell.vertices
    if folded.zigzag is None:
        border = vertices[folded.edges[folded.edge_kind == 0]]
        return (Lines(border, ZIGZAG, EDGE_WIDTH, 1.2 * LIFT),), (Key("solid", "border", ZIGZAG),)
    lines, keys = [], []
    for kind, other, words, colour in (("zigzag", "strip", "zig-zag edge", ZIGZAG),
                                       ("strip", "zigzag", "strip edge", STRIP)):  # fmt: skip
        index = getattr(folded, kind)
        for border in (index.min(), index.max()):
            nodes = np.flatnonzero(index == border)
            nodes = nodes[np.argsort(getattr(folded, other)[nodes])]
            lines.append(Lines(vertices[nodes][None], colour, EDGE_WIDTH, 1.2 * LIFT))
        keys.append(Key("solid", words, colour))
    return tuple(lines), tuple(keys)


def scale_bar(view: DesignView) -> tuple[Lines, tuple[np.ndarray, str, bool]]:
    """Return a bar of a round length along x, in front of the sheet at its lowest level, and the
    mark (place (3,) m, words, no ring) that says its length."""
    nodes = view.state.cells.nodes
    low, size = nodes.min(axis=0), np.ptp(nodes, axis=0)
    length = round_step(size[0] / 5)
    start = low - (0, 0.08 * size[1], 0)
    tip = 0.012 * view.size
    along, up = np.array([length, 0, 0]), np.array([0, 0, tip])
    parts = np.array([[start, start + along], [start - up, start + up],
                      [start + along - up, start + along + up]])  # fmt: skip
    return Lines(parts, INK, 4.0), (start + along, f"{length:g} m", False)
