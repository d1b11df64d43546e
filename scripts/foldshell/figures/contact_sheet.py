"""Small multiples: all designs of a study on one page, seen alike and on one colour scale."""

import base64
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image, ImageDraw

from foldshell.figures.camera import fit_camera
from foldshell.figures.figure_specs import crease_lines, support_marks
from foldshell.figures.layout import INK, SOFT, Caption, draw_bar, fit_font, load_font
from foldshell.figures.render import render_scenes
from foldshell.figures.scene import Scene
from foldshell.files.whole import Json
from foldshell.results.colour_scales import MISSING, ColourScale, make_scale
from foldshell.results.design_view import DesignView

TILE = (400, 270)
WORDS = 58
HEAD = 90
FOOT = 130
COLOURS = 16
"""Steps of the legend of small pictures."""
USUAL_PERCENTILE = 99.0
"""The colour scale of thickness ends here, so that one thick panel does not bleach all others."""


@dataclass(frozen=True)
class Tile:
    """One design: scene without colours, its panels' thickness (C,) mm, utilization (C,)."""

    name: str
    verdict: str
    scene: Scene
    thickness: np.ndarray
    utilization: np.ndarray | None


def make_tile(view: DesignView) -> Tile:
    """Return what the sheet needs of a design, so that the rest can be forgotten."""
    state = view.state
    lines, _ = crease_lines(view, state.cells.nodes)
    lines = tuple(replace(line, width=0.45 * line.width) for line in lines)
    blank = np.tile(np.array(MISSING, dtype=np.uint8), (len(state.triangles), 1))
    scene = Scene(state.cells.nodes, state.triangles, blank, lines, *support_marks(view))
    thickness = 1e3 * state.panel_thickness[state.cell_panel]
    verdict = state.report.verdict.replace("_", " ")
    return Tile(state.name, verdict, scene, thickness, state.utilization)


@dataclass(frozen=True)
class Sheet:
    """All designs coloured by one quantity: its caption and a view of each, (h, w, 3) uint8."""

    caption: Caption
    views: Mapping[str, np.ndarray]


def render_sheets(tiles: Sequence[Tile], limit: float) -> dict[str, Sheet]:
    """Return the sheets `thickness` and `utilization`, each on one scale for all tiles."""
    thickness = np.concatenate([tile.thickness for tile in tiles])
    usual = np.percentile(thickness, USUAL_PERCENTILE)
    scales = {
        "thickness": make_scale(np.minimum(thickness, usual), "YlGnBu", zero=True),
        "utilization": ColourScale(0.0, limit, limit=limit),
    }
    words = {
        "thickness": f"thickness [mm]; the darkest also for more, up to {thickness.max():.0f}",
        "utilization": "utilization of cells [-], largest of the strength combinations",
    }
    cameras = [fit_camera(_corners(tile.scene), TILE[0] / TILE[1]) for tile in tiles]
    sheets = {}
    for name, scale in scales.items():
        scenes = [_colour(tile, getattr(tile, name), scale) for tile in tiles]
        views = render_scenes(scenes, cameras, TILE)
        above = "above" if scale.limit is not None else ""
        caption = Caption(f"All designs: {name}", (), words[name], scale, above)
        sheets[name] = Sheet(caption, dict(zip((t.name for t in tiles), views, strict=True)))
    return sheets


def draw_sheet(tiles: Sequence[Tile], sheet: Sheet, columns: int = 6) -> Image.Image:
    """Return a sheet as one page."""
    return lay_out(tiles, list(sheet.views.values()), sheet.caption, columns)


def pack_sheets(sheets: Mapping[str, Sheet]) -> Json:
    """Return words, scale and a small picture of each design (data URI), for the report."""
    return {
        name: {
            "words": sheet.caption.quantity,
            "scale": sheet.caption.scale.describe(COLOURS),
            "pictures": {design: encode_picture(view) for design, view in sheet.views.items()},
        }
        for name, sheet in sheets.items()
    }


def encode_picture(view: np.ndarray) -> str:
    """Return an image (h, w, 3) uint8 as a data URI."""
    stream = io.BytesIO()
    Image.fromarray(view).save(stream, format="WEBP", quality=70, method=2)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode("ascii")


def _corners(scene: Scene) -> np.ndarray:
    return np.concatenate([scene.points, scene.supports - (0, 0, scene.support_size)])


def _colour(tile: Tile, values: np.ndarray | None, scale: ColourScale) -> Scene:
    return tile.scene if values is None else replace(tile.scene, colours=scale.colour(values))


def lay_out(
    tiles: Sequence[Tile], views: Sequence[np.ndarray], caption: Caption, columns: int
) -> Image.Image:
    """Return the page: title, tiles row by row with name and verdict, one colour bar.

    `views` are images (height, width, 3) uint8, one per tile.
    """
    rows = -(-len(tiles) // columns)
    width, height = columns * TILE[0], HEAD + rows * (TILE[1] + WORDS) + FOOT
    page = Image.new("RGB", (width, height), "white")
    pen = ImageDraw.Draw(page)
    pen.text((30, 22), caption.title, INK, load_font(46, True))
    for k, (tile, view) in enumerate(zip(tiles, views, strict=True)):
        x, y = k % columns * TILE[0], HEAD + k // columns * (TILE[1] + WORDS)
        page.paste(Image.fromarray(view), (x, y + WORDS))
        pen.text((x + 12, y + 2), tile.name, INK, fit_font(tile.name, 24, TILE[0] - 24, True))
        pen.text((x + 12, y + 31), tile.verdict, SOFT, load_font(22))
    draw_bar(page, (30, height - 80, 1000, height - 46), caption, 0.95)
    return page
