"""The neutral model file: what it must hold, and its values as arrays."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from crosscheck.own_loads import OwnLoad, list_own_cases, read_own_loads
from crosscheck.reading import Place, read_json
from crosscheck.supports import Support, read_pins, read_supports

FORMATS = tuple(f"foldshell-neutral-model {number}" for number in (1, 2, 3, 4))
"""The second may name panels that carry their own weight only; the third names its supports, which
may hold single directions, clamp edges and be springs, may compare several combinations of a kind,
and says what the criteria allow; the fourth lists its loads one by one."""
CASES = ("SW", "SDL", "LL", "WX", "WY")
FORMER_AREAS = {"mesh": "sheet", "plan": "plan_abs"}
"""Words of older model files."""
KINDS = ("strength", "deflection")
LIMITS = ("displacement_down_max_m", "utilization_panel_mean_max")
"""What the primary code's criteria may limit."""
CRITERIA = ("von_mises", "rankine", "drucker_prager")


@dataclass(frozen=True)
class Material:
    """Isotropic, elastic; kPa and kN/m3."""

    youngs_modulus: float
    poissons_ratio: float
    unit_weight: float
    strength: float
    strength_tension: float
    criterion: str  # one of CRITERIA


@dataclass(frozen=True)
class Loads:
    """Area loads in kN/m2, the area they act on, and the side the dead load presses on."""

    dead: float
    live: float
    wind: float
    wind_fraction: float
    area_basis: str  # sheet | plan_abs
    dead_side: str  # downward | sheet


@dataclass(frozen=True)
class Model:
    """A folded shell: flat facets, one thickness per panel, supports, loads."""

    design: str
    vertices: np.ndarray  # (V, 3) m
    facets: np.ndarray  # (F, 3) counter-clockwise from above
    facet_panel: np.ndarray  # (F,)
    panel_thickness: np.ndarray  # (P,) m
    supports: tuple[Support, ...]
    material: Material
    loads: Loads | None  # the paper's
    combinations: dict[str, dict[str, float]]
    compared: dict[str, list[str]]  # strength and deflection: combinations of each
    self_weight_only_panels: np.ndarray = field(
        default_factory=lambda: np.empty(0, int)
    )  # own weight only
    limits: dict[str, float] = field(default_factory=dict)  # LIMITS, those that are known
    own_loads: tuple[OwnLoad, ...] = ()  # in place of the paper's, where there are any

    @property
    def cases(self) -> tuple[str, ...]:
        """Names of the load cases."""
        return list_own_cases(self.own_loads) if self.own_loads else CASES

    @property
    def thickness(self) -> np.ndarray:
        """Thickness of each facet: (F,) in m."""
        return self.panel_thickness[self.facet_panel]

    @property
    def self_weight_only(self) -> np.ndarray:
        """True for facets that carry their own weight only, (F,) bool."""
        return np.isin(self.facet_panel, self.self_weight_only_panels)

    @property
    def compared_combinations(self) -> dict[str, dict[str, float]]:
        """The factors of the combinations that are compared."""
        names = dict.fromkeys(name for kind in KINDS for name in self.compared[kind])
        return {name: self.combinations[name] for name in names}

    @property
    def supported_edges(self) -> np.ndarray:
        """Facet sides that some support holds, as numbers of vertices: (S, 2)."""
        return np.concatenate([support.edges for support in self.supports])


def read_model(path: str | Path) -> Model:
    """Read and check a neutral model file; raises CrosscheckError naming file, place and value."""
    root = Place(Path(path).name, "", read_json(path))
    format_name = root.key("format").one_of(list(FORMATS))
    vertices = root.key("vertices_m").numbers(3)
    facets = root.key("facets").indices(3, len(vertices))
    thickness = root.key("panel_thickness_m").numbers(None, above=0.0)
    panel = root.key("facet_panel").indices(None, len(thickness))
    _check_facets(root, vertices, facets, panel, len(thickness))
    if format_name in FORMATS[2:]:
        supports = read_supports(root, facets, len(vertices))
    else:
        supports = read_pins(root.key("supported_edges"), facets, len(vertices))
    own_loads: tuple[OwnLoad, ...] = ()
    if format_name == FORMATS[3]:
        own_loads = read_own_loads(root.key("load_cases"), len(thickness))
    cases = list_own_cases(own_loads) if own_loads else CASES
    combinations = _read_combinations(root.key("combinations"), cases)
    compared = {
        kind: _read_compared(root.key("compare").key(kind), format_name, list(combinations))
        for kind in KINDS
    }
    return Model(
        design=root.key("design").text(),
        vertices=vertices,
        facets=facets,
        facet_panel=panel,
        panel_thickness=thickness,
        supports=supports,
        material=_read_material(root.key("material")),
        loads=None if own_loads else _read_loads(root),
        combinations=combinations,
        compared=compared,
        self_weight_only_panels=_read_self_weight_only_panels(root, format_name, len(thickness)),
        limits=_read_limits(root.key("limits", {})),
        own_loads=own_loads,
    )


def _read_self_weight_only_panels(root: Place, format_name: str, panels: int) -> np.ndarray:
    unsaid = format_name in FORMATS[2:] and "self_weight_only_panels" not in root.names()
    if format_name == FORMATS[0] or unsaid:
        return np.empty(0, dtype=int)
    return root.key("self_weight_only_panels").indices(None, panels)


def _check_facets(
    root: Place, vertices: np.ndarray, facets: np.ndarray, panel: np.ndarray, panels: int
) -> None:
    if len(panel) != len(facets):
        root.key("facet_panel").refuse(f"{len(panel)} entries", f"{len(facets)}, one a facet")
    unused = np.setdiff1d(np.arange(panels), panel)
    if len(unused):
        root.key("panel_thickness_m").at(int(unused[0])).refuse(
            f"panel {unused[0]} without facets", "a panel that some facet names in facet_panel"
        )
    a, b, c = (vertices[facets[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    longest = np.max([np.linalg.norm(x - y, axis=1) for x, y in ((a, b), (b, c), (c, a))], axis=0)
    flat = np.flatnonzero(area <= 1e-9 * longest**2)
    if len(flat):
        root.key("facets").at(int(flat[0])).refuse(facets[flat[0]].tolist(), "a true triangle")


def _read_compared(place: Place, format_name: str, names: list[str]) -> list[str]:
    """One combination, or from format 3 on a list of them."""
    if format_name not in FORMATS[2:]:
        return [place.one_of(names)]
    return list(dict.fromkeys(entry.one_of(names) for entry in place.entries()))


def _read_limits(place: Place) -> dict[str, float]:
    for name in place.names():
        if name not in LIMITS:
            place.refuse(name, "one of " + ", ".join(LIMITS))
    return {name: place.key(name).number(above=0.0) for name in place.names()}


def _read_material(place: Place) -> Material:
    return Material(
        youngs_modulus=place.key("youngs_modulus_kpa").number(above=0.0),
        poissons_ratio=place.key("poissons_ratio").number(least=0.0, below=0.5),
        unit_weight=place.key("unit_weight_kn_m3").number(least=0.0),
        strength=place.key("strength_kpa").number(above=0.0),
        strength_tension=place.key("strength_tension_kpa").number(above=0.0),
        criterion=place.key("criterion").one_of(list(CRITERIA)),
    )


def _read_loads(root: Place) -> Loads:
    place = root.key("loads_kn_m2")
    area = root.key("area_basis").one_of(["sheet", "plan_abs", *FORMER_AREAS])
    side = place.key("dead_side", "downward").one_of(["downward", "sheet"])
    return Loads(
        dead=place.key("SDL").number(least=0.0),
        live=place.key("LL").number(least=0.0),
        wind=place.key("W").number(least=0.0),
        wind_fraction=place.key("wind_fraction").number(least=0.0),
        area_basis=FORMER_AREAS.get(area, area),
        dead_side=side,
    )


def _read_combinations(place: Place, cases: tuple[str, ...]) -> dict[str, dict[str, float]]:
    result: dict[str, dict[str, Any]] = {}
    for name in place.names():
        factors = place.key(name)
        for case in factors.names():
            if case not in cases:
                factors.refuse(case, "one of the load cases " + ", ".join(cases))
        result[name] = {case: factors.key(case).number() for case in factors.names()}
    if not result:
        place.refuse("nothing", "at least one combination")
    return result
