"""The pictures of one design (Fig. 7 of Tsiamis et al. 2018): what each shows and says."""

from collections.abc import Callable, Sequence

import numpy as np
from PIL import Image

from foldshell.figures.camera import Camera, fit_camera
from foldshell.figures.figure_specs import (
    DENSE,
    FigureSpec,
    lines_before,
    specify_field,
    specify_nothing,
)
from foldshell.figures.layout import INK, Key, compose, view_size
from foldshell.figures.load_path_figures import (
    specify_buckling,
    specify_isolines,
    specify_principal_stress_lines,
)
from foldshell.figures.render import render_scenes
from foldshell.figures.scene import LIFT, Lines
from foldshell.results.colour_scales import (
    ABOVE,
    RATIO_RANGE_MIN,
    exaggeration,
    make_limit_scale,
    make_scale,
)
from foldshell.results.design_view import DesignView
from foldshell.results.fields import choose_deflection
from foldshell.results.isolines import find_region_border
from foldshell.results.state import DesignState

LIMIT_WIDTH = 3.5
"""Width of the line about cells above the limit, so that they show in grey too, pixels."""


def draw_design(
    view: DesignView, size: tuple[int, int], names: Sequence[str]
) -> dict[str, Image.Image]:
    """Return the named pictures (`PICTURES`) of a design, each of the given size in pixels."""
    specs = {name: PICTURES[name](view) for name in names}
    frame = view_size(size)
    cameras = [_aim(spec, frame) for spec in specs.values()]
    images = render_scenes([spec.scene for spec in specs.values()], cameras, frame)
    return {
        name: compose(image, spec.caption, camera.axes()[:2].T, size)
        for (name, spec), image, camera in zip(specs.items(), images, cameras, strict=True)
    }


def _aim(spec: FigureSpec, frame: tuple[int, int]) -> Camera:
    scene = spec.scene
    points = [scene.points, *(lines.points.reshape(-1, 3) for lines in scene.lines)]
    if scene.supports is not None:
        points.append(scene.supports - (0, 0, scene.support_size))
    return fit_camera(np.concatenate(points), frame[0] / frame[1], spec.direction)


def specify_thickness(view: DesignView) -> FigureSpec:
    """Panels coloured by thickness."""
    state = view.state
    values, panels = 1e3 * state.panel_thickness, 1e3 * state.final["thickness"]
    scale = make_scale(values, "YlGnBu")
    volume, area = state.report["volume_m3"], state.report["area_m2"]
    least, most = (f"{value:.0f}" for value in (panels.min(), panels.max()))
    facts = (
        f"{least if least == most else f'{least} to {most}'} mm{_describe_edge_beam(state)}; "
        f"volume {volume:.4g} m³, {1e3 * volume / area:.0f} mm on average"
    )
    return specify_field(
        view, "Thickness", facts, "thickness [mm]", values[state.cell_panel], scale
    )


def _describe_edge_beam(state: DesignState) -> str:
    """Return the thickness of the edge beam in words, nothing where there is none."""
    edge_beam = 1e3 * state.edge_beam_thickness
    return f", edge beam {edge_beam.max():.0f} mm" if len(edge_beam) else ""


def specify_classes(view: DesignView) -> FigureSpec:
    """Panels coloured by the thickness of their class, on the scale of the picture thickness."""
    state = view.state
    if not state.classes:
        return specify_nothing(view, "Thickness classes", "no thickness classes")
    number = state.classes["panel_class"]
    panels = 1e3 * state.classes["thickness"]
    words = [
        f"{k}: {panels[number == k].max():.1f} mm in {(number == k).sum()} panels"
        for k in np.unique(number)
    ]
    values = np.append(panels, 1e3 * state.edge_beam_thickness)
    scale = make_scale(np.append(values, 1e3 * state.final["thickness"]), "YlGnBu")
    title, quantity = "Thickness classes", "thickness of the class [mm]"
    return specify_field(view, title, "; ".join(words), quantity, values[state.cell_panel], scale)


def specify_utilization(view: DesignView) -> FigureSpec:
    """Cells coloured by their largest utilization; what is above the limit stands out."""
    state, limit = view.state, view.sizing.utilization_max
    values = state.utilization
    if values is None:
        return specify_nothing(view, "Utilization", "no utilization")
    scale = make_limit_scale(values, limit)
    report = state.report
    facts = (
        f"panel mean at most {report['utilization_panel_mean_max']:.2f}; pointwise 99 % of the "
        f"area at most {report['utilization_p99']:.2f}, mean {report['utilization_mean']:.2f}"
    )
    if len(state.edge_beam_thickness):
        facts += f"; edge beam at most {report['edge_beam_utilization_max']:.2f}"
    words = f"utilization [-], largest of {state.strength[0]} to {state.strength[-1]}"
    if scale.limit is None:
        words += f" ({limit:g} is not reached)"
    above = f"to {values.max():.2f}" if values.max() > limit else "none"
    width = LIMIT_WIDTH * min(1.0, DENSE / len(state.final["thickness"]))
    border = state.cells.nodes[find_region_border(state.triangles, values > limit)]
    return specify_field(
        view, "Utilization", facts, words, values, scale, above,
        extra=(Lines(border, INK, width, 1.2 * LIFT),),
        keys=(Key("area", f"above {limit:g}, outlined", ABOVE),) if len(border) else (),
    )  # fmt: skip


def specify_displacement(view: DesignView) -> FigureSpec:
    """The displaced sheet, coloured by downward displacement, over its undisplaced creases."""
    state = view.state
    if not state.usable:
        return specify_nothing(view, "Displacement", "no displacement")
    name = choose_deflection(state)
    moved = state.displacement_at_nodes(name)
    factor = exaggeration(moved, view.span)
    down = -1e3 * moved[:, 2]
    limit = 1e3 * view.span / view.sizing.displacement_limit_span_over
    order = "" if state.report.get("state") in ("ok", None) else "first order, "
    facts = (
        f"{name}: {order}at most {down.max():.1f} mm down (limit {limit:.1f} mm); "
        f"drawn {factor:g} times as large"
    )
    quantity = "vertical displacement, down [mm]"
    before = lines_before(view)
    return specify_field(
        view, "Displacement", facts, quantity, down, make_scale(down, "cividis"),
        points=state.cells.nodes + factor * moved, extra=(before,),
        keys=(Key("solid", "undisplaced", before.colour),),
    )  # fmt: skip


def specify_planarity(view: DesignView) -> FigureSpec:
    """Panels coloured by the distance between their diagonals (Fig. 9)."""
    state = view.state
    values = 100 * state.folded["planarity"]
    facts = f"at most {values.max():.2f} %, mean {values.mean():.2f} % (0: panel is planar)"
    values = np.append(values, np.zeros_like(state.edge_beam_thickness))
    quantity = "distance of diagonals / their mean length [%]"
    scale = make_scale(values, zero=True, least=RATIO_RANGE_MIN)
    return specify_field(view, "Planarity", facts, quantity, values[state.cell_panel], scale)


def specify_strain(view: DesignView) -> FigureSpec:
    """Facets coloured by the largest strain of their sides in folding: what the paper must give."""
    state = view.state
    if "strain" not in state.folded:
        return specify_nothing(view, "Folding strain", "no strain of the folding")
    values = 100 * state.folded["strain"]
    facts = f"at most {values.max():.2f} %, mean {values.mean():.2f} % (0: sides keep their length)"
    values = np.append(values, np.zeros(2 * len(state.edge_beam_thickness)))
    quantity = "largest change of a facet's sides / flat length [%]"
    scale = make_scale(values, "cividis", zero=True, least=RATIO_RANGE_MIN)
    cells = np.repeat(values[state.mesh.facet], state.cells.order**2)
    return specify_field(view, "Folding strain", facts, quantity, cells, scale)


PICTURES: dict[str, Callable[[DesignView], FigureSpec]] = {
    "thickness": specify_thickness,
    "classes": specify_classes,
    "utilization": specify_utilization,
    "displacement": specify_displacement,
    "planarity": specify_planarity,
    "strain": specify_strain,
    "principal_stress_lines": specify_principal_stress_lines,
    "isolines": specify_isolines,
    "buckling": specify_buckling,
}
