"""The pictures of one design (Fig. 7 of Tsiamis et al. 2018): what each shows and says."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from PIL import Image

from foldshell.checks.materials import CRITERION_WORDS
from foldshell.figures.camera import Camera, fit_camera
from foldshell.figures.figure_specs import (
    DENSE,
    FigureSpec,
    edge_lines,
    lines_before,
    scale_bar,
    specify_field,
    specify_nothing,
)
from foldshell.figures.layout import INK, Key, Note, compose, view_size
from foldshell.figures.load_figures import draw_loads
from foldshell.figures.load_path_figures import (
    specify_buckling,
    specify_isolines,
    specify_principal_stress_lines,
)
from foldshell.figures.render import render_scenes
from foldshell.figures.scene import LIFT, Lines
from foldshell.records.analysis import DECIDES
from foldshell.results.colour_scales import (
    ABOVE,
    MISSING,
    RATIO_RANGE_MIN,
    ColourScale,
    exaggeration,
    make_limit_scale,
    make_scale,
)
from foldshell.results.design_view import DesignView
from foldshell.results.fields import choose_deflection
from foldshell.results.isolines import find_region_border
from foldshell.results.state import DesignState

LOADS = "loads"
"""The picture of load cases, a page of its own."""
INSET = (0.32, 0.3)
"""Size of a close-up, as shares of the picture's."""
UPWARD_MIN = 0.05
"""Share of the largest downward displacement from which on an upward one is marked too."""
LIMIT_WIDTH = 3.5
"""Width of the line about cells above the limit, so that they show in grey too, pixels."""


def draw_design(
    view: DesignView, size: tuple[int, int], names: Sequence[str]
) -> dict[str, Image.Image]:
    """Return the named pictures (`PICTURES`) of a design, each of the given size in pixels; that of
    load cases is higher where there are many."""
    specs = {name: PICTURES[name](view) for name in names if name != LOADS}
    whole, beside = view_size(size), (round((1 - INSET[0]) * size[0]), view_size(size)[1])
    frames = {name: beside if spec.close_up else whole for name, spec in specs.items()}
    cameras = {name: _aim(spec, frames[name]) for name, spec in specs.items()}
    images = {}
    for frame in (whole, beside):
        chosen = [name for name in specs if frames[name] == frame]
        scenes, eyes = [specs[name].scene for name in chosen], [cameras[name] for name in chosen]
        images |= dict(zip(chosen, render_scenes(scenes, eyes, frame), strict=True))
    insets = _draw_close_ups(specs, size)
    own = {LOADS: draw_loads(view, size)} if LOADS in names else {}
    return own | {
        name: compose(
            images[name], spec.caption, cameras[name].axes()[:2].T, size,
            _place_notes(spec, cameras[name], frames[name]), insets.get(name),
        )
        for name, spec in specs.items()
    }  # fmt: skip


def _place_notes(spec: FigureSpec, camera: Camera, frame: tuple[int, int]) -> list[Note]:
    """Return the marks of a figure at the pixels where the camera sees them."""
    notes = []
    for point, words, ring in spec.marks:
        right, up = camera.project(np.asarray(point, dtype=float)[None])[0]
        place = frame[0] / 2 + right * frame[1] / 2, frame[1] / 2 - up * frame[1] / 2
        notes.append(Note(place, words, ring))
    return notes


def _draw_close_ups(
    specs: Mapping[str, FigureSpec], size: tuple[int, int]
) -> dict[str, np.ndarray]:
    """Return an image of what is about the place of each figure that has a close-up."""
    chosen = {name: spec for name, spec in specs.items() if spec.close_up is not None}
    inset = round(0.95 * INSET[0] * size[0]), round(INSET[1] * size[1])
    cameras = []
    for spec in chosen.values():
        place, radius, direction = spec.close_up
        corners = place + radius * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0],
                                             [0, 0, 1], [0, 0, -1]])  # fmt: skip
        cameras.append(fit_camera(corners, inset[0] / inset[1], direction))
    scenes = [spec.scene for spec in chosen.values()]
    images = render_scenes(scenes, cameras, inset) if chosen else []
    return dict(zip(chosen, images, strict=True))


def _aim(spec: FigureSpec, frame: tuple[int, int]) -> Camera:
    scene = spec.scene
    points = [scene.points, *(lines.points.reshape(-1, 3) for lines in scene.lines)]
    if scene.supports is not None:
        points.append(scene.supports - (0, 0, scene.support_size))
    return fit_camera(np.concatenate(points), frame[0] / frame[1], spec.direction)


def specify_thickness(view: DesignView) -> FigureSpec:
    """Panels coloured by thickness."""
    state = view.state
    values, panels = 1e3 * state.panel_thickness, 1e3 * state.final.thickness
    scale = make_scale(values, "YlGnBu")
    volume, area = state.report.volume_m3, state.report.area_m2
    least, most = (f"{value:.0f}" for value in (panels.min(), panels.max()))
    facts = (
        f"{least if least == most else f'{least} to {most}'} mm{_describe_edge_beam(state)}; "
        f"volume {volume:.4g} m³, {1e3 * volume / area:.0f} mm on average"
    )
    x, y, z = np.ptp(state.cells.nodes, axis=0)
    facts += f"; plan {x:.1f} m by {y:.1f} m, {z:.1f} m high"
    (edges, keys), (bar, length) = edge_lines(view), scale_bar(view)
    spec = specify_field(
        view, "Thickness", facts, "thickness [mm]", values[state.cell_panel], scale,
        extra=(*edges, bar), keys=keys,
    )  # fmt: skip
    return replace(spec, marks=(length,))


def _describe_edge_beam(state: DesignState) -> str:
    """Return the thickness of the edge beam in words, nothing where there is none."""
    edge_beam = 1e3 * state.edge_beam_thickness
    return f", edge beam {edge_beam.max():.0f} mm" if len(edge_beam) else ""


def specify_classes(view: DesignView) -> FigureSpec:
    """Panels by the class of their thickness, each class in one colour."""
    state, title = view.state, "Thickness classes"
    if state.classes is None:
        return specify_nothing(view, title, "no thickness classes")
    number, thickness = state.classes.panel_class, 1e3 * state.classes.thickness
    found = np.unique(number)
    rank = np.searchsorted(found, number).astype(float)
    scale = ColourScale(-0.5, len(found) - 0.5, "YlGnBu")
    swatches = [
        Key("area", f"{k}: {thickness[number == k].max():.1f} mm, {(number == k).sum()} panels",
            tuple(scale.colour(np.array(float(place))).tolist()))
        for place, k in enumerate(found)
    ]  # fmt: skip
    values = np.append(rank, np.full(len(state.edge_beam_thickness), np.nan))
    if len(state.edge_beam_thickness):
        words = f"edge beam: {1e3 * state.edge_beam_thickness.max():.1f} mm"
        swatches.append(Key("area", words, MISSING))
    facts = f"{len(found)} {'thickness' if len(found) == 1 else 'thicknesses'} to build with"
    spec = specify_field(view, title, facts, "", values[state.cell_panel], scale)
    return replace(spec, caption=replace(spec.caption, scale=None, swatches=swatches))


def specify_utilization(view: DesignView) -> FigureSpec:
    """Cells coloured by their largest utilization; what is above the limit stands out."""
    state, limit = view.state, view.sizing.utilization_max
    values = state.utilization
    if values is None:
        return specify_nothing(view, "Utilization", "no utilization")
    scale = make_limit_scale(values, limit)
    report = state.report
    facts = (
        f"{_describe_deciding(view)}; pointwise 99 % of the area at most "
        f"{report.utilization_p99:.2f}, mean {report.utilization_mean:.2f}"
    )
    if len(state.edge_beam_thickness):
        facts += f"; edge beam at most {report.edge_beam_utilization_max:.2f}"
    criterion = CRITERION_WORDS[view.material.criterion]
    combinations = f"{state.strength[0]} to {state.strength[-1]}"
    words = f"utilization of cells by {criterion} [-], largest of {combinations}"
    if scale.limit is None:
        words += f" ({limit:g} is not reached)"
    above = f"to {values.max():.2f}" if values.max() > limit else "none"
    width = LIMIT_WIDTH * min(1.0, DENSE / len(state.final.thickness))
    border = state.cells.nodes[find_region_border(state.triangles, values > limit)]
    return specify_field(
        view, "Utilization", facts, words, values, scale, above,
        extra=(Lines(border, INK, width, 1.2 * LIFT),),
        keys=(Key("area", f"above {limit:g}, outlined", ABOVE),) if len(border) else (),
    )  # fmt: skip


def _describe_deciding(view: DesignView) -> str:
    """Return the largest panel mean, and the peak of a cell where that is what the loop keeps."""
    mean = f"panel mean at most {view.state.report.utilization_panel_mean_max:.2f}"
    if DECIDES[view.sizing.measure] == "utilization_max":
        return f"cells at most {view.state.utilization.max():.2f} (decides), {mean}"
    if view.sizing.measure != "panel_mean" and view.state.report.state == "ok":
        decides = getattr(view.state.report, DECIDES[view.sizing.measure])
        return f"{view.sizing.measure} at most {decides:.2f} (decides), {mean}"
    return f"{mean} (decides)"


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
    order = "" if state.report.state == "ok" else "first order, "
    facts = (
        f"{name}: {order}at most {down.max():.1f} mm down (limit {limit:.1f} mm); "
        f"drawn {factor:g} times as large"
    )
    before, points = lines_before(view), state.cells.nodes + factor * moved
    spec = specify_field(
        view, "Displacement", facts, "vertical displacement, down [mm]", down,
        make_scale(down, "YlGnBu"), points=points, extra=(before,),
        keys=(Key("solid", "undisplaced", before.colour),),
    )  # fmt: skip
    ends = [(float(value), f"{value:.1f}") for value in (down.min(), down.max())]
    marks = [(points[down.argmax()], f"{down.max():.1f} mm down", True)]
    if down.min() < -UPWARD_MIN * down.max():
        marks.append((points[down.argmin()], f"{-down.min():.1f} mm up", True))
    return replace(spec, caption=replace(spec.caption, ends=ends), marks=tuple(marks))


def specify_planarity(view: DesignView) -> FigureSpec:
    """Panels coloured by the distance between their diagonals (Fig. 9)."""
    state = view.state
    values = 100 * state.folded.planarity
    facts = f"at most {values.max():.2f} %, mean {values.mean():.2f} % (0: panel is planar)"
    values = np.append(values, np.zeros_like(state.edge_beam_thickness))
    quantity = "distance of diagonals / their mean length [%]"
    scale = make_scale(values, zero=True, least=RATIO_RANGE_MIN)
    return specify_field(view, "Planarity", facts, quantity, values[state.cell_panel], scale)


def specify_strain(view: DesignView) -> FigureSpec:
    """Facets coloured by the largest strain of their sides in folding: what the paper must give."""
    state = view.state
    if state.folded.strain is None:
        return specify_nothing(view, "Folding strain", "no strain of the folding")
    values = 100 * state.folded.strain
    facts = f"at most {values.max():.2f} %, mean {values.mean():.2f} % (0: sides keep their length)"
    parts = (len(state.shell.facets) - 2 * len(state.edge_beam_thickness)) // len(values)
    values = np.repeat(values, parts)  # facets of a smooth panel are finer in the mesh
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
