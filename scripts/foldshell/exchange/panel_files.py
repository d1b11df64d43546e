"""Panels to cut: drawings of each with its marks, tables of their measures, and sheets of them."""

import csv
import io
import math
from pathlib import Path

import numpy as np

from foldshell.exchange.flat_panels import FlatPanel, flatten_panels
from foldshell.exchange.model import ExportModel
from foldshell.exchange.nesting import Nesting, nest_panels
from foldshell.exchange.options import ExportOptions
from foldshell.files.whole import atomic_path
from foldshell.pattern.drawings import PRESETS, describe_scale, new_dxf, save_dxf

COLUMNS = ("panel", "part", "area_m2", "thickness_m", "class", "class_thickness_m", "volume_m3",
           "weight_kn", "flatness_m", "bend_deg", "corners")  # fmt: skip
OF_EDGE = ("x_m", "y_m", "length_m", "neighbour", "fold_deg", "dihedral_deg", "mitre_deg")


def panel_rows(model: ExportModel, panels: tuple[FlatPanel, ...]) -> list[dict[str, object]]:
    """Return a row for each panel: its measures, then corner, edge and neighbour, edge by edge."""
    rows = []
    for flat in panels:
        panel, volume = flat.panel, flat.area * flat.panel.thickness
        values = (
            panel.name, "sheet" if panel.sized else "edge beam", flat.area, panel.thickness,
            panel.thickness_class, panel.class_thickness, volume,
            volume * model.material.unit_weight, panel.flatness,
            " ".join(f"{math.degrees(bend):.12g}" for bend in flat.bends), len(flat.corners),
        )  # fmt: skip
        row = dict(zip(COLUMNS, values, strict=True))
        for k, (corner, edge) in enumerate(zip(flat.corners.tolist(), flat.edges, strict=True), 1):
            border = edge.neighbour is None
            angles = (edge.fold, edge.dihedral, edge.mitre)
            marks = [*corner, edge.length, "" if border else edge.neighbour.name]
            marks += ["" if border else math.degrees(angle) for angle in angles]
            row |= {f"e{k}_{name}": v for name, v in zip(OF_EDGE, marks, strict=True)}
        rows.append(row)
    return rows


def write_panels(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write panels.dxf, panels.csv and panels.xlsx."""
    panels = flatten_panels(model)
    rows = panel_rows(model, panels)
    columns = list(max(rows, key=len))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    with atomic_path(paths[1]) as temporary:
        temporary.write_text(text.getvalue(), encoding="utf-8")
    _write_dxf(model, panels, paths[0], options)
    _write_workbook(model, rows, columns, paths[2])


def _layers(options: ExportOptions) -> dict[str, tuple[str, int]]:
    """Return layers by use: name and colour."""
    outline, colour, _ = PRESETS[options.preset]["outline"]
    return {"outline": (outline, colour), "bend": ("BEND", 8), "label": ("LABEL", 7),
            "mark": ("MARK", 6), "sheet": ("SHEET", 9)}  # fmt: skip


def _write_dxf(model, panels, path: Path, options: ExportOptions) -> None:
    """Draw the panels side by side, in the order of their numbers."""
    layers, scale = _layers(options), 1000 * options.scale
    document = new_dxf(layers.values())
    space = document.modelspace()
    cell = 1.15 * max(float(np.ptp(flat.corners, axis=0).max()) for flat in panels)
    columns = math.ceil(math.sqrt(len(panels)))
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for k, flat in enumerate(panels):
        row, column = divmod(k, columns)
        place = np.array([column, -row]) * cell - flat.corners.min(axis=0)
        outline = (flat.corners + place) * scale
        _draw_panel(space, flat, outline, (flat.inner + place) * scale, layers)
        low, high = np.minimum(low, outline.min(axis=0)), np.maximum(high, outline.max(axis=0))
    legend = (f"{model.design}, {len(panels)} panels seen from their positive side",
              "along an edge: neighbour, fold angle (valley positive), mitre angle from square",
              f"drawn in mm, {describe_scale(options.scale)}")  # fmt: skip
    save_dxf(path, document, low, high, legend)


def _draw_panel(space, flat: FlatPanel, outline: np.ndarray, inner: np.ndarray, layers) -> None:
    """Draw outline, bend lines, label and edge marks, all inside the outline."""
    space.add_lwpolyline(outline.tolist(), close=True, dxfattribs={"layer": layers["outline"][0]})
    for line in inner.tolist():
        space.add_line(*line, dxfattribs={"layer": layers["bend"][0]})
    middle, size = outline.mean(axis=0), math.sqrt(_size(outline)) / 24
    thick = f"{1000 * flat.panel.thickness:.4g} mm"
    label = f"{flat.panel.name}  {thick}"
    if flat.bends.size:
        bends = ", ".join(f"{math.degrees(bend):.2f}" for bend in flat.bends)
        label += f"  bend {bends}"
    _add_text(space, label, middle, 0.0, size, layers["label"][0])
    for k, edge in enumerate(flat.edges):
        if edge.neighbour is None:
            continue
        ends = outline[[k, (k + 1) % len(outline)]]
        along = ends[1] - ends[0]
        inward = np.array([-along[1], along[0]]) / np.linalg.norm(along)
        fold, mitre = math.degrees(edge.fold), math.degrees(edge.mitre)
        text = f"{edge.neighbour.name} {fold:+.2f} / {mitre:+.2f}"
        angle = math.degrees(math.atan2(along[1], along[0]))
        place = ends.mean(axis=0) + 0.9 * size * inward
        _add_text(space, text, place, angle, 0.6 * size, layers["mark"][0])


def _add_text(space, text: str, place: np.ndarray, angle: float, height: float, layer: str) -> None:
    from ezdxf.enums import TextEntityAlignment

    made = space.add_text(text, height=height, rotation=angle, dxfattribs={"layer": layer})
    made.set_placement(tuple(place), align=TextEntityAlignment.MIDDLE_CENTER)


def _size(outline: np.ndarray) -> float:
    x, y = outline.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def _write_workbook(model, rows, columns: list[str], path: Path) -> None:
    """Write the summary with the sums beside the design's own, and the table of panels."""
    from foldshell.exchange.sheets import write_workbook

    area, volume = (sum(row[name] for row in rows) for name in ("area_m2", "volume_m3"))
    own = model.facts.get("volume_m3")
    summary = [
        ["quantity", "sum of panels", "design", "unit"],
        ["panels", len(rows), len(model.panels), "-"],
        ["area", area, float(model.areas.sum()), "m2"],
        ["volume", volume, own if own is not None else model.volume, "m3"],
        ["weight", volume * model.material.unit_weight,
         (own or model.volume) * model.material.unit_weight, "kN"],
    ]  # fmt: skip
    table = [columns, *([row.get(name, "") for name in columns] for row in rows)]
    write_workbook(path, {"summary": summary, "panels": table}, f"{model.design}, panels")


def write_nesting(model: ExportModel, paths: tuple[Path, ...], options: ExportOptions) -> None:
    """Write the sheets as DXF, and which panel lies on which as CSV."""
    panels = {flat.panel.number: flat for flat in flatten_panels(model)}
    length, width = options.sheet_length, options.sheet_width
    nesting = nest_panels(tuple(panels.values()), length, width, options.nesting_seconds)
    lines = ["panel,sheet,class,x_m,y_m"]
    for number, sheet in enumerate(nesting.sheets, start=1):
        for key, outline in zip(sheet.numbers, sheet.outlines, strict=True):
            x, y = outline[0].tolist()
            name = model.panels[key].name
            lines.append(f"{name},{number},{sheet.thickness_class},{x!r},{y!r}")
    lines += [f"{model.panels[key].name},larger than a sheet,,," for key in nesting.oversize]
    with atomic_path(paths[1]) as temporary:
        temporary.write_text("\n".join(lines) + "\n", encoding="ascii")
    _draw_sheets(model, panels, nesting, paths[0], options)


def _draw_sheets(model, panels, nesting: Nesting, path: Path, options: ExportOptions) -> None:
    layers, scale = _layers(options), 1000 * options.scale
    length, width = options.sheet_length, options.sheet_width
    document = new_dxf(layers.values())
    space = document.modelspace()
    columns = max(1, math.ceil(math.sqrt(len(nesting.sheets) * width / length)))
    low, high = np.zeros(2), np.zeros(2)
    for k, sheet in enumerate(nesting.sheets):
        row, column = divmod(k, columns)
        place = np.array([column * 1.05 * length, -row * 1.15 * width])
        box = (np.array([[0, 0], [length, 0], [length, width], [0, width]]) + place) * scale
        space.add_lwpolyline(box.tolist(), close=True, dxfattribs={"layer": layers["sheet"][0]})
        low, high = np.minimum(low, box.min(axis=0)), np.maximum(high, box.max(axis=0))
        for key, outline in zip(sheet.numbers, sheet.outlines, strict=True):
            inner = _carry(panels[key], outline)
            _draw_panel(
                space, panels[key], (outline + place) * scale, (inner + place) * scale, layers
            )
    large = ", ".join(model.panels[key].name for key in nesting.oversize)
    legend = [f"{model.design}, {len(nesting.sheets)} sheets of {length:g} x {width:g} m, "
              f"{100 * nesting.use:.1f} % used",
              f"drawn in mm, {describe_scale(options.scale)}"]  # fmt: skip
    legend += [f"larger than a sheet: {large}"] if large else []
    save_dxf(path, document, low, high, legend)


def _carry(flat: FlatPanel, outline: np.ndarray) -> np.ndarray:
    """Return a panel's bend lines (n, 2, 2) moved with its corners to `outline`."""
    side, there = flat.corners[1] - flat.corners[0], outline[1] - outline[0]
    turn = complex(*there) / complex(*side)
    moved = ((flat.inner - flat.corners[0]) @ [1, 1j]) * turn
    return np.stack([moved.real, moved.imag], axis=-1) + outline[0]
