"""One picture of all load cases: arrows on the sheet, what each case is, and what it sums to."""

from dataclasses import replace

import numpy as np
from PIL import Image, ImageDraw

from foldshell.figures.camera import Camera, fit_camera
from foldshell.figures.figure_specs import crease_lines, support_marks
from foldshell.figures.layout import INK, SOFT, fit_font, load_font, wrap
from foldshell.figures.render import render_scenes
from foldshell.figures.scene import Lines, Scene
from foldshell.results.design_view import DesignView
from foldshell.results.load_sums import CaseSum, sum_load_cases
from foldshell.shell.results import panel_centroids

ARROW = (190, 70, 0)
LONGEST = 0.16
"""Length of the longest arrow of a case, as share of the sheet's diagonal."""
ARROWS_MAX = 400
COLUMNS = 2
HEAD, FOOT, LINE = 90, 132, 28
"""Pixels: of the title, of the words below a view, of a line of these."""


def draw_loads(view: DesignView, size: tuple[int, int]) -> Image.Image:
    """Return the picture, as wide as `size` (width, height in pixels) and as high as it takes."""
    cases = find_cases(view)
    columns = min(COLUMNS, max(len(cases), 1))
    tile = size[0] // columns, round(0.5 * size[1])
    scenes = [make_scene(view, case) for case in cases]
    cameras = [_aim(scene, tile) for scene in scenes]
    views = render_scenes(scenes, cameras, tile) if scenes else []
    rows = -(-len(cases) // columns)
    page = Image.new("RGB", (size[0], HEAD + rows * (tile[1] + FOOT)), "white")
    pen = ImageDraw.Draw(page)
    pen.text((24, 20), f"Load cases of {view.state.name}", INK, load_font(34, True))
    for k, (case, image) in enumerate(zip(cases, views, strict=True)):
        x, y = k % columns * tile[0], HEAD + k // columns * (tile[1] + FOOT)
        page.paste(Image.fromarray(image), (x, y))
        _write_words(pen, case, (x + 24, y + tile[1]), tile[0] - 40)
    return page


def find_cases(view: DesignView) -> list[CaseSum]:
    """Return the load cases of a view on its sheet."""
    state = view.state
    panel, sized = state.mesh.panel, len(state.final.thickness)
    thickness = state.panel_thickness[panel]
    return sum_load_cases(view.operators, view.loads, thickness, panel >= sized)


def make_scene(view: DesignView, case: CaseSum) -> Scene:
    """Return the grey sheet with an arrow on each panel that a case loads, in proportion to its
    load per area; a case that strains without loading colours the sheet."""
    state = view.state
    lines, _ = crease_lines(view, state.cells.nodes)
    lines = tuple(replace(line, width=0.5 * line.width) for line in lines)
    bare = case.strains and not np.abs(case.panel_force).max(initial=0) > 0
    grey = (235, 205, 185) if bare else (222, 222, 222)
    colours = np.tile(np.array(grey, dtype=np.uint8), (len(state.triangles), 1))
    arrows = Lines(make_arrows(view, case), ARROW, 2.0)
    return Scene(state.cells.nodes, state.triangles, colours, (*lines, arrows),
                 *support_marks(view))  # fmt: skip


def make_arrows(view: DesignView, case: CaseSum) -> np.ndarray:
    """Return arrows as polylines (K, 5, 3) m: shaft, tip, and a barb on either side.

    A load that presses on the sheet ends on the panel, one that pulls at it begins there.
    """
    area = np.bincount(view.state.mesh.panel, view.operators.geometry.area)
    centre, normal = panel_centroids(view.operators)
    pressure = case.panel_force / area[:, None]
    size = np.linalg.norm(pressure, axis=1)
    if not size.max(initial=0) > 0:
        return np.empty((0, 5, 3))
    shown = np.flatnonzero(size > 1e-3 * size.max())
    shown = shown[:: -(-len(shown) // ARROWS_MAX)]
    shaft = LONGEST * view.size * pressure[shown] / size.max()
    along = shaft / np.linalg.norm(shaft, axis=1)[:, None]
    pulls = np.einsum("kx,kx->k", along, normal[shown])[:, None] > 1e-9
    tip = np.where(pulls, centre[shown] + shaft, centre[shown])
    tail = tip - shaft
    side = np.cross(along, np.where(np.abs(along[:, [2]]) > 0.9, [1.0, 0, 0], [0, 0, 1.0]))
    side *= 0.35 / np.linalg.norm(side, axis=1)[:, None]
    barb = 0.28 * np.linalg.norm(shaft, axis=1)[:, None] * (along + side)
    other = 0.28 * np.linalg.norm(shaft, axis=1)[:, None] * (along - side)
    return np.stack([tail, tip, tip - barb, tip, tip - other], axis=1)


def _aim(scene: Scene, frame: tuple[int, int]) -> Camera:
    points = np.concatenate([scene.points, scene.lines[-1].points.reshape(-1, 3)])
    return fit_camera(points, frame[0] / frame[1])


def _write_words(
    pen: ImageDraw.ImageDraw, case: CaseSum, place: tuple[float, float], width: float
) -> None:
    """Write name, loads and sums of a case below its view."""
    x, y = place
    pen.text((x, y), case.name, INK, load_font(22, True))
    font = load_font(17)
    lines = wrap(case.words, font, width)
    lines = lines if len(lines) < 3 else [lines[0], lines[1] + " ..."]
    forces, moments = (", ".join(f"{value + 0.0:.1f}" for value in np.round(values, 1))
                       for values in (case.force, case.moment))  # fmt: skip
    lines.append(f"sum {forces} kN; moment about the origin {moments} kNm")
    for number, text in enumerate(lines, start=1):
        pen.text((x, y + number * LINE - 2), text, SOFT, fit_font(text, 17, width))
