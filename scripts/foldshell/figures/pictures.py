"""The pictures of one design (Fig. 7 of Tsiamis et al. 2018): what each shows and says."""

from collections.abc import Callable, Sequence

import numpy as np
from PIL import Image

from foldshell.figures.camera import Camera, fit_camera
from foldshell.figures.colours import ABOVE, make_limit_scale, make_scale, round_step
from foldshell.figures.drafts import (
    DENSE,
    Draft,
    Subject,
    draft_field,
    draft_nothing,
    lines_before,
)
from foldshell.figures.fields import choose_deflection
from foldshell.figures.flow_pictures import draft_buckling, draft_force_lines, draft_isolines
from foldshell.figures.isolines import find_region_border
from foldshell.figures.layout import INK, Key, compose, view_size
from foldshell.figures.render import render_scenes
from foldshell.figures.scene import LIFT, Lines
from foldshell.figures.state import DesignState

DISPLACED_SHARE = 0.06
"""The largest displacement is drawn about this share of the span long."""

LIMIT_WIDTH = 3.5
"""Width of the line about cells above the limit, so that they show in grey too, pixels."""
RATIO_RANGE_MIN = 0.01
"""Least range of the colours of planarity and strain, %."""


def draw_design(
    subject: Subject, size: tuple[int, int], names: Sequence[str]
) -> dict[str, Image.Image]:
    """Return the named pictures (`PICTURES`) of a design, each of the given size in pixels."""
    drafts = {name: PICTURES[name](subject) for name in names}
    view = view_size(size)
    cameras = [_aim(draft, view) for draft in drafts.values()]
    images = render_scenes([draft.scene for draft in drafts.values()], cameras, view)
    return {
        name: compose(image, draft.caption, camera.axes()[:2].T, size)
        for (name, draft), image, camera in zip(drafts.items(), images, cameras, strict=True)
    }


def _aim(draft: Draft, view: tuple[int, int]) -> Camera:
    scene = draft.scene
    points = [scene.points, *(lines.points.reshape(-1, 3) for lines in scene.lines)]
    if scene.supports is not None:
        points.append(scene.supports - (0, 0, scene.support_size))
    return fit_camera(np.concatenate(points), view[0] / view[1], draft.direction)


def draft_thickness(subject: Subject) -> Draft:
    """Panels coloured by thickness."""
    state = subject.state
    values, panels = 1e3 * state.panel_thickness, 1e3 * state.final["thickness"]
    scale = make_scale(values, "YlGnBu")
    volume, area = state.report["volume_m3"], state.report["area_m2"]
    least, most = (f"{value:.0f}" for value in (panels.min(), panels.max()))
    facts = (
        f"{least if least == most else f'{least} to {most}'} mm{_describe_strips(state)}; "
        f"volume {volume:.4g} m³, {1e3 * volume / area:.0f} mm on average"
    )
    return draft_field(
        subject, "Thickness", facts, "thickness [mm]", values[state.cell_panel], scale
    )


def _describe_strips(state: DesignState) -> str:
    """Return the thickness of the edge beam in words, nothing where there is none."""
    strips = 1e3 * state.strip_thickness
    return f", edge beam {strips.max():.0f} mm" if len(strips) else ""


def draft_classes(subject: Subject) -> Draft:
    """Panels coloured by the thickness of their class, on the scale of the picture thickness."""
    state = subject.state
    if not state.classes:
        return draft_nothing(subject, "Thickness classes", "no thickness classes")
    number = state.classes["panel_class"]
    panels = 1e3 * state.classes["thickness"]
    words = [
        f"{k}: {panels[number == k].max():.1f} mm in {(number == k).sum()} panels"
        for k in np.unique(number)
    ]
    values = np.append(panels, 1e3 * state.strip_thickness)
    scale = make_scale(np.append(values, 1e3 * state.final["thickness"]), "YlGnBu")
    title, quantity = "Thickness classes", "thickness of the class [mm]"
    return draft_field(subject, title, "; ".join(words), quantity, values[state.cell_panel], scale)


def draft_utilization(subject: Subject) -> Draft:
    """Cells coloured by their largest utilization; what is above the limit stands out."""
    state, limit = subject.state, subject.limits.utilization_max
    values = state.utilization
    if values is None:
        return draft_nothing(subject, "Utilization", "no utilization")
    scale = make_limit_scale(values, limit)
    report = state.report
    facts = (
        f"panel mean at most {report['utilization_panel_mean_max']:.2f}; pointwise 99 % of the "
        f"area at most {report['utilization_p99']:.2f}, mean {report['utilization_mean']:.2f}"
    )
    if len(state.strip_thickness):
        facts += f"; edge beam at most {report['edge_beam_utilization_max']:.2f}"
    words = f"utilization [-], largest of {state.strength[0]} to {state.strength[-1]}"
    if scale.limit is None:
        words += f" ({limit:g} is not reached)"
    above = f"to {values.max():.2f}" if values.max() > limit else "none"
    width = LIMIT_WIDTH * min(1.0, DENSE / len(state.final["thickness"]))
    border = state.cells.nodes[find_region_border(state.triangles, values > limit)]
    return draft_field(
        subject, "Utilization", facts, words, values, scale, above,
        extra=(Lines(border, INK, width, 1.2 * LIFT),),
        keys=(Key("area", f"above {limit:g}, outlined", ABOVE),) if len(border) else (),
    )  # fmt: skip


def draft_displacement(subject: Subject) -> Draft:
    """The displaced sheet, coloured by downward displacement, over its undisplaced creases."""
    state = subject.state
    if not state.usable:
        return draft_nothing(subject, "Displacement", "no displacement")
    name = choose_deflection(state)
    moved = state.displacement_at_nodes(name)
    factor = exaggeration(moved, subject.span)
    down = -1e3 * moved[:, 2]
    limit = 1e3 * subject.span / subject.limits.displacement_limit_span_over
    order = "" if state.report.get("state") in ("ok", None) else "first order, "
    facts = (
        f"{name}: {order}at most {down.max():.1f} mm down (limit {limit:.1f} mm); "
        f"drawn {factor:g} times as large"
    )
    quantity = "vertical displacement, down [mm]"
    before = lines_before(subject)
    return draft_field(
        subject, "Displacement", facts, quantity, down, make_scale(down, "cividis"),
        points=state.cells.nodes + factor * moved, extra=(before,),
        keys=(Key("solid", "undisplaced", before.colour),),
    )  # fmt: skip


def draft_planarity(subject: Subject) -> Draft:
    """Panels coloured by the distance between their diagonals (Fig. 9)."""
    state = subject.state
    values = 100 * state.folded["planarity"]
    facts = f"at most {values.max():.2f} %, mean {values.mean():.2f} % (0: panel is planar)"
    values = np.append(values, np.zeros_like(state.strip_thickness))
    quantity = "distance of diagonals / their mean length [%]"
    scale = make_scale(values, zero=True, least=RATIO_RANGE_MIN)
    return draft_field(subject, "Planarity", facts, quantity, values[state.cell_panel], scale)


def draft_strain(subject: Subject) -> Draft:
    """Facets coloured by the largest strain of their sides in folding: what the paper must give."""
    state = subject.state
    if "strain" not in state.folded:
        return draft_nothing(subject, "Folding strain", "no strain of the folding")
    values = 100 * state.folded["strain"]
    facts = f"at most {values.max():.2f} %, mean {values.mean():.2f} % (0: sides keep their length)"
    values = np.append(values, np.zeros(2 * len(state.strip_thickness)))
    quantity = "largest change of a facet's sides / flat length [%]"
    scale = make_scale(values, "cividis", zero=True, least=RATIO_RANGE_MIN)
    cells = np.repeat(values[state.mesh.facet], state.cells.order**2)
    return draft_field(subject, "Folding strain", facts, quantity, cells, scale)


def exaggeration(moved: np.ndarray, span: float) -> float:
    """Return a round factor that draws the largest of (N, 3) m at about 6 % of the span."""
    largest = float(np.linalg.norm(moved, axis=1).max())
    return round_step(DISPLACED_SHARE * span / largest) if largest > 0 else 1.0


PICTURES: dict[str, Callable[[Subject], Draft]] = {
    "thickness": draft_thickness,
    "classes": draft_classes,
    "utilization": draft_utilization,
    "displacement": draft_displacement,
    "planarity": draft_planarity,
    "strain": draft_strain,
    "force_lines": draft_force_lines,
    "isolines": draft_isolines,
    "buckling": draft_buckling,
}
