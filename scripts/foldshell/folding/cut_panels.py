"""A sheet cut by an outline: the exact pieces, and the panels that are analysed and sized."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from foldshell.files.errors import InputError
from foldshell.pattern.cut import CutSheet, cut_sheet, select_polygons
from foldshell.pattern.outline import Outline
from foldshell.pattern.overlap import measure_overlap
from foldshell.pattern.panel_graph import Ragged, join_groups, join_polygons, make_ragged
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.pattern.slivers import ShellCut, make_shell_cut

CRUMB = 0.01
"""Parts of less than this share of the area, joined to nothing, are left out."""
COVERED = 0.98
"""Share of the outline's area from which it is not said how much of it the sheet covers."""
SMALL = 0.03
"""Pieces of less than this share of their panel take the thickness of a neighbour."""


@dataclass(frozen=True)
class CutPanels:
    """What an outline leaves of a sheet.

    Attributes
    ----------
    exact : the planar pieces as the outline cuts them, with creases, folded and flat
    piece_panel : (K,) panel that each exact piece belongs to: what is sized
    shell : the panels that are analysed and sized, short sides collapsed, with their creases
    facets, facet_panel : (F, 3) vertices of `shell`, and the panel (F,) of each
    exact_share, shell_share : intersection over union with the outline, in plan, of both
    covered : share of the outline's area in plan that the sheet covers
    """

    exact: PanelMesh
    piece_panel: np.ndarray
    shell: PanelMesh
    facets: np.ndarray
    facet_panel: np.ndarray
    exact_share: float
    shell_share: float
    covered: float


def cut_panels(
    mesh: PanelMesh, facets: np.ndarray, facet_panel: np.ndarray, outline: Outline
) -> CutPanels:
    """Cut a folded sheet with facets (F, 3) of panels (F,) by an outline.

    Raises
    ------
    InputError
        for an outline that meets no panel or parts the sheet, and for facets that cannot be
        analysed.

    All are numbers.
    """
    ends = mesh.vertices[mesh.edges]
    ell = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())
    cut, notes = _drop_crumbs(cut_sheet(mesh, facets, facet_panel, outline))
    covered = _measure_cover(cut.plan, outline)
    if covered < COVERED:
        notes = (*notes, f"outline: the sheet covers {100 * covered:.3g} % of its area")
    mesh = replace(mesh, notes=(*mesh.notes, *outline.notes, *notes))
    shell = make_shell_cut(cut, ell)
    piece = _join_pieces(cut)
    panel = _share_small(cut, shell, piece)
    letters = _list_letters(mesh)
    exact = _make_exact(mesh, cut, panel, letters)
    return CutPanels(
        exact, panel, *_make_shell(mesh, cut, shell, panel, letters),
        measure_overlap(cut.folded, cut.polygons, cut.plan),
        measure_overlap(shell.vertices, shell.facets, cut.plan),
        covered,
    )  # fmt: skip


def _measure_cover(plan: Any, outline: Outline) -> float:
    if outline.outer is None:
        return 1.0
    import shapely

    return float(plan.area / shapely.Polygon(outline.outer, outline.openings).area)


def _sides(polygons: Ragged) -> dict[tuple[int, int], list[int]]:
    """Return the polygons at each side, by its lower and its higher vertex."""
    found: dict[tuple[int, int], list[int]] = {}
    for k, ring in enumerate(polygons):
        for a, b in zip(ring.tolist(), np.roll(ring, -1).tolist(), strict=True):
            found.setdefault((min(a, b), max(a, b)), []).append(k)
    return found


def find_parts(polygons: Ragged) -> np.ndarray:
    """Return the number (K,) of the part of each polygon: parts are joined by sides."""
    pairs = [own[:2] for own in _sides(polygons).values() if len(own) > 1]
    return join_groups(len(polygons), np.array(pairs, dtype=np.int64).reshape(-1, 2))


def _drop_crumbs(cut: CutSheet) -> tuple[CutSheet, tuple[str, ...]]:
    """Leave out parts that are next to nothing, such as the tip of a zig-zag beyond the border.

    Raises `InputError` where a larger part is joined to the rest by no side.
    """
    part, area = find_parts(cut.polygons), _measure_areas(cut.folded, cut.polygons)
    total = np.bincount(part, area)
    crumb = total < CRUMB * total.sum()
    notes = []
    for k in np.flatnonzero(crumb).tolist():
        place = _say_place(cut.folded, cut.polygons, part == k)
        notes.append(f"outline: a part of {total[k]:.2g} m2 about {place} m is left out")
    if (~crumb).sum() > 1:
        least = int(np.where(crumb, np.inf, total).argmin())
        place = _say_place(cut.folded, cut.polygons, part == least)
        raise InputError(
            f"outline: it parts the sheet in {int((~crumb).sum())} pieces that no fold joins, the "
            f"least of {total[least]:.3g} m2 about {place} m: an outline that leaves one piece is "
            "due"
        )
    return select_polygons(cut, ~crumb[part]), tuple(notes)


def _say_place(vertices: np.ndarray, polygons: Ragged, chosen: np.ndarray) -> str:
    corners = np.concatenate([polygons[int(k)] for k in np.flatnonzero(chosen)])
    return "(" + ", ".join(f"{value:.3f}" for value in vertices[corners].mean(axis=0)) + ")"


def _join_pieces(cut: CutSheet) -> np.ndarray:
    """Return the piece (K,) of each polygon: those of one panel that share a side are one, where
    they have one border."""
    pairs = [
        (own[0], own[1])
        for own in _sides(cut.polygons).values()
        if len(own) == 2 and cut.parent[own[0]] == cut.parent[own[1]]
    ]
    piece = join_groups(len(cut.parent), np.array(pairs, dtype=np.int64).reshape(-1, 2))
    for number in np.unique(piece).tolist():
        own = np.flatnonzero(piece == number)
        if len(own) > 1 and len(join_polygons(cut.polygons, own)) > 1:
            piece[own[1:]] = piece.max() + 1 + np.arange(len(own) - 1)
    return np.unique(piece, return_inverse=True)[1].ravel()


def _share_small(cut: CutSheet, shell: ShellCut, piece: np.ndarray) -> np.ndarray:
    """Return the panel (K,) that each polygon is sized with, in the order of the whole sheet's.

    Pieces below `SMALL` of their panel, and those of which nothing is analysed, go to the
    neighbour with the longest side in common.
    """
    area = np.bincount(piece, _measure_areas(cut.folded, cut.polygons))
    left = np.bincount(piece[shell.polygon], _facet_areas(shell), minlength=len(area))
    parent = np.zeros(len(area), dtype=np.int64)
    parent[piece] = cut.parent
    due = (area < SMALL * cut.area_before[parent]) | (left <= 0)
    beside = _measure_common(cut, piece)
    host = np.arange(len(area))
    for k in np.flatnonzero(due)[np.argsort(area[due])].tolist():
        near = sorted(
            ((length, other) for other, length in beside.get(k, {}).items()), reverse=True
        )
        others = [other for _, other in near if not due[other]]
        if others or near:
            host[k] = others[0] if others else near[0][1]
    for _ in range(len(host)):
        if (host[host] == host).all():
            break
        host = host[host]
    order = np.lexsort((np.arange(len(area)), parent))
    rank = np.empty(len(area), dtype=np.int64)
    rank[order] = np.arange(len(area))
    return np.unique(rank[host[piece]], return_inverse=True)[1].ravel()


def _measure_areas(vertices: np.ndarray, polygons: Ragged) -> np.ndarray:
    return np.array([
        np.linalg.norm(
            np.cross(vertices[ring], vertices[np.roll(ring, -1)]).sum(axis=0)
        ) / 2 for ring in polygons
    ])  # fmt: skip


def _facet_areas(shell: ShellCut) -> np.ndarray:
    corner = shell.vertices[shell.facets]
    double = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    return np.linalg.norm(double, axis=1) / 2


def _measure_common(cut: CutSheet, piece: np.ndarray) -> dict[int, dict[int, float]]:
    """Return the length (m) of the sides that pieces have in common, by both pieces."""
    found: dict[int, dict[int, float]] = {}
    for (a, b), own in _sides(cut.polygons).items():
        length = float(np.linalg.norm(cut.folded[a] - cut.folded[b]))
        numbers = {int(piece[k]) for k in own}
        for one in numbers:
            for other in numbers - {one}:
                row = found.setdefault(one, {})
                row[other] = row.get(other, 0.0) + length
    return found


def _list_letters(mesh: PanelMesh) -> dict[tuple[int, int], str]:
    """Return how the sheet folds between two of its panels, by their numbers."""
    beside = _sides(mesh.panels)
    return {
        tuple(sorted(beside[tuple(sorted(edge))])): str(letter)
        for edge, letter in zip(mesh.edges.tolist(), mesh.assignments.tolist(), strict=True)
        if len(beside.get(tuple(sorted(edge)), ())) == 2
    }


def _find_edges(
    polygons: Ragged, parent: np.ndarray, letters: dict[tuple[int, int], str]
) -> tuple[np.ndarray, np.ndarray]:
    """Return sides (X, 2) between pieces of different panels or at the border, and their letters.

    A side inside a panel of the whole sheet that two pieces share is flat.
    """
    edges, found = [], []
    for side, own in _sides(polygons).items():
        edges.append(side)
        if len(own) == 1:
            found.append("B")
        elif parent[own[0]] == parent[own[1]]:
            found.append("F")
        else:
            pair = tuple(sorted((int(parent[own[0]]), int(parent[own[1]]))))
            found.append(letters.get(pair, "U"))
    return np.array(edges), np.array(found)


def _make_exact(
    mesh: PanelMesh, cut: CutSheet, panel: np.ndarray, letters: dict[tuple[int, int], str]
) -> PanelMesh:
    edges, kinds = _find_edges(cut.polygons, cut.parent, letters)
    return PanelMesh(
        cut.polygons, edges, kinds, np.full(len(edges), np.nan), flat=cut.flat, folded=cut.folded,
        labels={"panel": panel, "parent": cut.parent}, notes=mesh.notes,
    )  # fmt: skip


def _make_shell(
    mesh: PanelMesh,
    cut: CutSheet,
    shell: ShellCut,
    panel: np.ndarray,
    letters: dict[tuple[int, int], str],
) -> tuple[PanelMesh, np.ndarray, np.ndarray]:
    """Return the panels that are analysed, their facets (F, 3) and the panel (F,) of each."""
    order = np.argsort(panel[shell.polygon], kind="stable")
    facets, owner = shell.facets[order], shell.polygon[order]
    facet_panel = panel[owner]
    used, number = np.unique(facets, return_inverse=True)
    facets = number.reshape(-1, 3)
    rows = Ragged(3 * np.arange(len(facets) + 1), facets.ravel())
    if find_parts(rows).max() > 0:
        raise InputError("outline: what is left of the sheet hangs together by points alone")
    loops = [
        max(join_polygons(rows, np.flatnonzero(facet_panel == k)), key=len)
        for k in range(int(panel.max()) + 1)
    ]
    edges, kinds = _find_edges(rows, cut.parent[owner], letters)
    inner = kinds == "F"
    outside = {tuple(sorted(side)) for side in _list_loop_sides(loops)}
    keep = np.array([tuple(edge) in outside for edge in edges.tolist()]) | ~inner
    largest = _find_largest(cut, panel)
    labels = {name: values[cut.parent[largest]] for name, values in mesh.labels.items()}
    flat = None if cut.flat is None else shell.place(cut.flat)[used]
    panels = PanelMesh(
        make_ragged(loops), edges[keep], kinds[keep], np.full(int(keep.sum()), np.nan),
        flat=flat, folded=shell.vertices[used], labels=labels, notes=mesh.notes,
    )  # fmt: skip
    return panels, facets, facet_panel


def _list_loop_sides(loops: list[list[int]]) -> list[tuple[int, int]]:
    return [pair for loop in loops for pair in zip(loop, [*loop[1:], loop[0]], strict=True)]


def _find_largest(cut: CutSheet, panel: np.ndarray) -> np.ndarray:
    """Return the largest polygon of each panel."""
    area = _measure_areas(cut.folded, cut.polygons)
    order = np.lexsort((-area, panel))
    _, first = np.unique(panel[order], return_index=True)
    return order[first]
