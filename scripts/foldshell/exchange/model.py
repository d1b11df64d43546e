"""The one model that every export is written from: plain frozen values in kN, m, kPa and rad.

An export is a module that reads this and nothing else of a design; `formats.py` lists them.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from foldshell.loads.cases import SurfaceLoad, surface_loads
from foldshell.pattern.panel_mesh import PanelMesh
from foldshell.settings.material import Material

PLANAR = 1e-6
"""A panel whose corners lie within so many metres of a plane is one planar face."""


@dataclass(frozen=True)
class Panel:
    """One panel: `corners` (k,) vertices counter-clockwise from the positive side, its facets.

    `inner` (f - 1, 2) are the edges between its facets and `bends` (f - 1,) rad the fold angles
    there, 0 where it is planar. `flatness` m is the largest distance of a corner from the panel's
    plane. `values` are results by name. An edge beam's panels are not `sized`.
    """

    number: int
    corners: np.ndarray
    facets: np.ndarray
    inner: np.ndarray
    bends: np.ndarray
    flatness: float
    thickness: float
    sized: bool = True
    thickness_class: int = 0
    class_thickness: float | None = None
    values: Mapping[str, float] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """P and the number that workbooks know the panel by, B for one of an edge beam."""
        return f"{'P' if self.sized else 'B'}{self.number}"

    @property
    def planar(self) -> bool:
        """Whether it is one plane, to `PLANAR`."""
        return self.flatness <= PLANAR


@dataclass(frozen=True)
class Crease:
    """An edge between panels, or of one: ends, M, V, F (flat) or B, and fold angle (valley
    positive; nan on the border); `panels` are those on its left and right, or its only one."""

    ends: tuple[int, int]
    assignment: str
    angle: float
    panels: tuple[int, ...]


@dataclass(frozen=True)
class Support:
    """Edges (K, 2) and vertices (Q,) that are held: which of x, y, z is fixed, springs in kN/m per
    m of edge or in kN/m at vertices, and whether the rotation about each edge is held."""

    name: str
    edges: np.ndarray
    fixed: tuple[bool, bool, bool] = (True, True, True)
    spring: tuple[float, float, float] = (0.0, 0.0, 0.0)
    vertices: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    clamp: bool = False


@dataclass(frozen=True)
class Target:
    """The surface that the design was folded onto: its name or file, span and height in m, the
    unit of its file, and the sides (m) of a rectangular plan."""

    surface: str
    span: float
    height: float
    file_unit: str = "m"
    sides: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class SpreadLoad(SurfaceLoad):
    """A case of several loads, or one that is not uniform, by its mean on each facet: `facet_loads`
    (F, 3) kN per m2 of sheet."""

    facet_loads: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))


@dataclass(frozen=True)
class ExportModel:
    """A sized design. `vertices` (V, 3) m, `facets` (F, 3) counter-clockwise from the positive
    side, `facet_panel` (F,).

    `flat` (W, 3) m is the flat state of the first W vertices, `flat_facets` of the facets that it
    has; `flat_note` says where it is from. `combinations` are factors of load cases by name,
    `groups` the names in strength and deflection; `compared` those that codes are compared by.
    `pieces` are those that an outline cuts exactly, with their flat state; panels are as analysed.
    """

    design: str
    vertices: np.ndarray
    facets: np.ndarray
    facet_panel: np.ndarray
    panels: tuple[Panel, ...]
    creases: tuple[Crease, ...]
    supports: tuple[Support, ...]
    material: Material
    load_cases: tuple[SurfaceLoad, ...]
    combinations: Mapping[str, Mapping[str, float]]
    groups: Mapping[str, tuple[str, ...]]
    compared: Mapping[str, str]
    flat: np.ndarray
    flat_facets: np.ndarray
    flat_note: str
    target: Target
    verdict: str
    facts: Mapping[str, object] = field(default_factory=dict)
    pieces: PanelMesh | None = None

    @cached_property
    def thickness(self) -> np.ndarray:
        """Thickness of each facet, (F,) m."""
        return np.array([panel.thickness for panel in self.panels])[self.facet_panel]

    @cached_property
    def self_weight_only(self) -> np.ndarray:
        """Facets that carry nothing but their own weight, (F,) bool."""
        return ~np.array([panel.sized for panel in self.panels])[self.facet_panel]

    @cached_property
    def normals(self) -> np.ndarray:
        """Unit normals of the facets, (F, 3)."""
        return self.area_vectors / np.linalg.norm(self.area_vectors, axis=1)[:, None]

    @cached_property
    def area_vectors(self) -> np.ndarray:
        """Area times unit normal of the facets, (F, 3) m2."""
        a, b, c = (self.vertices[self.facets[:, k]] for k in range(3))
        return np.cross(b - a, c - a) / 2

    @cached_property
    def areas(self) -> np.ndarray:
        """Areas of the facets, (F,) m2."""
        return np.linalg.norm(self.area_vectors, axis=1)

    @cached_property
    def panel_areas(self) -> np.ndarray:
        """Areas of the panels, (P,) m2: sums over their facets."""
        return np.bincount(self.facet_panel, self.areas, len(self.panels))

    @property
    def volume(self) -> float:
        """Sum of area times thickness, m3."""
        return float(self.areas @ self.thickness)


def load_on_facets(model: ExportModel, case: SurfaceLoad) -> np.ndarray:
    """Return a case's load on each facet, (F, 3) kN per m2 of sheet."""
    if isinstance(case, SpreadLoad):
        return case.facet_loads
    self_weight_only = model.self_weight_only
    return surface_loads(model.normals, model.thickness, [case], self_weight_only)[:, :, 0]


def combined_loads(model: ExportModel, combination: str) -> np.ndarray:
    """Return the load of a combination on each facet, (F, 3) kN per m2 of sheet."""
    factors = model.combinations[combination]
    known = [case for case in model.load_cases if factors.get(case.case)]
    if not known:
        return np.zeros((len(model.facets), 3))
    return sum(factors[case.case] * load_on_facets(model, case) for case in known)
