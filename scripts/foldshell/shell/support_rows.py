"""From the rows of a set of supports to what they hold of a sheet, and what is to be said of it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.settings.support_row import AXES, SupportRow
from foldshell.settings.where import POINT, read_where
from foldshell.shell.boundary import Hold
from foldshell.shell.select import HeldSheet, select

FAR = 0.05
"""A point whose nearest vertex is farther off than this share of the plan is spoken of."""
LISTED = 5


@dataclass(frozen=True)
class HeldRows:
    """What the rows of a set hold of a sheet: names, holds, and sentences that are to be said."""

    names: tuple[str, ...]
    holds: tuple[Hold, ...]
    reports: tuple[str, ...]
    warnings: tuple[str, ...]

    def to_arrays(self) -> dict[str, np.ndarray]:
        """Return what mesh.npz holds of them; R rows, S edges and Q vertices of all rows."""
        count = np.arange(len(self.holds))
        edges = [len(hold.pairs) for hold in self.holds]
        points = [len(hold.vertices) for hold in self.holds]
        return {
            "support_pairs": np.concatenate([hold.pairs for hold in self.holds]),
            "support_border": np.repeat(count, edges),
            "support_vertices": np.concatenate([hold.vertices for hold in self.holds]),
            "support_vertex_row": np.repeat(count, points),
            "support_names": np.array(self.names),
            "support_fix": np.array([hold.fix for hold in self.holds]),
            "support_clamp": np.array([hold.clamp for hold in self.holds]),
            "support_spring": np.array([hold.spring for hold in self.holds]),
            "support_warnings": np.array(self.warnings, dtype=str),
            "support_reports": np.array(self.reports, dtype=str),
        }


def resolve_rows(sheet: HeldSheet, rows: Sequence[SupportRow]) -> HeldRows:
    """Find what each row holds.

    Raises `ValueError` for a row that holds nothing, one that would clamp a vertex, and one with
    springs on edges and vertices at once, whose units differ.
    """
    holds = tuple(_resolve(sheet, row) for row in rows)
    reports = tuple(_report(sheet, row, hold) for row, hold in zip(rows, holds, strict=True))
    warnings = [*_list_far(sheet, rows, holds), *_list_unheld(sheet, rows, holds)]
    return HeldRows(tuple(row.name for row in rows), holds, reports, tuple(warnings))


def _resolve(sheet: HeldSheet, row: SupportRow) -> Hold:
    place = f"support {row.name!r}"
    try:
        pairs, vertices = select(sheet, row.where)
    except ValueError as error:
        raise ValueError(f"{place}: where: {row.where!r}: {error}") from None
    if not len(pairs) + len(vertices):
        raise ValueError(f"{place}: where: {row.where!r}: holds nothing of this sheet")
    if row.clamp and len(vertices):
        raise ValueError(
            f"{place}: clamp: {_name_vertex(sheet, vertices[0])} lies on no edge of the row: a "
            "vertex cannot be clamped, edges can"
        )
    if any(row.spring) and len(pairs) and len(vertices):
        raise ValueError(
            f"{place}: springs on {len(pairs)} edges (kN/m per m) and on "
            f"{_name_vertex(sheet, vertices[0])} (kN/m) at once: one row for each is due"
        )
    fix = np.array([axis in row.fix for axis in AXES])
    return Hold(pairs, vertices, fix, row.clamp, np.array(row.spring, dtype=float))


def _name_vertex(sheet: HeldSheet, vertex: int) -> str:
    place = ", ".join(f"{value:.3f}" for value in sheet.vertices[vertex] + 0.0)
    return f"vertex {vertex} at ({place}) m"


def measure_hold(vertices: np.ndarray, hold: Hold) -> tuple[int, float]:
    """Return how many vertices (V, 3) m a support holds, and the length of its edges in m."""
    ends = vertices[hold.pairs]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
    return len(np.union1d(hold.pairs.ravel(), hold.vertices)), float(length)


def _report(sheet: HeldSheet, row: SupportRow, hold: Hold) -> str:
    count, length = measure_hold(sheet.vertices, hold)
    return (
        f"support {row.name!r}: {len(hold.pairs)} edges of {length:.6g} m, {count} vertices: "
        f"{describe_hold(hold)}"
    )


def describe_hold(hold: Hold) -> str:
    """Return in words how a support holds."""
    words = []
    if hold.fix.any():
        words.append("fixed along " + " ".join(np.array(list(AXES))[hold.fix]))
    if hold.clamp:
        words.append("clamped")
    unit = "kN/m per m" if len(hold.pairs) else "kN/m"
    words += [
        f"spring along {axis} of {value:g} {unit}"
        for axis, value in zip(AXES, hold.spring, strict=True)
        if value
    ]
    return ", ".join(words)


def _list_far(sheet: HeldSheet, rows: Sequence[SupportRow], holds: Sequence[Hold]) -> list[str]:
    """Name points whose nearest vertex is far off."""
    near = FAR * np.linalg.norm(np.ptp(sheet.vertices, axis=0))
    found = []
    for row, hold in zip(rows, holds, strict=True):
        terms = [term for terms in read_where(row.where) for term in terms if term.kind == POINT]
        for point in (point for term in terms for point in term.numbers):
            away = np.linalg.norm(
                sheet.vertices[hold.vertices, : len(point)] - np.array(point), axis=1
            )
            if len(away) and away.min() > near:
                vertex = int(hold.vertices[away.argmin()])
                found.append(
                    f"support {row.name!r}: the vertex nearest to {point} m is {away.min():.3g} m "
                    f"off, {_name_vertex(sheet, vertex)}"
                )
    return found


def _list_unheld(sheet: HeldSheet, rows: Sequence[SupportRow], holds: Sequence[Hold]) -> list[str]:
    """Name border edges that no row holds, in the same straight run as edges that a row holds.

    A border polyline of a label is one run too, though it may be a zig-zag.
    """
    width, edges = len(sheet.vertices), sheet.border.edges
    keys = edges @ [width, 1]
    held = np.isin(keys, np.concatenate([hold.pairs for hold in holds]) @ [width, 1])
    found, spoken = [], held.copy()
    for run in [*_list_straight(sheet), *_list_polylines(sheet)]:
        free = run & ~spoken
        if not free.any() or not (run & held).any():
            continue
        spoken |= free
        name = next(
            row.name
            for row, hold in zip(rows, holds, strict=True)
            if np.isin(keys[run], hold.pairs @ [width, 1]).any()
        )
        places = [f"{a}-{b}" for a, b in edges[free][:LISTED].tolist()]
        more = f" and {int(free.sum()) - LISTED} more" if free.sum() > LISTED else ""
        middle = sheet.vertices[edges[free]].mean(axis=(0, 1)).round(2).tolist()
        found.append(
            f"support {name!r}: {int(free.sum())} border edges of the same run are not held: "
            f"{', '.join(places)}{more}, about {middle} m"
        )
    return found


def _list_straight(sheet: HeldSheet) -> list[np.ndarray]:
    runs = sheet.border.find_runs()
    return [runs == run for run in np.unique(runs)]


def _list_polylines(sheet: HeldSheet) -> list[np.ndarray]:
    edges = sheet.border.edges
    return [
        (values[edges] == end).all(axis=1)
        for values in sheet.labels.values()
        for end in (values[values >= 0].min(initial=0), values.max(initial=0))
    ]
