"""Panels on sheets of a given size, one thickness class to a sheet.

Large panels lie in rows (`row_packing`), small ones, of which a sheet takes many, are nested by
sparrow (Gardeyn, Vanden Berghe & Wauters 2025, through spyrrow). Every sheet is checked with
shapely before it counts: inside its sheet, no two panels over one another.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest

import numpy as np

from foldshell.exchange.flat_panels import FlatPanel
from foldshell.exchange.options import load_library
from foldshell.exchange.row_packing import RowPacker
from foldshell.files.errors import InputError

GAP = 0.002
"""Between panels of a sheet, m: the width of a cut."""
MANY = 8
"""From so many panels a sheet on, by area, the library nests."""
FILL = (0.88, 0.85, 0.82, 0.79, 0.76, 0.72, 0.66, 0.6, 0.5, 0.35, 0.0)
"""Shares of a sheet's area that are tried, the largest first; at the last a panel stands alone."""
TRIES = 3
"""Of the library for a sheet, as a rule."""
SEED = 1


@dataclass(frozen=True)
class Sheet:
    """Panels on one sheet: numbers, and where the corners of each lie, (k, 2) m."""

    thickness_class: int
    numbers: tuple[int, ...]
    outlines: tuple[np.ndarray, ...]


@dataclass(frozen=True)
class Nesting:
    """All sheets; `oversize` are panels that no sheet takes; `use`, area of panels by sheets."""

    sheets: tuple[Sheet, ...]
    oversize: tuple[int, ...]
    use: float


def nest_panels(panels: Sequence[FlatPanel], length: float, width: float, seconds: int) -> Nesting:
    """Nest panels on sheets of length x width m, class by class.

    `seconds` is what the library may take for all sheets together, at least one for each try.
    """
    groups: dict[tuple[bool, int], list[FlatPanel]] = {}
    for panel in panels:
        key = (panel.panel.sized, panel.panel.thickness_class)
        groups.setdefault(key, []).append(panel)
    small = sum(flat.area for flat in panels if _is_small(flat.corners, length, width))
    seconds = max(1, int(seconds / (TRIES * (small / (length * width) + len(groups)))))
    sheets: list[Sheet] = []
    oversize: list[int] = []
    for (_, number), group in sorted(groups.items(), key=lambda item: item[0]):
        outlines = {panel.panel.number: panel.corners for panel in group}
        made, large = _nest_group(outlines, length, width, seconds)
        oversize += large
        sheets += [Sheet(number, keys, places) for keys, places in made]
    for sheet in sheets:
        check_sheet(sheet, length, width)
    area = sum(_area(outline) for sheet in sheets for outline in sheet.outlines)
    use = area / (len(sheets) * length * width) if sheets else 0.0
    return Nesting(tuple(sheets), tuple(sorted(oversize)), use)


def _nest_group(outlines: dict[int, np.ndarray], length: float, width: float, seconds: int):
    """Return sheets (keys, outlines) of one class, and the keys of panels that no sheet takes."""
    small = {key: outline for key, outline in outlines.items() if _is_small(outline, length, width)}
    large = {key: outline for key, outline in outlines.items() if key not in small}
    packer = RowPacker(large, length, width, GAP)
    single = [(row.keys, row.outlines) for row in packer.fill()]
    sheets = min(single, _in_two_rows(large, length, width), key=len)
    while small:
        keys, places = _fill_sheet(small, length, width, seconds)
        sheets.append((keys, places))
        for key in keys:
            del small[key]
    return sheets, packer.oversize


def _is_small(outline: np.ndarray, length: float, width: float) -> bool:
    """Whether a sheet takes many such panels, in any turn."""
    reach = np.linalg.norm(outline[:, None] - outline[None], axis=2).max()
    return MANY * _area(outline) <= length * width and reach <= min(length, width)


def _in_two_rows(outlines: dict[int, np.ndarray], length: float, width: float):
    """Lay panels of at most half the sheet's width in two rows a sheet, the others in one."""
    half = (width - GAP) / 2
    thin = {key: outline for key, outline in outlines.items() if least_width(outline) <= half}
    thick = {key: outline for key, outline in outlines.items() if key not in thin}
    sheets = [(row.keys, row.outlines) for row in RowPacker(thick, length, width, GAP).fill()]
    packer = RowPacker(thin, length, half, GAP)
    rows = packer.fill()
    for low, high in zip_longest(rows[::2], rows[1::2]):
        keys, places = list(low.keys), list(low.outlines)
        if high is not None:
            keys += high.keys
            places += [outline + np.array([0.0, half + GAP]) for outline in high.outlines]
        sheets.append((tuple(keys), tuple(places)))
    return sheets


def least_width(outline: np.ndarray) -> float:
    """Return the least distance of parallels that hold a convex outline (k, 2) between them, m."""
    along = np.roll(outline, -1, axis=0) - outline
    unit = along / np.linalg.norm(along, axis=1, keepdims=True)
    away = unit[:, 0, None] * (outline[:, 1] - outline[:, 1, None])
    away -= unit[:, 1, None] * (outline[:, 0] - outline[:, 0, None])
    return float(np.ptp(away, axis=1).min())


def _fill_sheet(left: dict[int, np.ndarray], length: float, width: float, seconds: int):
    """Take the largest panels that fill a share of the sheet, and less until they fit it."""
    order = sorted(left, key=lambda key: (-_area(left[key]), key))
    tried = None
    for share in FILL:
        keys, room = [], share * length * width
        for key in order:
            if not keys or _area(left[key]) <= room:
                keys.append(key)
                room -= _area(left[key])
        if keys == tried:
            continue
        tried, places = keys, _nest_strip({key: left[key] for key in keys}, width, seconds)
        if places and max(outline[:, 0].max() for outline in places) <= length:
            return tuple(keys), tuple(places)
    row = RowPacker({order[0]: left[order[0]]}, length, width, GAP).fill()[0]
    return row.keys, row.outlines


def _nest_strip(outlines: dict[int, np.ndarray], width: float, seconds: int) -> list[np.ndarray]:
    """Nest outlines on as short a strip as the library finds; the corners of each, (k, 2) m.

    Empty where the library gives up, as it does (it panics) where it finds no turn of a panel that
    is nearly as wide as the strip.
    """
    spyrrow = load_library("spyrrow")
    items = [
        spyrrow.Item(str(key), [tuple(point) for point in outline.tolist()], 1, None)
        for key, outline in outlines.items()
    ]
    problem = spyrrow.StripPackingInstance("sheet", width, items)
    config = spyrrow.StripPackingConfig(
        early_termination=True, total_computation_time=seconds, num_workers=1, seed=SEED,
        min_items_separation=GAP,
    )  # fmt: skip
    try:
        solution = problem.solve(config)
    except BaseException as error:  # what Rust calls a panic is no Exception
        if type(error).__name__ != "PanicException":
            raise
        return []
    places = {}
    for item in solution.placed_items:
        angle = np.radians(item.rotation)
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        places[int(item.id)] = outlines[int(item.id)] @ turn + item.translation
    low = np.min([outline.min(axis=0) for outline in places.values()], axis=0)
    return [places[key] - low for key in outlines]


def check_sheet(sheet: Sheet, length: float, width: float) -> None:
    """Raise `InputError` where panels of a sheet overlap or leave it by more than 1e-6 m."""
    shapely = load_library("shapely")
    shapes = [shapely.Polygon(outline) for outline in sheet.outlines]
    box = shapely.box(-1e-6, -1e-6, length + 1e-6, width + 1e-6)
    for shape, number in zip(shapes, sheet.numbers, strict=True):
        if not box.covers(shape):
            raise InputError(f"exports: nesting: panel {number} leaves its sheet")
    tree = shapely.STRtree(shapes)
    for a, b in tree.query(shapes, predicate="intersects").T.tolist():
        if a < b and shapes[a].intersection(shapes[b]).area > 1e-9:
            raise InputError(
                f"exports: nesting: panels {sheet.numbers[a]} and {sheet.numbers[b]} overlap"
            )


def _area(outline: np.ndarray) -> float:
    x, y = outline.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
