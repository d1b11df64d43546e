"""Pictures of how a design carries: principal stress lines, utilization isolines, buckling mode."""

from dataclasses import replace

import numpy as np

from foldshell.figures.camera import look_at
from foldshell.figures.figure_specs import (
    FigureSpec,
    crease_lines,
    describe_verdict,
    lines_before,
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
from foldshell.results.principal_stress_lines import split_lines

PAPER = (240, 240, 236)
WIDTHS = ((0.04, 1.5), (0.2, 3.0), (0.5, 5.0))
"""Least share of the large forces, and width in pixels of the lines from there on."""
LARGE_PERCENTILE = 95.0
FORCE_MIN = 1e-6
"""Membrane forces below this, kN/m, are rounding errors."""
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
    order = "" if state.report.get("state") in ("ok", None) else "first-order "
    facts = f"trajectories of the principal {order}membrane forces of {name}, across the folds"
    bounds = ", ".join(f"{share * large:.0f}" for share, _ in WIDTHS)
    classes = f"Thin, medium, thick lines: more than {bounds} kN/m. Weaker forces are left out."
    lines = _by_force(segments, force, large)
    return _specify_lines(view, "Principal stress lines", facts, classes, lines, keys)


def _by_force(segments: np.ndarray, force: np.ndarray, large: float) -> list[Lines]:
    lines = []
    bounds = [share for share, _ in WIDTHS] + [np.inf]
    for colour, sign in ((COMPRESSION, -1), (TENSION, 1)):
        for (share, width), end in zip(WIDTHS, bounds[1:], strict=True):
            chosen = (sign * force >= share * large) & (sign * force < end * large)
            lines.append(Lines(segments[chosen], colour, width))
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
    quantity = f"utilization [-], a line each {highest / len(found):.3g}"
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
        make_scale(np.array([0.0, 1.0]), "cividis"),
        points=state.cells.nodes + MODE_SHARE * view.span * mode, extra=(before,),
        keys=(Key("solid", "undisplaced", before.colour),),
    )  # fmt: skip
    return replace(spec, direction=look_at(state.cells.nodes, state.cells.nodes[values.argmax()]))


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
    keys = [*keys, Key("support", "pinned edges", INK)]
    return FigureSpec(scene, Caption(f"{title}: {state.name}", words, classes, keys=keys))
