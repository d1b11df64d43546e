"""Each panel laid flat, seen from its positive side, and what stands along its edges."""

from dataclasses import dataclass

import numpy as np

from foldshell.exchange.model import Crease, ExportModel, Panel


@dataclass(frozen=True)
class Edge:
    """One edge of a flat panel, from its corner k to the next: length m, the panel beyond it (None
    on the border), fold angle in rad (valley positive, nan on the border)."""

    length: float
    neighbour: Panel | None
    fold: float

    @property
    def mitre(self) -> float:
        """Half the fold angle, rad: by so much the cut leans from square, towards the side that
        the panel is seen from where it is positive (a valley)."""
        return self.fold / 2

    @property
    def dihedral(self) -> float:
        """Angle between both panels, pi less the fold, rad."""
        return np.pi - abs(self.fold)


@dataclass(frozen=True)
class FlatPanel:
    """A panel in its plane: corners (k, 2) m counter-clockwise, its first edge along x; `inner`
    (n, 2, 2) m are bend lines with `bends` (n,) rad, none where it is planar; `edges` as many as
    corners."""

    panel: Panel
    corners: np.ndarray
    inner: np.ndarray
    bends: np.ndarray
    edges: tuple[Edge, ...]

    @property
    def area(self) -> float:
        """Area in m2, by the shoelace formula."""
        x, y = self.corners.T
        return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def flatten_panels(model: ExportModel) -> tuple[FlatPanel, ...]:
    """Lay every panel flat: a planar one in its plane, others unfolded about their inner edges."""
    known = {tuple(sorted(crease.ends)): crease for crease in model.creases}
    return tuple(_flatten(model, panel, known) for panel in model.panels)


def _flatten(model: ExportModel, panel: Panel, known: dict[tuple[int, int], Crease]) -> FlatPanel:
    place = _unfold_facets(model, panel)
    corners = np.array([place[vertex] for vertex in panel.corners.tolist()])
    turn = np.conj((corners[1] - corners[0]) / abs(corners[1] - corners[0]))
    origin = corners[0]

    def turned(points) -> np.ndarray:
        """Return places (..., 2) m with the first edge along x."""
        moved = (np.asarray(points) - origin) * turn
        return np.stack([moved.real, moved.imag], axis=-1)

    ends = [[place[a], place[b]] for a, b in panel.inner.tolist() if not panel.planar]
    inner = turned(ends).reshape(-1, 2, 2) if ends else np.empty((0, 2, 2))
    edges = []
    for a, b in zip(panel.corners.tolist(), np.roll(panel.corners, -1).tolist(), strict=True):
        crease = known[tuple(sorted((a, b)))]
        beyond = [number for number in crease.panels if number != panel.number]
        length = float(np.linalg.norm(model.vertices[b] - model.vertices[a]))
        edges.append(Edge(length, model.panels[beyond[0]] if beyond else None, crease.angle))
    return FlatPanel(panel, turned(corners), inner, panel.bends[: len(ends)], tuple(edges))


def _unfold_facets(model: ExportModel, panel: Panel) -> dict[int, complex]:
    """Return a place in the plane for each vertex of a panel: facet after facet, each laid on the
    edge that it shares with those laid before."""
    left = [model.facets[facet].tolist() for facet in panel.facets]
    a, b, c = left.pop(0)
    place = {a: 0j, b: complex(np.linalg.norm(model.vertices[b] - model.vertices[a]))}
    place[c] = _third(model, a, b, c, place)
    while left:
        rest = []
        for facet in left:
            for k in range(3):
                a, b, c = facet[k], facet[(k + 1) % 3], facet[(k + 2) % 3]
                if a in place and b in place:
                    if c not in place:
                        place[c] = _third(model, a, b, c, place)
                    break
            else:
                rest.append(facet)
        left = rest
    return place


def _third(model: ExportModel, a: int, b: int, c: int, place: dict[int, complex]) -> complex:
    """Return the place of corner c of a counter-clockwise facet whose a and b lie already."""
    along, across = model.vertices[b] - model.vertices[a], model.vertices[c] - model.vertices[a]
    length = float(np.linalg.norm(along))
    height = float(np.linalg.norm(np.cross(along, across))) / length
    direction = (place[b] - place[a]) / abs(place[b] - place[a])
    return place[a] + direction * complex(float(along @ across) / length, height)
