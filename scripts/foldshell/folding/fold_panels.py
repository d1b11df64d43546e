"""Fold panels of any kind onto a target: one interface for every mode."""

import math
import time
from dataclasses import replace

import numpy as np

from foldshell.files.units import FACTORS, WORDS
from foldshell.folding.exact_panels import name_faults, solve_net
from foldshell.folding.fold import allowed_rms, judge_shape
from foldshell.folding.isometric_panels import bend_net
from foldshell.folding.net import FoldNet, make_net
from foldshell.folding.panel_files import FoldedPanels, take_folded
from foldshell.folding.panel_path import follow_net
from foldshell.folding.panel_problem import FREE_BORDER, align_plan, find_spans
from foldshell.folding.panel_quality import measure_panel_quality
from foldshell.folding.placement import measure_rounding, place_vertices, round_as_written
from foldshell.folding.quality import measure_coverage
from foldshell.folding.shape import Shape
from foldshell.folding.soft_panels import Start, fold_net_softly, start_net
from foldshell.folding.terms import Target, measure_distances
from foldshell.pattern.panel_mesh import OBTUSE, TOO_OBTUSE, PanelMesh, measure_largest_angle
from foldshell.settings.fold import Fold

LEAST, LARGEST = 0.6, 4.0  # sizes of a flat pattern that are taken, of the target's sections
PATH_PARTS = np.linspace(0.0, 1.0, 21)
REFOLDED = 1e-10  # gap [m] between panels anywhere on a rigid path


def fold_panels(mesh: PanelMesh, target: Target | None, mode: str, settings: Fold) -> FoldedPanels:
    """Fold a crease pattern onto a target; a sheet that is folded already stays as it is.

    mode: elastic (soft springs), isometric (hard lengths), exact (true crease pattern), rigid
    (exact and rigidly foldable, of degree 4). Raises `ValueError` for a pattern of another size
    than the target.
    """
    if target is None or mesh.flat is None:
        return take_folded(mesh)
    began = time.perf_counter()
    check_size(mesh, target)
    net = make_net(mesh)
    start = start_net(net, target, settings.attract)
    shape = fold_net(net, start, target, mode, settings)
    shape = replace(shape, vertices=round_as_written(shape.vertices, target))
    distances = measure_distances(shape.vertices, target)
    folded = replace(net.mesh, flat=shape.flat, folded=shape.vertices)
    quality = measure_panel_quality(folded, net.facets, distances[start.attracted], target.sides)
    cover = 0.0  # a border that follows no side of the plan covers what it covers
    if FREE_BORDER not in mesh.sets:
        cover = measure_coverage(start.vertices, net.facets.facets, target.sides)
    limits = settings.limits
    state, reason = judge_shape(
        shape, quality, allowed_rms(limits, mode), limits.plan_coverage * cover, mode
    )
    state, reason, notes = _look_at_facets(folded, net, state, reason)
    folded = replace(folded, notes=(*folded.notes, *notes))
    residuals = dict(shape.residuals)
    if reach := target.measure_reach(shape.vertices[start.attracted]):
        residuals["beyond_border_m"] = reach
    placed = replace(folded, folded=place_vertices(shape.vertices, target))
    return FoldedPanels(
        placed, net.facets, quality, state, reason, shape.iterations,
        time.perf_counter() - began, start.attracted, distances, residuals,
    )  # fmt: skip


def _look_at_facets(
    mesh: PanelMesh, net: FoldNet, state: str, reason: str
) -> tuple[str, str, tuple[str, ...]]:
    """Return state, reason and notes with what a facet's largest angle means for the shell."""
    angles = measure_largest_angle(mesh.vertices, net.facets.facets)
    worst = int(angles.argmax())
    words = (
        f"a facet of panel {net.facets.facet_panel[worst]} has an angle of "
        f"{math.degrees(angles[worst]):.0f} deg"
    )
    if angles[worst] > TOO_OBTUSE:
        fault = f"{words}, at most {math.degrees(TOO_OBTUSE):.0f} are allowed: buckling factors "
        return "crumpled" if state == "ok" else state, f"{fault}would be far off; {reason}", ()
    return state, reason, (f"{words}: buckling factors may be off",) * bool(angles[worst] > OBTUSE)


def fold_net(net: FoldNet, start: Start, target: Target, mode: str, settings: Fold) -> Shape:
    """Fold a net from its start by one of the modes; raises `ValueError` for another one."""
    soft = fold_net_softly(net, start, target, settings)
    if mode == "elastic":
        return soft
    if mode == "isometric":
        return bend_net(net, start, soft.vertices, target, settings)
    if mode not in ("exact", "rigid"):
        raise ValueError(f"fold_mode {mode!r}: must be elastic, isometric, exact or rigid")
    return _fold_truly(net, start, soft, target, settings, mode == "rigid")


def _fold_truly(
    net: FoldNet, start: Start, soft: Shape, target: Target, settings: Fold, rigid: bool
) -> Shape:
    """Exact and rigid mode: true origami, and for rigid mode its path."""
    found = solve_net(net, start, soft.vertices, target, settings.exact, rigid)
    vertices, faults = found.solution.vertices, list(found.faults)
    residuals: dict[str, float] = {"constraint_residual": found.solution.residual}
    iterations = soft.iterations + found.iterations
    if found.unfolded is None:
        return Shape(vertices, net.flat, iterations, False, name_faults(faults, ""), residuals)
    residuals["unfold_closure_m"] = found.unfolded.closure
    if rigid:
        if any(len(sectors) != 4 for sectors in net.sectors):
            faults.append("not all vertices are of degree 4: there is no rigid path, exact has one")
        else:
            flat = found.unfolded.vertices
            path = follow_net(net, flat, vertices, PATH_PARTS, rigid=True)
            residuals |= {"path_intersections": path.cuts, "refold_closure_m": path.gap}
            if not path.gap <= REFOLDED + 1e4 * measure_rounding(target):
                faults.append(f"panels part by {path.gap:.1e} m on the folding path")
            if path.cuts:
                faults.append("the sheet cuts itself on the folding path")
    reason = name_faults(faults, found.solution.reason)
    return Shape(vertices, found.unfolded.vertices, iterations, not faults, reason, residuals)


def check_size(mesh: PanelMesh, target: Target) -> None:
    """Raise `ValueError` for a flat pattern that is no sheet for a target, with the unit that is.

    Its box is compared with the target's central sections.
    """
    size = np.ptp(align_plan(mesh.flat)[:, :2], axis=0)
    due = np.array(target.section_lengths())
    if ((size >= LEAST * due) & (size <= LARGEST * due)).all():
        return
    hint = next(
        (f"; it looks like {WORDS[unit]}" for unit, factor in FACTORS.items()
         if ((factor * size >= LEAST * due) & (factor * size <= LARGEST * due)).all()), "",
    )  # fmt: skip
    spans = find_spans(target)
    raise ValueError(
        f"pattern of {size[0]:.4g} x {size[1]:.4g} m for a surface over {spans[0]:g} x "
        f"{spans[1]:g} m, whose central sections are {due[0]:.4g} and {due[1]:.4g} m long: "
        f"{LEAST:g} to {LARGEST:g} times these is allowed{hint}"
    )
