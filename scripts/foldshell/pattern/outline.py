"""The polygon that a folded sheet is cut to, and its openings: read, cleaned and checked."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from foldshell.files.errors import InputError
from foldshell.pattern.panel_graph import measure_area
from foldshell.pattern.read_outline import read_outline_file
from foldshell.settings.design import NONE
from foldshell.settings.outline_text import is_outline_file, read_loops

DOUBLED = 1e-6
"""Corners of an outline nearer than this (m) to the one before are one: as vertices of a cut."""
CORNERS_MAX = 2000


@dataclass(frozen=True)
class Outline:
    """Corners (K, 2) m of the outline, counter-clockwise, None where openings alone are cut; those
    of openings, clockwise; `notes` say what was mended."""

    outer: np.ndarray | None
    openings: tuple[np.ndarray, ...] = ()
    notes: tuple[str, ...] = ()


def read_outline(outline: str, openings: str, file_unit: str = "m") -> Outline | None:
    """Return the outline and the openings of two columns of the table, None where both are none.

    Of a file of outlines the largest polygon is the outline, those inside it are openings.

    Raises
    ------
    InputError
        for a polygon that is none, crosses itself, or an opening that is not inside.
    """
    if outline == NONE and openings == NONE:
        return None
    notes: list[str] = []
    outer, holes = None, []
    if outline != NONE:
        loops = _read_column("outline", outline, file_unit, notes)
        order = sorted(loops, key=lambda loop: -abs(measure_area(loop)))
        outer, holes = order[0], order[1:]
    if openings != NONE:
        holes += _read_column("openings", openings, file_unit, notes)
    if outer is not None and measure_area(outer) < 0:
        outer = np.roll(outer[::-1], 1, axis=0)  # its first corner stays the first
    holes = [hole[::-1] if measure_area(hole) > 0 else hole for hole in holes]
    _check_openings(outer, holes)
    return Outline(outer, tuple(holes), tuple(dict.fromkeys(notes)))


def _read_column(column: str, text: str, file_unit: str, notes: list[str]) -> list[np.ndarray]:
    if is_outline_file(text):
        source, loops = text, read_outline_file(text, file_unit, notes)
    else:
        try:
            source, loops = column, [np.array(loop) for loop in read_loops(text)]
        except ValueError as error:
            raise InputError(f"{column}: {text!r}: {error}") from None
    found = [_clean(loop, f"{source}: polygon {k}", notes) for k, loop in enumerate(loops, 1)]
    if not found:
        raise InputError(f"{source}: holds no polygon")
    return found


def _clean(loop: np.ndarray, place: str, notes: list[str]) -> np.ndarray:
    """Drop corners that stand twice; refuse what is no simple polygon."""
    if not np.isfinite(loop).all():
        raise InputError(f"{place}: a coordinate that is no finite number")
    if len(loop) > CORNERS_MAX:
        raise InputError(f"{place}: {len(loop)} corners: at most {CORNERS_MAX} are allowed")
    away = np.linalg.norm(loop - np.roll(loop, -1, axis=0), axis=1)
    keep = away > DOUBLED
    if not keep.all() and keep.any():
        if not keep[:-1].all():  # a ring may end where it began
            notes.append(f"{place}: {int((~keep).sum())} corners that stand twice are one each")
        loop = loop[keep]
    if len(loop) < 3:
        raise InputError(f"{place}: {len(loop)} different corners: at least 3 are due")
    size = np.ptp(loop, axis=0).max()
    if abs(measure_area(loop)) <= 1e-9 * size**2:
        raise InputError(f"{place}: its corners enclose no area")
    shape = _polygon(loop)
    if not shape.is_valid:
        from shapely.validation import explain_validity

        words = explain_validity(shape).replace("Self-intersection", "crosses itself at ")
        words = words.replace("Ring ", "").replace("[", "(").replace("]", ") m")
        raise InputError(f"{place}: {words}: a simple polygon is allowed")
    return loop


def _polygon(loop: np.ndarray) -> Any:
    from shapely import Polygon  # only where an outline is cut

    return Polygon(loop)


def _check_openings(outer: np.ndarray | None, holes: Sequence[np.ndarray]) -> None:
    """Refuse openings that are not inside the outline, or that touch it or each other."""
    shapes = [_polygon(hole) for hole in holes]
    whole = None if outer is None else _polygon(outer)
    for k, shape in enumerate(shapes, 1):
        middle = _say(shape.representative_point())
        if whole is not None and not whole.contains(shape):
            inside = whole.intersects(shape)
            words = "reaches beyond" if inside else "lies outside"
            raise InputError(f"openings: opening {k} about {middle} {words} the outline")
        if whole is not None and shape.touches(whole.boundary) | shape.intersects(whole.boundary):
            raise InputError(
                f"openings: opening {k} about {middle} touches the outline: draw it as a part of "
                "the outline"
            )
        for other, second in enumerate(shapes[: k - 1], 1):
            if shape.intersects(second):
                raise InputError(
                    f"openings: openings {other} and {k} about {middle} touch or overlap: one "
                    "polygon for both is allowed"
                )


def _say(point: Any) -> str:
    return f"({point.x:.3f}, {point.y:.3f}) m"


def make_region(outline: Outline, sheet: Any) -> Any:
    """Return what the outline leaves of the plane, a polygon of shapely.

    Without an outline it is a box beyond the sheet's plan, so that the sheet's own border stays.
    """
    if outline.outer is None:
        x, y, right, top = sheet.bounds
        beyond = 0.1 * max(right - x, top - y)
        region = _polygon(np.array([[x, y], [right, y], [right, top], [x, top]]))
        region = region.buffer(beyond, join_style="mitre")
    else:
        region = _polygon(outline.outer)
    for hole in outline.openings:
        region = region.difference(_polygon(hole))
    return region
