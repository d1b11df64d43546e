"""From the exact cut of a sheet to a mesh that can be analysed: short sides collapsed.

A cut leaves slivers, whose facets spoil stresses. Sides shorter than a tenth of the sheet's mean
crease collapse onto one of their ends, along the side alone: a vertex may only move to one that
lies in all planes that it lies in, so that all polygons stay planar and no seam opens.
"""

from dataclasses import dataclass

import numpy as np

from foldshell.files.errors import InputError
from foldshell.files.meshes.triangles import cut_polygon
from foldshell.pattern.cut import CutSheet
from foldshell.pattern.facet_angles import (
    ANGLES,
    find_bad_facets,
    measure_angles,
    refuse_bad_facets,
)
from foldshell.pattern.overlap import measure_overlap

SHORT = (0.1, 0.07, 0.05, 0.03, 0.02)
"""Sides shorter than this, of the mean side of the whole sheet's panels, collapse: the first that
follows the outline well enough."""
FOLLOWED = 0.995
"""Overlap with the outline, intersection over union in plan, that is well enough."""
SHORTER = (0.1, 0.15, 0.2, 0.3)
"""The same where facets are left outside `ANGLES`, one after the other, about those facets."""
COSINE = np.cos(np.radians(15.0))
"""Of the angle by which a polygon's normal may turn where a vertex leaves a plane."""


@dataclass(frozen=True)
class ShellCut:
    """Facets (F, 3) of a cut sheet for analysis, the polygon (F,) of each, and vertices (V, 3) m:
    those of the cut, and behind them one on the line between two others for each of `added`:
    both of them, and the share of the way."""

    vertices: np.ndarray
    facets: np.ndarray
    polygon: np.ndarray
    added: tuple[tuple[int, int, float], ...] = ()

    def place(self, state: np.ndarray) -> np.ndarray:
        """Return another state (N, 3) m of the cut's vertices with those that were added."""
        found = list(state)
        for start, end, share in self.added:
            found.append((1 - share) * found[start] + share * found[end])
        return np.array(found)


def make_shell_cut(cut: CutSheet, ell: float) -> ShellCut:
    """Collapse short sides and cut polygons into facets; `ell` is the mean side of panels, m.

    Where facets stay outside `ANGLES`, sides about them collapse that are a little longer, thin
    polygons become the side that they lie on, and in the end a vertex may leave a plane, by less
    than the side that collapses.

    Raises
    ------
    InputError
        that names the place of a facet that cannot be brought inside `ANGLES`.
    """
    best, least = None, 0.0
    for short in SHORT:
        found = _try_shell_cut(cut, ell, short)
        if find_bad_facets(found.vertices, found.facets).any():
            best = best or found
            continue
        share = measure_overlap(found.vertices, found.facets, cut.plan)
        if share > least:
            best, least = found, share
        if share >= FOLLOWED:
            break
    refuse_bad_facets(best.vertices, best.facets)
    return best


def _try_shell_cut(cut: CutSheet, ell: float, short: float) -> ShellCut:
    rings = Rings([ring.tolist() for ring in cut.polygons], cut)
    rings.collapse(short * ell, set(range(len(rings.rings))), rings.patches)
    for share in SHORTER:
        for planes in (rings.patches, rings.panels, None):
            bad = rings.find_bad()
            if bad:
                rings.collapse(share * ell, bad, planes)
        rings.flatten(rings.find_bad(), share * ell)
        rings.refine(share * ell)
    facets, polygon = rings.cut_facets()
    return ShellCut(rings.vertices, facets, np.array(rings.origin)[polygon], tuple(rings.added))


def _cut(ring: list[int], vertices: np.ndarray) -> np.ndarray:
    return np.array(ring)[None] if len(ring) == 3 else cut_polygon(vertices, np.array(ring))


class Rings:
    """Polygons of a cut sheet as rings of vertices, whose sides collapse one by one."""

    def __init__(self, rings: list[list[int]], cut: CutSheet) -> None:
        self.rings, self.vertices = rings, cut.folded
        self.patches = _list_owners(rings, cut.patch)
        self.panels = _list_owners(rings, cut.parent)
        self.origin = list(range(len(rings)))
        self.added: list[tuple[int, int, float]] = []

    def cut_facets(self) -> tuple[np.ndarray, np.ndarray]:
        """Return facets (F, 3) of what is left, as vertices, and the polygon (F,) of each.

        They are numbers.
        """
        found = [(k, _cut(ring, self.vertices)) for k, ring in enumerate(self.rings) if ring]
        if not found:
            raise InputError(
                "outline: it leaves less of the sheet than can be analysed, a tenth of a panel's "
                "side and less"
            )
        facets = np.concatenate([facets for _, facets in found])
        return facets, np.concatenate([np.full(len(facets), k) for k, facets in found])

    def find_bad(self) -> set[int]:
        """Return the polygons that have a facet outside `ANGLES`."""
        facets, polygon = self.cut_facets()
        return set(polygon[find_bad_facets(self.vertices, facets)].tolist())

    def collapse(self, least: float, about: set[int], planes: dict[int, set[int]] | None) -> None:
        """Collapse sides shorter than `least` m of some polygons, the shortest first.

        A vertex goes to one that lies in all of its `planes`, to any where these are None.
        """
        refused: set[tuple[int, int]] = set()
        short = {k for k in about if self._has_short(k, least)}
        while (move := self._find_move(least, short, planes, refused)) is not None:
            gone, kept = move
            own = [k for k, ring in enumerate(self.rings) if gone in ring]
            trial = {k: _without(self.rings[k], gone, kept) for k in own}
            if any(_turned(self.vertices, self.rings[k], ring) for k, ring in trial.items()):
                refused.add(move)
                continue
            for k, ring in trial.items():
                self.rings[k] = ring
            short |= about & {k for k in trial if self._has_short(k, least)}

    def _has_short(self, k: int, least: float) -> bool:
        points = self.vertices[self.rings[k]]
        return bool((np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1) < least).any())

    def _find_move(
        self,
        least: float,
        about: set[int],
        planes: dict[int, set[int]] | None,
        refused: set[tuple[int, int]],
    ) -> tuple[int, int] | None:
        """Return the vertex that goes and the one that stays, of the shortest side that may go."""
        best, shortest = None, least
        for k in about:
            ring = self.rings[k]
            for i, a in enumerate(ring):
                b = ring[(i + 1) % len(ring)]
                length = float(np.linalg.norm(self.vertices[b] - self.vertices[a]))
                if length >= shortest:
                    continue
                for move in sorted(((a, b), (b, a)), key=lambda m: len(self.patches[m[0]])):
                    allowed = planes is None or planes[move[0]] <= planes[move[1]]
                    if allowed and move not in refused:
                        best, shortest = move, length
                        break
        return best

    def flatten(self, bad: set[int], least: float) -> None:
        """Put the corners of thin polygons onto their longest side, if they lie nearer than
        `least` m to it: that of the polygon beyond it, or nobody's on the border."""
        for k in sorted(bad):
            ring = self.rings[k]
            if not ring:
                continue
            points = self.vertices[ring]
            sides = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
            at = int(sides.argmax())
            ring = ring[at:] + ring[:at]
            start, end = self.vertices[ring[0]], self.vertices[ring[1]]
            along = (end - start) / sides[at]
            others = self.vertices[ring[2:]] - start
            share = others @ along
            height = np.linalg.norm(others - share[:, None] * along, axis=1)
            ordered = (np.diff([sides[at], *share, 0.0]) < 0).all()
            if height.max() < least and ordered:
                beyond = self._find_beyond(ring[0], ring[1])
                self._put_between(beyond, ring[1], ring[0], ring[2:])
                self.rings[k] = []

    def refine(self, least: float) -> None:
        """Part a facet with an angle above the largest one at the foot of that corner on the side
        beyond, or, where its other angles are too small, give it to the polygon beyond if the
        corner lies nearer than `least` m to that side."""
        facets, polygon = self.cut_facets()
        bad = find_bad_facets(self.vertices, facets)
        touched: set[int] = set()
        for facet, k in zip(facets[bad].tolist(), polygon[bad].tolist(), strict=True):
            angles = measure_angles(self.vertices, np.array([facet]))[0]
            corner = int(angles.argmax())
            start, end = facet[(corner + 1) % 3], facet[(corner + 2) % 3]
            ring = self.rings[k]
            beyond = self._find_beyond(start, end)
            if angles[corner] <= ANGLES[1] or {k, beyond} & touched or start not in ring:
                continue
            at = ring.index(start)
            if ring[(at + 1) % len(ring)] != end:
                continue
            touched |= {k} if beyond is None else {k, beyond}
            share, height = self._find_foot(facet[corner], start, end)
            if np.delete(angles, corner).min() > ANGLES[0]:
                self.added.append((start, end, share))
                foot = (1 - share) * self.vertices[start] + share * self.vertices[end]
                self.vertices = np.vstack([self.vertices, foot])
                new = len(self.vertices) - 1
                ring.insert(at + 1, new)
                self._put_between(beyond, end, start, [new])
            elif height < least:
                self._put_between(beyond, end, start, [facet[corner]])
                self._part(k, at, ring.index(facet[corner]))

    def _find_foot(self, corner: int, start: int, end: int) -> tuple[float, float]:
        """Return where on a side a corner's foot is, as a share of it, and how far off it is."""
        a, b, point = (self.vertices[k] for k in (start, end, corner))
        share = float((point - a) @ (b - a) / ((b - a) @ (b - a)))
        return share, float(np.linalg.norm(point - a - share * (b - a)))

    def _part(self, k: int, at: int, corner: int) -> None:
        """Take the triangle of a ring's side and one of its corners off it: one or two are left."""
        ring = self.rings[k]
        turned = ring[at + 1 :] + ring[: at + 1]
        place = turned.index(ring[corner])
        parts = [part for part in (turned[: place + 1], turned[place:]) if len(part) > 2]
        self.rings[k] = parts[0] if parts else []
        self.rings += parts[1:]
        self.origin += [self.origin[k]] * len(parts[1:])

    def _find_beyond(self, start: int, end: int) -> int | None:
        """Return the polygon that has a side the other way round, None on the border."""
        for k, ring in enumerate(self.rings):
            if end in ring and ring[(ring.index(end) + 1) % len(ring)] == start:
                return k
        return None

    def _put_between(self, k: int | None, start: int, end: int, others: list[int]) -> None:
        if k is not None:
            at = self.rings[k].index(start) + 1
            self.rings[k][at:at] = others


def _list_owners(rings: list[list[int]], owner: np.ndarray) -> dict[int, set[int]]:
    """Return the planes or panels of the polygons about each vertex."""
    found: dict[int, set[int]] = {}
    for k, ring in enumerate(rings):
        for vertex in ring:
            found.setdefault(vertex, set()).add(int(owner[k]))
    return found


def _without(ring: list[int], gone: int, kept: int) -> list[int]:
    """Return a ring in which one vertex stands for another, empty where nothing is left of it."""
    found = [kept if vertex == gone else vertex for vertex in ring]
    while True:
        size = len(found)
        if size < 3:
            return []
        drop = next(
            (
                k
                for k in range(size)
                if found[k] == found[k - 1] or found[k - 1] == found[(k + 1) % size]
            ),
            None,
        )
        if drop is None:
            return found
        del found[drop]


def _turned(vertices: np.ndarray, before: list[int], after: list[int]) -> bool:
    """Tell whether a polygon turned over, lost its simple shape, or has no area left."""
    if not after:
        return False
    first, second = (_area_vector(vertices[ring]) for ring in (before, after))
    size = np.linalg.norm(second)
    if second @ first <= COSINE * size * np.linalg.norm(first):
        return True
    if len(set(after)) < len(after):
        return True
    facets = _cut(after, vertices)
    corner = vertices[facets]
    turn = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]) @ second
    return bool((turn <= 1e-9 * size**2).any())


def _area_vector(points: np.ndarray) -> np.ndarray:
    return np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0) / 2
