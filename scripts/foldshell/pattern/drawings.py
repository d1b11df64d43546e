"""Crease patterns as drawings: DXF (R2010) and SVG, in millimetres, one layer a kind of line."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.pattern.grid import Grid, find_outline

# Preset: kind of line -> (layer, AutoCAD colour index, SVG colour). Tools that read FOLD know
# mountains as red, valleys as blue and the border as black by exactly these values; the paper
# draws mountains green and valleys red; laser cutters often cut what is red.
PRESETS = {
    "fold": {
        "outline": ("BORDER", 7, "#000000"),
        "mountain": ("MOUNTAIN", 1, "#ff0000"),
        "valley": ("VALLEY", 5, "#0000ff"),
        "flat": ("FLAT", 2, "#ffff00"),
    },
    "paper": {
        "outline": ("BORDER", 7, "#000000"),
        "mountain": ("MOUNTAIN", 3, "#008000"),
        "valley": ("VALLEY", 1, "#ff0000"),
        "flat": ("FLAT", 8, "#808080"),
    },
    "laser": {
        "outline": ("CUT", 1, "#ff0000"),
        "mountain": ("MOUNTAIN", 5, "#0000ff"),
        "valley": ("VALLEY", 3, "#00ff00"),
        "flat": ("FLAT", 8, "#808080"),
    },
}
SCALES = tuple(n * 10**k for k in range(5) for n in (1, 2, 5))
"""Scales 1:n at which a drawing is shown that is larger than what shows it."""
SVG_SIDE_MM = 1000.0
"""An SVG drawing opens at most so large; its coordinates stay those of the drawing."""
PAPER_MM = (841.0, 594.0)
"""A1, the paper of the DXF file's layout."""
MARGIN_MM, TITLE_MM = 20.0, 40.0


@dataclass(frozen=True)
class Drawing:
    """Lines of a flat crease pattern [mm]: closed outline (N, 2), creases (M, 2, 2) by kind.

    `scale` is the drawing's length over the true one; `title` names the sheet; `holes` are further
    closed lines (N, 2), of openings.
    """

    outline: np.ndarray
    creases: dict[str, np.ndarray]
    scale: float = 1.0
    title: str = ""
    holes: tuple[np.ndarray, ...] = ()

    @property
    def low(self) -> np.ndarray:
        """Lower left corner (2,) [mm]."""
        return self.outline.min(axis=0)

    @property
    def high(self) -> np.ndarray:
        """Upper right corner (2,) [mm]."""
        return self.outline.max(axis=0)

    @property
    def size(self) -> np.ndarray:
        """Width and height (2,) [mm]."""
        return self.high - self.low

    @property
    def legend(self) -> tuple[str, ...]:
        """What the title block says, line by line."""
        width, height = self.size / (1000 * self.scale)
        counts = ", ".join(f"{len(lines)} {kind} folds" for kind, lines in self.creases.items())
        return (
            self.title or "crease pattern",
            f"sheet {width:.3f} x {height:.3f} m, {counts}",
            f"drawn in mm, {describe_scale(self.scale)}",
        )


def draw_pattern(flat: np.ndarray, grid: Grid, scale: float = 1.0, title: str = "") -> Drawing:
    """Turn a flat pattern (V, 3) [m] into lines [mm] at `scale` (1 is full size).

    Neutral folds are left out: they are how panels bend, not creases that anyone scores.
    """
    points = (flat[:, :2] - flat[:, :2].min(axis=0)) * 1000.0 * scale
    creases = {
        kind: points[grid.edges[grid.assignments == letter]]
        for kind, letter in (("mountain", "M"), ("valley", "V"))
    }
    return Drawing(points[find_outline(grid)], creases, scale, title)


def describe_scale(scale: float) -> str:
    """Say a scale in words: full size, 1:50, 2:1."""
    if scale == 1:
        return "full size"
    return f"{scale:g}:1" if scale > 1 else f"1:{1 / scale:g}"


def fit_scale(size: np.ndarray, room: np.ndarray) -> int:
    """Return the least n of `SCALES` at which `size` (2,) / n fits into `room` (2,), both mm."""
    wanted = float((np.asarray(size) / room).max())
    return next((n for n in SCALES if n >= wanted * (1 - 1e-9)), math.ceil(wanted))


def write_dxf(path: str | Path, drawing: Drawing, preset: str = "fold") -> None:
    """Write a DXF drawing with true extents, and a layout with its title block on A1.

    Its bytes depend on the lines and the title alone.
    """
    document = new_dxf(PRESETS[preset].values())
    space = document.modelspace()
    for kind, lines in drawing.creases.items():
        for start, end in lines.tolist():
            space.add_line(start, end, dxfattribs={"layer": PRESETS[preset][kind][0]})
    layer = PRESETS[preset]["outline"][0]
    for ring in (drawing.outline, *drawing.holes):
        space.add_lwpolyline(ring.tolist(), close=True, dxfattribs={"layer": layer})
    save_dxf(path, document, drawing.low, drawing.high, drawing.legend)


def write_drawings(
    drawing: Drawing, dxf: str | Path | None, svg: str | Path | None, preset: str
) -> None:
    """Write a drawing in both formats, each where it has a path."""
    if dxf:
        write_dxf(dxf, drawing, preset)
    if svg:
        write_svg(svg, drawing, preset)


def new_dxf(layers: Iterable[tuple]) -> Any:
    """Return an empty R2010 document in mm with layers, rows of (name, colour index, ...)."""
    import ezdxf

    ezdxf.options.write_fixed_meta_data_for_testing = True
    document = ezdxf.new("R2010", setup=False)
    document.units = ezdxf.units.MM
    for name, colour, *_ in layers:
        document.layers.add(name, color=colour)
    return document


def save_dxf(
    path: str | Path, document: Any, low: np.ndarray, high: np.ndarray, legend: Iterable[str]
) -> None:
    """Set extents low, high (2,) mm, fill the layout, and write the file."""
    space = document.modelspace()
    ends = {"$EXTMIN": (*low.tolist(), 0.0), "$EXTMAX": (*high.tolist(), 0.0)}
    space.reset_extents(*ends.values())
    space.reset_limits(tuple(low), tuple(high))
    for name, value in ends.items():  # ezdxf takes an extent at the origin for none
        document.header[name] = value
    _fill_layout(document, low, high, legend)
    for name in sorted(document.entitydb.dxf_types_in_use()):  # ezdxf adds them in a set's order
        document.classes.add_class(name)
    with atomic_path(path) as temporary:
        document.saveas(temporary)


def _fill_layout(document: Any, low: np.ndarray, high: np.ndarray, legend: Iterable[str]) -> None:
    """Put the drawing on the layout's sheet at a standard scale, with its title block below."""
    layout, (width, height) = document.layout("Layout1"), PAPER_MM
    layout.page_setup(size=PAPER_MM, margins=(0, 0, 0, 0), units="mm")
    room = np.array([width - 2 * MARGIN_MM, height - 2 * MARGIN_MM - TITLE_MM])
    ratio = fit_scale(high - low, room)
    layout.add_viewport(
        center=(width / 2, MARGIN_MM + TITLE_MM + room[1] / 2),
        size=tuple(room),
        view_center_point=tuple((low + high) / 2),
        view_height=float(room[1] * ratio),
    )
    layout.add_lwpolyline(_box(MARGIN_MM, MARGIN_MM, room[0], TITLE_MM), close=True)
    lines = (*legend, f"sheet A1, view of the drawing 1:{ratio}")
    for k, line in enumerate(lines):
        place = (MARGIN_MM + 5, MARGIN_MM + TITLE_MM - 8 - 9 * k)
        layout.add_text(line, height=5, dxfattribs={"insert": place})


def _box(x: float, y: float, width: float, height: float) -> list[tuple[float, float]]:
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def write_svg(path: str | Path, drawing: Drawing, preset: str = "fold") -> None:
    """Write an SVG drawing, y upwards as in the pattern; user units are the drawing's mm.

    A drawing of more than `SVG_SIDE_MM` opens at the standard scale that is less; it says so.
    """
    width, height = drawing.size
    ratio = fit_scale(drawing.size, np.full(2, SVG_SIDE_MM))
    shown = f"; opens at 1:{ratio} of the drawing" if ratio > 1 else ""
    stroke = max(width, height) / 1500
    legend = "; ".join(drawing.legend) + shown
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" '
        f'width="{width / ratio:.6f}mm" height="{height / ratio:.6f}mm" '
        f'viewBox="0 0 {width:.6f} {height:.6f}" fill="none" stroke-width="{stroke:.4f}">',
        f"<title>{escape(drawing.title or 'crease pattern')}</title>",
        f"<desc>{escape(legend)}</desc>",
    ]
    for kind, lines in drawing.creases.items():
        layer, _, colour = PRESETS[preset][kind]
        dash = f' stroke-dasharray="{6 * stroke:.4f} {3 * stroke:.4f}"' if kind == "valley" else ""
        steps = "".join(
            f"M{x1:.6f} {height - y1:.6f}L{x2:.6f} {height - y2:.6f}"
            for (x1, y1), (x2, y2) in (lines - drawing.low).tolist()
        )
        parts.append(f'<g id="{layer}"{dash}><path stroke="{colour}" d="{steps}"/></g>')
    layer, _, colour = PRESETS[preset]["outline"]
    for corners in (drawing.outline, *drawing.holes):
        ring = " ".join(f"{x:.6f},{height - y:.6f}" for x, y in (corners - drawing.low).tolist())
        parts.append(f'<g id="{layer}"><polygon stroke="{colour}" points="{ring}"/></g>')
    parts.append("</svg>\n")
    with atomic_path(path) as temporary:
        temporary.write_text("\n".join(parts), encoding="utf-8")
