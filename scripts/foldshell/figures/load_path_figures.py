"""Pictures of how a design carries: principal stress lines, utilization isolines, buckling mode."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from foldshell.figures.camera import look_at
from foldshell.figures.figure_specs import (
    FigureSpec,
    crease_lines,
    describe_verdict,
    lines_before,
    name_supports,
    specify_field,
    specify_nothing,
    support_marks,
)
from foldshell.figures.layout import INK, SOFT, Caption, Key
from foldshell.figures.scene import Lines, Scene
from foldshell.results.colour_scales import (
    ABOVE,
    COMPRESSION,
    TENSION,
    ColourScale,
    make_scale,
)
from foldshell.results.design_view import DesignView
from foldshell.results.fields import choose_buckling
from foldshell.results.isolines import utilization_isolines
from foldshell.results.line_spacing import split_lines

PAPER = (240, 240, 236)
FORCE_STEPS = (0.03, 0.08, 0.16, 0.3, 0.5, 0.75)
"""Shares of the large forces from which on lines are drawn one step wider."""
WIDTH_STEP = 1.3
"""Width of the thinnest lines, and how much wider each step is, pixels."""
LARGE_PERCENTILE = 95.0
FORCE_MIN = 1e-6
"""Membrane forces below this, kN/m, are rounding errors."""
CLOSE_UP = 0.09
"""Radius of what a close-up shows, as a share of the sheet's diagonal."""
MODE_SHARE = 0.05
"""A buckling mode is drawn this share of the span large."""


def specify_principal_stress_lines(view: DesignView) -> FigureSpec:
    """Trajectories of the principal membrane forces; width by force, colour by sign."""
    state = view.state
    if not state.usable:
        return specify_nothing(
            view, "Principal stress lines", "no displacement, so no membrane forces"
        )
    name, lines = view.principal_stress_lines
    segments, force = split_lines(lines)
    large = float(np.percentile(np.abs(force), LARGE_PERCENTILE)) if force.size else 0.0
    if large < FORCE_MIN:
        words = f"no membrane forces under {name}: it carries by bending alone"
        return specify_nothing(view, "Principal stress lines", words)
    keys = [Key("solid", "tension", TENSION), Key("solid", "compression", COMPRESSION)]
    order = "" if state.report.state == "ok" else "first-order "
    facts = f"trajectories of the principal {order}membrane forces of {name}, across the folds"
    least, most = (format_force(share * large) for share in (FORCE_STEPS[0], FORCE_STEPS[-1]))
    classes = f"Width by force: from {least} kN/m to {most} kN/m and more. Weaker is left out."
    lines = _by_force(segments, force, large)
    return _specify_lines(view, "Principal stress lines", facts, classes, lines, keys)


def format_force(value: float) -> str:
    """Return a force with two digits, or as a whole number."""
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


def _by_force(segments: np.ndarray, force: np.ndarray, large: float) -> list[Lines]:
    lines = []
    bounds = [*FORCE_STEPS, np.inf]
    for colour, sign in ((COMPRESSION, -1), (TENSION, 1)):
        for step, (low, high) in enumerate(pairwise(bounds), start=1):
            chosen = (sign * force >= low * large) & (sign * force < high * large)
            lines.append(Lines(segments[chosen], colour, WIDTH_STEP * step))
    return lines


def specify_isolines(view: DesignView) -> FigureSpec:
    """Lines of equal utilization; that of the limit is thick and red."""
    state, limit = view.state, view.sizing.utilization_max
    if state.utilization is None:
        return specify_nothing(view, "Utilization isolines", "no utilization")
    found = utilization_isolines(view)
    highest = found[-1][0]
    scale = ColourScale(0.0, highest, limit=limit if highest == limit else None)
    lines = []
    for level, segments in found:
        at_limit = level == limit
        colour = ABOVE if at_limit else tuple(scale.colour(level).tolist())
        lines.append(Lines(segments, colour, 4.5 if at_limit else 2.5))
    words = f"largest of {state.strength[0]} to {state.strength[-1]}, means at the nodes of a panel"
    keys = [Key("solid", f"utilization {limit:g}", ABOVE)] if highest == limit else []
    spec = _specify_lines(view, "Utilization isolines", words, "", lines, keys)
    quantity = f"utilization of cells [-], a line each {highest / len(found):.3g}"
    above = "above" if highest == limit else ""
    return replace(spec, caption=replace(spec.caption, quantity=quantity, scale=scale, above=above))


def specify_buckling(view: DesignView) -> FigureSpec:
    """The buckling mode of the least factor, drawn large."""
    state = view.state
    least = choose_buckling(state)
    if least is None:
        return specify_nothing(view, "Buckling mode", "no buckling mode")
    name, factor = least
    mode = state.buckling_mode(name)
    before = lines_before(view)
    facts = f"{name}: buckling factor {factor:.2f}; the size of the mode is arbitrary"
    values = np.linalg.norm(mode, axis=1)
    spec = specify_field(
        view, "Buckling mode", facts, "translation / largest [-]", values,
        make_scale(np.array([0.0, 1.0]), "YlGnBu"),
        points=state.cells.nodes + MODE_SHARE * view.span * mode, extra=(before,),
        keys=(Key("solid", "undisplaced", before.colour),),
    )  # fmt: skip
    place = state.cells.nodes[values.argmax()]
    direction = look_at(state.cells.nodes, place)
    close_up = place, CLOSE_UP * view.size, face_panel(view, int(values.argmax()), direction)
    return replace(spec, direction=direction, close_up=close_up, marks=((place, "largest", True),))


def face_panel(
    view: DesignView, node: int, direction: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Return a direction from which the cells about a node are seen, near a given one."""
    cells = view.state.triangles[(view.state.triangles == node).any(axis=1)]
    corner = view.state.cells.nodes[cells]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    wanted = np.asarray(direction) / np.linalg.norm(direction)
    sides = np.where((normal @ wanted < 0)[:, None], -normal, normal)
    found = sides[np.argmax(sides @ wanted)] + 0.6 * wanted
    return tuple((found / np.linalg.norm(found)).tolist())


def _specify_lines(
    view: DesignView, title: str, facts: str, classes: str, lines: list[Lines], keys: list[Key]
) -> FigureSpec:
    """Return lines on a pale sheet; creases thin, so that they do not compete."""
    state = view.state
    creases, _ = crease_lines(view, state.cells.nodes)
    thin = [Lines(line.points, SOFT, 0.5 * line.width, 0.5 * line.lift) for line in creases]
    colours = np.tile(np.array(PAPER, dtype=np.uint8), (len(state.triangles), 1))
    scene = Scene(
        state.cells.nodes, state.triangles, colours, (*thin, *lines), *support_marks(view)
    )
    words = (facts, describe_verdict(state.report))
    keys = [*keys, Key("support", name_supports(view), INK)]
    return FigureSpec(scene, Caption(title, words, classes, keys=keys, name=state.name))
