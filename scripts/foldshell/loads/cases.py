"""Load cases as loads on the sheet: Table 2 of Tsiamis et al. (2018), or a design's own set."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.settings.combination_rules import Action
from foldshell.settings.field import Factors
from foldshell.settings.load_rows import NORMAL, SELF_WEIGHT, LoadRow, read_direction
from foldshell.settings.load_sets import PAPER_ACTIONS, list_actions
from foldshell.settings.loads import LOAD_CASES, Loads
from foldshell.settings.zones import EVERYWHERE, Variation, Zone, read_variation, read_zone

WEIGHT, PRESSURE, FORCE, LINE = "weight", "pressure", "force", "line"
TEMPERATURE, SETTLEMENT = "temperature", "settlement"
"""Kinds of load: by volume of the shell, by area, a force in all, by length, and strains and
displacements that are imposed."""

GLOBAL_X, GLOBAL_Y, DOWN = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)

AREA_WORDS = {
    "sheet": "of sheet",
    "plan_abs": "of plan",
    "plan_net": "of plan, facets that overhang less",
    "plan_up": "of plan, facets that face up",
    "footprint": "of plan, what is seen from above",
}
_KIND_WORDS = {
    WEIGHT: "self-weight", PRESSURE: "load", FORCE: "force", LINE: "line load",
    TEMPERATURE: "temperature", SETTLEMENT: "settlement",
}  # fmt: skip


@dataclass(frozen=True)
class SurfaceLoad:
    """A load of a case, which may have several.

    Attributes
    ----------
    case : name that combinations know it by
    kind : WEIGHT, PRESSURE, FORCE, LINE, TEMPERATURE or SETTLEMENT
    value : kN/m3 of a weight, kN/m2, kN, kN/m, K, or m of a settlement
    direction : unit vector in global axes; None is against the normal of each facet (of a
        temperature: the upper side's less the lower side's)
    area : what a pressure refers to: "sheet" (true area), "plan_abs" (its plan projection), by n_z
        "plan_net" (less where a facet overhangs) and "plan_up" (n_z > 0 alone), or "footprint" (the
        plan of what is seen from above)
    words : what it is
    zone, variation : where it acts, and a factor of its size there
    action : kind of action for combination rules
    """

    case: str
    kind: str
    value: float
    direction: tuple[float, float, float] | None
    area: str = "sheet"
    words: str = "load"
    zone: Zone = EVERYWHERE
    variation: Variation | None = None
    action: str = "imposed"
    where: str = ""

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same all over each facet of the whole sheet."""
        spread = self.kind in (WEIGHT, PRESSURE) and self.area != "footprint"
        return spread and self.zone == EVERYWHERE and self.variation is None

    def evaluate(self, normal: np.ndarray, thickness: np.ndarray) -> np.ndarray:
        """Return the load (E, 3) kN per m2 of mesh; normal (E, 3) unit, thickness (E,) m."""
        size = np.full(len(normal), self.value)
        if self.kind == WEIGHT:
            size = self.value * thickness
        elif self.area != "sheet":
            size = self.value * area_factor(self.area, normal)
        along = -normal if self.direction is None else np.array(self.direction)
        return size[:, None] * along


def area_factor(area: str, normal: np.ndarray) -> np.ndarray:
    """Return the area that a load refers to per area of sheet, (E,) without unit.

    normal (E, 3) unit.
    """
    upward = normal[:, 2]
    if area == "plan_net":
        return upward
    if area == "plan_up":
        return np.maximum(upward, 0)
    return np.abs(upward) if area in ("plan_abs", "footprint") else np.ones(len(normal))


def make_load_cases(loads: Loads, unit_weight: float) -> tuple[SurfaceLoad, ...]:
    """Return the loads of a design's set; unit weight kN/m3.

    Those of Table 2 stand in the order of `LOAD_CASES`: part of the wind acts on all of the mesh,
    live load and wind refer to the area that the settings name.
    """
    if loads.rows:
        return tuple(_make_load(LoadRow.from_text(text), unit_weight) for text in loads.rows)
    wind, area = loads.wind * loads.wind_fraction, loads.area_basis
    own, dead, live, along_x, along_y = LOAD_CASES
    down = DOWN if loads.sdl_direction == "vertical" else None
    return (
        SurfaceLoad(own, WEIGHT, unit_weight, DOWN, words="self-weight", action="permanent"),
        SurfaceLoad(
            dead, PRESSURE, loads.superimposed_dead, down,
            words="superimposed dead load", action="permanent",
        ),
        SurfaceLoad(live, PRESSURE, loads.live, DOWN, area, "live load"),
        SurfaceLoad(along_x, PRESSURE, wind, GLOBAL_X, area, "wind", action="wind"),
        SurfaceLoad(along_y, PRESSURE, wind, GLOBAL_Y, area, "wind", action="wind"),
    )  # fmt: skip


def _make_load(row: LoadRow, unit_weight: float) -> SurfaceLoad:
    kind = WEIGHT if row.kind == SELF_WEIGHT else row.kind
    value = unit_weight if row.value is None else row.value
    value = value / 1000 if kind == SETTLEMENT else value
    value = -value if row.direction == NORMAL and kind != TEMPERATURE else value
    direction = read_direction(row.direction) if row.direction else DOWN
    words = row.action if kind == PRESSURE else _KIND_WORDS[kind]
    return SurfaceLoad(
        row.case, kind, value, direction, row.area, words, read_zone(row.zone),
        read_variation(row.variation), row.action, "" if row.zone == "all" else row.zone,
    )  # fmt: skip


def case_actions(loads: Loads) -> tuple[Action, ...]:
    """Return the cases of a design's set as combination rules see them."""
    return list_actions(map(LoadRow.from_text, loads.rows)) if loads.rows else PAPER_ACTIONS


def list_cases(cases: Iterable[SurfaceLoad]) -> tuple[str, ...]:
    """Return the names of the load cases, each once, in their order."""
    return tuple(dict.fromkeys(one.case for one in cases))


def group_cases(cases: Iterable[SurfaceLoad]) -> dict[str, list[SurfaceLoad]]:
    """Return the loads of each case by its name, in their order."""
    found: dict[str, list[SurfaceLoad]] = {}
    for one in cases:
        found.setdefault(one.case, []).append(one)
    return found


def surface_loads(
    normal: np.ndarray,
    thickness: np.ndarray,
    cases: Sequence[SurfaceLoad],
    self_weight_only: np.ndarray | None = None,
) -> np.ndarray:
    """Return uniform loads on each element, (E, 3, c) kN per m2 of mesh.

    Parameters
    ----------
    normal : (E, 3) unit normals
    thickness : (E,) m
    cases : c loads that are uniform, one a case
    self_weight_only : (E,) bool, elements that carry nothing but their own weight; by default none
    """
    result = np.stack([case.evaluate(normal, thickness) for case in cases], axis=2)
    if self_weight_only is not None:
        others = [case.kind != WEIGHT for case in cases]
        result[np.ix_(self_weight_only, (True,) * 3, others)] = 0
    return result


def combination_matrix(combinations: Factors, cases: Sequence[str] = LOAD_CASES) -> np.ndarray:
    """Return the factors (cases, combinations) by which load cases are superposed.

    Factors without unit.
    """
    return np.array(
        [[factors.get(case, 0.0) for factors in combinations.values()] for case in cases]
    )
