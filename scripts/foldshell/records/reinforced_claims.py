"""Designs sized as reinforced concrete for the claims, and the claims judged on them."""

from dataclasses import dataclass
from typing import Literal

from foldshell.records.claims import ClaimRecord, JudgedParts
from foldshell.records.engineering import EngineeringVerdict
from foldshell.records.entry import entry
from foldshell.records.measures import FlatEqualRecord, Measures

Survival = Literal["survives", "falls", "never held", "comes to hold", "cannot be told"]


@dataclass(frozen=True, kw_only=True)
class ReinforcedRecord:
    """The contents of reinforced/<design>.json: a loop in memory that sizes for reinforcement."""

    design: str = entry("name of the design")
    settings: str = entry("file of settings that it is sized by")
    measures: Measures = entry("its delivered state")
    mesh_errors: dict[str, float | None] = entry(
        "relative change of displacement, mean, largest and variation of utilization, and steel on "
        "twice the subdivisions, first order; null where there is no answer", "-"
    )  # fmt: skip
    engineering: EngineeringVerdict = entry("engineering verdict on it")
    engineering_reason: str = entry("why it is so")
    steel_kg_m3: float | None = entry("reinforcement by volume of concrete", "kg/m3")
    governing_share: dict[str, float] = entry("panels in which each check is used most", "-")
    over_one_share: dict[str, float] = entry("panels in which each check is not met", "-")
    flat: FlatEqualRecord | None = entry(
        "the flat sheet of the same volume, where the table has one", left_out=True
    )


@dataclass(frozen=True, kw_only=True)
class ReinforcedClaim(ClaimRecord):
    """One entry of claims_reinforced.json: a claim on designs sized as reinforced concrete, and
    what the paper's measure and strips say of it."""

    paper: JudgedParts = entry("verdicts on the designs sized by the paper's criteria")
    by_strips: JudgedParts | None = entry(
        "verdicts on these designs with the utilization of strips; null where none enters"
    )
    survives: Survival = entry("what becomes of the claim when the shell is made to stand")
    parts_survive: dict[str, Survival] = entry("what becomes of each part")
