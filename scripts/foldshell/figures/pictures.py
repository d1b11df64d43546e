"""The pictures of one design (Fig. 7 of Tsiamis et al. 2018): what each shows and says."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from PIL import Image

from foldshell.figures.camera import Camera, fit_camera
from foldshell.figures.colours import MISSING, ColourScale, make_limit_scale, make_scale, round_step
from foldshell.figures.creases import Creases, cut_dashes, find_creases
from foldshell.figures.fields import choose_deflection
from foldshell.figures.layout import INK, SOFT, Caption, Key, compose, view_size
from foldshell.figures.render import Lines, Scene, render_scenes
from foldshell.figures.state import DesignState

DISPLACED_SHARE = 0.06
"""The largest displacement is drawn about this share of the span long."""

DENSE = 350
"""Sheets of more panels get thinner lines, and fewer."""


@dataclass(frozen=True)
class Limits:
    """What a design is judged by: utilization (-), span over displacement (-)."""

    utilization_max: float = 1.0
    displacement_limit_span_over: float = 240.0


@dataclass(frozen=True)
class Draft:
    """A scene with its words, before it is rendered."""

    scene: Scene
    caption: Caption


@dataclass(frozen=True)
class Subject:
    """What all pictures of a design share."""

    state: DesignState
    creases: Creases
    span: float
    limits: Limits

    @property
    def size(self) -> float:
        """Length of the diagonal of the sheet's box, m."""
        return float(np.linalg.norm(np.ptp(self.state.cells.nodes, axis=0)))


def draw_design(
    state: DesignState,
    span: float,
    limits: Limits,
    size: tuple[int, int],
    names: Sequence[str],
) -> dict[str, Image.Image]:
    """Return the named pictures (`PICTURES`) of a design, each of the given size in pixels."""
    subject = Subject(state, find_creases(state.cells, state.folded), span, limits)
    drafts = {name: PICTURES[name](subject) for name in names}
    view = view_size(size)
    cameras = [_aim(draft.scene, view) for draft in drafts.values()]
    images = render_scenes([draft.scene for draft in drafts.values()], cameras, view)
    return {
        name: compose(image, draft.caption, camera.axes()[:2].T, size)
        for (name, draft), image, camera in zip(drafts.items(), images, cameras, strict=True)
    }


def _aim(scene: Scene, view: tuple[int, int]) -> Camera:
    points = [scene.points, *(lines.points.reshape(-1, 3) for lines in scene.lines)]
    if scene.supports is not None:
        points.append(scene.supports - (0, 0, scene.support_size))
    return fit_camera(np.concatenate(points), view[0] / view[1])


def draft_thickness(subject: Subject) -> Draft:
    """Panels coloured by thickness."""
    state = subject.state
    values = 1e3 * state.final["thickness"]
    scale = make_scale(values, "YlGnBu")
    volume, area = state.report["volume_m3"], state.report["area_m2"]
    least, most = (f"{value:.0f}" for value in (values.min(), values.max()))
    facts = (
        f"{least if least == most else f'{least} to {most}'} mm; volume {volume:.4g} m³, "
        f"{1e3 * volume / area:.0f} mm on average"
    )
    return _draft(subject, "Thickness", facts, "thickness [mm]", values[state.cell_panel], scale)


def draft_utilization(subject: Subject) -> Draft:
    """Cells coloured by their largest utilization; what is above the limit stands out."""
    state, limit = subject.state, subject.limits.utilization_max
    values = state.utilization
    if values is None:
        return _draft_nothing(subject, "Utilization", "no utilization")
    scale = make_limit_scale(values, limit)
    report = state.report
    facts = (
        f"panel mean at most {report['utilization_panel_mean_max']:.2f}; pointwise 99 % of the "
        f"area at most {report['utilization_p99']:.2f}, mean {report['utilization_mean']:.2f}"
    )
    words = f"utilization [-], largest of {state.strength[0]} to {state.strength[-1]}"
    if scale.limit is None:
        words += f" ({limit:g} is not reached)"
    above = f"to {values.max():.2f}" if values.max() > limit else "none"
    return _draft(subject, "Utilization", facts, words, values, scale, above)


def draft_displacement(subject: Subject) -> Draft:
    """The displaced sheet, coloured by downward displacement, over its undisplaced creases."""
    state = subject.state
    if not state.usable:
        return _draft_nothing(subject, "Displacement", "no displacement")
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
    before = _lines_before(subject)
    return _draft(
        subject, "Displacement", facts, quantity, down, make_scale(down, "cividis"),
        points=state.cells.nodes + factor * moved, extra=(before,),
        keys=(Key("solid", "undisplaced", before.colour),),
    )  # fmt: skip


def draft_planarity(subject: Subject) -> Draft:
    """Panels coloured by the distance between their diagonals (Fig. 9)."""
    state = subject.state
    values = 100 * state.folded["planarity"]
    facts = f"at most {values.max():.2f} %, mean {values.mean():.2f} % (0: panel is planar)"
    quantity = "distance of diagonals / their mean length [%]"
    scale = make_scale(values, zero=True)
    return _draft(subject, "Planarity", facts, quantity, values[state.cell_panel], scale)


def exaggeration(moved: np.ndarray, span: float) -> float:
    """Return a round factor that draws the largest of (N, 3) m at about 6 % of the span."""
    largest = float(np.linalg.norm(moved, axis=1).max())
    return round_step(DISPLACED_SHARE * span / largest) if largest > 0 else 1.0


def _draft(
    subject: Subject,
    title: str,
    facts: str,
    quantity: str,
    values: np.ndarray,
    scale: ColourScale,
    above: str = "",
    points: np.ndarray | None = None,
    extra: tuple[Lines, ...] = (),
    keys: tuple[Key, ...] = (),
) -> Draft:
    state = subject.state
    points = state.cells.nodes if points is None else points
    lines, line_keys = crease_lines(subject, points)
    scene = Scene(
        points, state.triangles, scale.colour(values), (*lines, *extra),
        *support_marks(subject),
    )  # fmt: skip
    all_keys = (*line_keys, *keys, Key("support", "pinned edges"))
    words = (facts, describe_verdict(state.report))
    return Draft(scene, Caption(f"{title}: {state.name}", words, quantity, scale, above, all_keys))


def _draft_nothing(subject: Subject, title: str, words: str) -> Draft:
    state = subject.state
    lines, keys = crease_lines(subject, state.cells.nodes)
    colours = np.tile(np.array(MISSING, dtype=np.uint8), (len(state.triangles), 1))
    scene = Scene(state.cells.nodes, state.triangles, colours, lines, *support_marks(subject))
    verdict = describe_verdict(state.report)
    return Draft(scene, Caption(f"{title}: {state.name}", (words, verdict), keys=keys))


def describe_verdict(report: Mapping[str, Any]) -> str:
    """Return verdict, count of analyses and reason as one line."""
    count = report.get("iteration", 0) + 1
    words = f"{str(report.get('verdict')).replace('_', ' ')} after {count} analyses"
    return f"{words}: {report['reason']}" if report.get("reason") else words


def crease_lines(subject: Subject, points: np.ndarray) -> tuple[tuple[Lines, ...], tuple[Key, ...]]:
    """Return mountains as lines, valleys as dashes, other panel borders thin, and their keys."""
    creases = subject.creases
    dashes = cut_dashes(points[creases.valley], subject.size / 90)
    width = 2.5 * min(1.0, (DENSE / len(subject.state.final["thickness"])) ** 0.5)
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


def support_marks(subject: Subject) -> tuple[np.ndarray, float]:
    """Return the vertices on supported edges (S, 3) m, and the size of their marks, m."""
    state = subject.state
    vertices = np.unique(state.shell["support_pairs"])
    return state.shell["vertices"][vertices], subject.size / 60


def _lines_before(subject: Subject) -> Lines:
    """Return the undisplaced creases, of a dense sheet the border alone."""
    creases = subject.creases
    kinds = [creases.border]
    if len(subject.state.final["thickness"]) <= DENSE:
        kinds += [creases.mountain, creases.valley, creases.flat]
    return Lines(subject.state.cells.nodes[np.concatenate(kinds)], (150, 150, 150), 1.5, 0.0)


PICTURES: dict[str, Callable[[Subject], Draft]] = {
    "thickness": draft_thickness,
    "utilization": draft_utilization,
    "displacement": draft_displacement,
    "planarity": draft_planarity,
}
