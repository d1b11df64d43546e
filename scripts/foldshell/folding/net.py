"""A crease pattern of any panels as the folding engine takes it: facets, hinges, sets, borders."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foldshell.folding.panel_quality import FacetNet, make_facet_net
from foldshell.pattern.fans import find_families, find_line_chains, group_sectors, list_fans
from foldshell.pattern.grid import Hinges, find_hinges
from foldshell.pattern.panel_mesh import PanelMesh

MISSING = 1e-6  # rad: a smaller angle on a mountain or valley counts as not given


@dataclass(frozen=True)
class FoldNet:
    """A flat pattern with all that folding asks of its graph; made by `make_net`.

    `rest` (H,) [rad] are the angles that hinges fold to, 0 across panels and where nothing is
    assigned; `given` tells whether the file gave them, or all count as folded shut.
    """

    mesh: PanelMesh
    facets: FacetNet
    hinges: Hinges
    rest: np.ndarray
    given: bool

    @property
    def flat(self) -> np.ndarray:
        """Flat state (V, 3) m."""
        return self.mesh.flat

    @property
    def letters(self) -> np.ndarray:
        """Letter (H,) of each hinge, no number."""
        return self.facets.letters[self.hinges.edges]

    @property
    def creases(self) -> np.ndarray:
        """Whether hinges (H,) are mountains or valleys. It is bool."""
        return np.isin(self.letters, ("M", "V"))

    @property
    def directions(self) -> np.ndarray:
        """1 for valleys, -1 for mountains (H,), 0 for others, without unit."""
        return np.where(self.letters == "V", 1.0, np.where(self.letters == "M", -1.0, 0.0))

    @cached_property
    def lengths(self) -> np.ndarray:
        """Flat length (E,) m of all edges."""
        ends = self.flat[self.facets.edges]
        return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)

    @cached_property
    def reference(self) -> float:
        """Length ell [m] that makes the terms non-dimensional.

        sqrt(a b) of the mean sides of both families of quadrilaterals, else the mean side.
        """
        found = find_families(self.mesh.panels)
        if found is None:
            return float(self.lengths[: len(self.mesh.edges)].mean())
        family, sides = found
        length = np.linalg.norm(self.flat[sides[:, 1]] - self.flat[sides[:, 0]], axis=1)
        return float(np.sqrt(length[family == 0].mean() * length[family == 1].mean()))

    @cached_property
    def sectors(self) -> list[np.ndarray]:
        """Sectors (d, N, 3) about vertices inside, by degree d, as numbers of vertices."""
        return group_sectors(self.mesh.panels)

    @cached_property
    def chains(self) -> np.ndarray:
        """Rows (m, 4) of vertices two sides apart along lines that run straight on."""
        return find_line_chains(self.mesh.panels)

    @cached_property
    def border(self) -> list[int]:
        """The longest border loop, counter-clockwise, as numbers of vertices."""
        return max((loop.tolist() for loop in self.mesh.borders), key=len)

    @cached_property
    def corners(self) -> set[int]:
        """Vertices of the border that belong to one panel alone."""
        fans, inside = list_fans(self.mesh.panels)
        return {vertex for vertex, fan in fans.items() if len(fan) == 2 and vertex not in inside}


def make_net(mesh: PanelMesh) -> FoldNet:
    """Build the net of a flat pattern. Panels are cut into facets by their flat shape."""
    flat = replace(mesh, rest=None, folded=None)
    facets = make_facet_net(flat)
    hinges = find_hinges(facets.facets, facets.edges)
    angles = np.full(len(facets.edges), np.nan)
    angles[: len(mesh.edges)] = mesh.fold_angles
    letters, angles = facets.letters[hinges.edges], angles[hinges.edges]
    crease = np.isin(letters, ("M", "V"))
    sign = np.where(letters == "V", 1.0, -1.0)
    known = crease & (np.nan_to_num(angles) * sign > MISSING)
    given = bool(known[crease].all()) if crease.any() else False
    shut = sign * math.pi
    rest = np.where(crease, np.where(known, np.nan_to_num(angles), shut), 0.0)
    return FoldNet(flat, facets, hinges, rest, given)
