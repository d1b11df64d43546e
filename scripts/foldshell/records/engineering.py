"""engineering.json and engineering.npz: the engineering verdict on a final state."""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from foldshell.records.arrays import array
from foldshell.records.entry import COUNT, entry
from foldshell.records.reinforcement import ReinforcementRecord

EngineeringVerdict = Literal["passes", "fails", "not_applicable"]
Factors = dict[str, dict[str, float]]
Vector = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class EngineeringCheck:
    """One check: a value against its limit, or for information where there is none."""

    words: str = entry("what is checked")
    value: float | None = entry("what was found; null where there is no answer")
    limit: float | None = entry("what it is held against; null for information")
    unit: str = entry("unit of both; empty for none")
    at_least: bool = entry("whether the value has to reach the limit; it has to stay within else")
    met: bool | None = entry("whether it holds; null for information")
    governing_combination: str | None = entry("the combination that governs")
    panel: int | None = entry("the panel where it governs")
    place: str | None = entry("where in the panel, and its middle", default=None)
    mesh_error: float | None = entry("relative error of the value on the mesh in use", "-")
    within_mesh_error: bool = entry("whether the answer may turn within that error")


@dataclass(frozen=True, kw_only=True)
class Measures:
    """Utilization of the final state under the combinations of the loop, by one criterion."""

    utilization_panel_mean_max: float = entry("largest area mean over a panel", "-")
    utilization_strip_max: float = entry("largest of facets and strips as a mean", "-")
    panels_above_one: int = entry("panels whose area mean is above 1", COUNT)
    area_share_above_one: float = entry("their share of the area", "-")


@dataclass(frozen=True, kw_only=True)
class CombinationFactors:
    """Combinations of the engineering verdict by purpose: factors of load cases by name."""

    strength: Factors = entry("ultimate limit states")
    characteristic: Factors = entry("of short-term displacements")
    quasi_permanent: Factors = entry("sustained, of long-term displacements")


@dataclass(frozen=True, kw_only=True)
class EngineeringRecord:
    """The contents of checks/engineering.json."""

    verdict: EngineeringVerdict = entry("passes, fails, or not applicable")
    reason: str = entry("why, in words")
    material_kind: str = entry("material whose checks hold: concrete, steel or user")
    checks: dict[str, EngineeringCheck] = entry("each check by its name")
    buckling_terms: dict[str, float] = entry(
        "what the buckling factor that is required is made of", "-"
    )
    loop_criterion: str = entry("criterion by which the loop sized")
    measures: dict[str, Measures] = entry(
        "utilization of the final state under the loop's own combinations, by criterion"
    )
    combinations: CombinationFactors = entry("combinations of the verdict")
    buckling_factor: dict[str, float | None] = entry(
        "buckling factor of each combination; null where nothing is compressed", "-"
    )
    loads: dict[str, Vector] = entry("resultant of each load case", "kN")
    load_moments: dict[str, Vector] | None = entry(
        "moment of each load case about the origin", "kNm", default=None
    )
    reactions: dict[str, dict[str, Vector]] = entry(
        "resultant of the reactions at each supported edge, by combination", "kN"
    )
    analyses: int = entry("analyses of the final state that were made for this verdict", COUNT)
    panels: dict[str, tuple[Any, ...]] = entry("values of panels: an array by each name")
    reinforcement: ReinforcementRecord | None = entry(
        "reinforced concrete; null where there is none", default=None
    )


@dataclass(frozen=True)
class EngineeringArrays:
    """The arrays of checks/engineering.npz; the K combinations are those of strength, then the
    characteristic ones."""

    vertex: np.ndarray | None = array("V", "-", "supported vertices")
    vertex_place: np.ndarray | None = array("V, 3", "m", "where they are")
    vertex_reaction: np.ndarray | None = array(
        "V, 3, K", "kN", "sum of the reactions of the nodes nearest to each"
    )
    edge_reaction: np.ndarray | None = array("B, 3, K", "kN", "reactions of each supported edge")
    load_sum: np.ndarray | None = array("3, K", "kN", "resultant of the loads")
    panel_forces: np.ndarray | None = array(
        "K, P, 8", "kN/m, kNm/m", "means over panels of nx, ny, nxy, mx, my, mxy, vx, vy"
    )
