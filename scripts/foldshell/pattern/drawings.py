"""Crease patterns as drawings: DXF (R2010) and SVG, in millimetres, one layer a kind of line."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldshell.files.whole import atomic_path
from foldshell.pattern.grid import Grid, find_outline

# Preset: layer -> (AutoCAD colour index, SVG colour). The paper draws mountains green and
# valleys red, FOLD tools mountains red and valleys blue.
PRESETS = {
    "fold": {"CUT": (7, "#000000"), "MOUNTAIN": (1, "#d62728"), "VALLEY": (5, "#1f4fd6")},
    "paper": {"CUT": (7, "#000000"), "MOUNTAIN": (3, "#2ca02c"), "VALLEY": (1, "#d62728")},
}


@dataclass(frozen=True)
class Drawing:
    """Lines of a flat crease pattern [mm]: closed outline (N, 2), creases (M, 2, 2) by layer."""

    outline: np.ndarray
    creases: dict[str, np.ndarray]


def draw_pattern(flat: np.ndarray, grid: Grid, scale: float = 1.0) -> Drawing:
    """Turn a flat pattern (V, 3) [m] into lines [mm] at `scale` (1 is full size).

    Neutral folds are left out: they are how panels bend, not creases that anyone scores.
    """
    points = (flat[:, :2] - flat[:, :2].min(axis=0)) * 1000.0 * scale
    creases = {
        layer: points[grid.edges[grid.assignments == kind]]
        for layer, kind in (("MOUNTAIN", "M"), ("VALLEY", "V"))
    }
    return Drawing(points[find_outline(grid)], creases)


def write_dxf(path: str | Path, drawing: Drawing, preset: str = "fold") -> None:
    """Write a DXF drawing; its bytes depend on the lines alone."""
    import ezdxf

    ezdxf.options.write_fixed_meta_data_for_testing = True
    document = ezdxf.new("R2010", setup=False)
    document.units = ezdxf.units.MM
    space = document.modelspace()
    for layer, (colour, _) in PRESETS[preset].items():
        document.layers.add(layer, color=colour)
    for layer, lines in drawing.creases.items():
        for start, end in lines.tolist():
            space.add_line(start, end, dxfattribs={"layer": layer})
    space.add_lwpolyline(drawing.outline.tolist(), close=True, dxfattribs={"layer": "CUT"})
    for name in sorted(document.entitydb.dxf_types_in_use()):  # ezdxf adds them in a set's order
        document.classes.add_class(name)
    with atomic_path(path) as temporary:
        document.saveas(temporary)


def write_svg(path: str | Path, drawing: Drawing, preset: str = "fold") -> None:
    """Write an SVG drawing in millimetres, y upwards as in the pattern."""
    width, height = drawing.outline.max(axis=0)
    stroke = max(width, height) / 1500
    colours = {layer: svg for layer, (_, svg) in PRESETS[preset].items()}
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.6f}mm" height="{height:.6f}mm" '
        f'viewBox="0 0 {width:.6f} {height:.6f}" fill="none" stroke-width="{stroke:.4f}">'
    ]
    for layer, lines in drawing.creases.items():
        dash = f' stroke-dasharray="{6 * stroke:.4f} {3 * stroke:.4f}"' if layer == "VALLEY" else ""
        steps = "".join(
            f"M{x1:.6f} {height - y1:.6f}L{x2:.6f} {height - y2:.6f}"
            for (x1, y1), (x2, y2) in lines.tolist()
        )
        parts.append(f'<g id="{layer}" stroke="{colours[layer]}"{dash}><path d="{steps}"/></g>')
    ring = " ".join(f"{x:.6f},{height - y:.6f}" for x, y in drawing.outline.tolist())
    parts.append(f'<g id="CUT" stroke="{colours["CUT"]}"><polygon points="{ring}"/></g>')
    parts.append("</svg>\n")
    with atomic_path(path) as temporary:
        temporary.write_text("\n".join(parts), encoding="utf-8")
