"""What stands beside the best design of an exploration: rivals, sized alike."""

from dataclasses import dataclass

from foldshell.records.candidate import is_found
from foldshell.records.entry import COUNT, entry, same
from foldshell.records.reinforcement import ReinforcementRecord

KEPT = 0.99
"""Share of a buckling factor that is due from which it counts as kept: the rule ends beside it."""
FOUND, TABLE, SMOOTH = "found", "table", "smooth"


def name_kind(candidate: str, pattern: object) -> str:
    """Return what a candidate is: found by a search, a row of the table, or the smooth shell."""
    if is_found(candidate):
        return FOUND
    return SMOOTH if pattern == "smooth" else TABLE


def _steel(name: str):
    return same(ReinforcementRecord, name, empty=True)


@dataclass(frozen=True, kw_only=True)
class ResizedRow:
    """A row of rivals/resized.csv: one shell, sized for one factor on the search's mesh."""

    candidate: str = entry("round and number in it")
    kind: str = entry("found, table or smooth")
    factor_due: float = entry("buckling factor that the sizing kept", "-")
    state: str = entry("sized, or what became of it")
    volume_m3: float | None = entry("volume of concrete", "m3", default=None)
    buckling_factor_min: float | None = entry("least buckling factor", "-", default=None)
    iterations: int | None = entry("analyses of the loop", COUNT, default=None)


@dataclass(frozen=True, kw_only=True)
class JudgedRow:
    """A row of rivals/paper.csv and rivals/reinforced.csv: one shell by the ordinary rules."""

    design: str = entry("name of the design")
    kind: str = entry("found, table or smooth")
    state: str = entry("verdict of the sizing loop")
    reason: str | None = entry("why", default=None)
    iterations: int | None = entry("analyses of the loop", COUNT, default=None)
    mesh_subdivisions: int | None = entry("subdivisions of a facet edge", COUNT, default=None)
    volume_m3: float | None = entry("volume of concrete", "m3", default=None)
    volume_per_area_m: float | None = entry("mean thickness", "m", default=None)
    buckling_factor_min: float | None = entry(
        "least buckling factor under the combinations of the loop", "-", default=None
    )
    displacement_vertical_max_m: float | None = entry("largest downward", "m", default=None)
    mesh_error: float | None = entry("relative error of the mesh in use", "-", default=None)
    crosscheck: str | None = entry("pass or fail of the second code", default=None)
    engineering: str | None = entry("engineering verdict", default=None)
    failed: str | None = entry("names of the checks that are not met", default=None)
    stability: float | None = entry(
        "least buckling factor under the combinations of the verdict", "-", default=None
    )
    stability_due: float | None = entry("the one that is required there", "-", default=None)
    displacement_long_term_m: float | None = entry(
        "vertical displacement after creep, cracked panels softened", "m", default=None
    )
    displacement_due_m: float | None = entry("the largest that is allowed", "m", default=None)
    strut: float | None = entry("largest strut over what concrete bears", "-", default=None)
    shear_share: float | None = entry("panels whose shear is over v_Rd,c", "-", default=None)
    steel_kg_m2: float | None = _steel("steel_kg_m2")
    steel_kg: float | None = _steel("steel_kg")
    co2_kg: float | None = _steel("co2_kg")
    co2_low_kg: float | None = _steel("co2_low_kg")
    co2_high_kg: float | None = _steel("co2_high_kg")
