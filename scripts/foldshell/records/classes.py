"""classes.json: the sized panels in a few thickness classes, and the analysis of that design."""

from dataclasses import dataclass
from typing import Literal

from foldshell.records.analysis import Criteria, ShellState
from foldshell.records.entry import COUNT, elapsed, entry


@dataclass(frozen=True, kw_only=True)
class ThicknessClass:
    """One class of panels."""

    number: int = entry("number of the class, from 1, in rising order of thickness", COUNT,
                        "class", key="class")  # fmt: skip
    thickness_m: float = entry("thickness of its panels", "m")
    panels: int = entry("panels in it", COUNT)
    area_m2: float = entry("area of these panels", "m2")


@dataclass(frozen=True, kw_only=True)
class ClassesRecord(ShellState):
    """The contents of classes.json: classes, verdict on the grouped design, its analysis."""

    verdict: Literal["holds", "fails", "unstable", "not_converged", "mechanism"] = entry(
        "whether the grouped design keeps the limits; else the state of its analysis"
    )
    reason: str = entry("why, in words")
    criteria: Criteria = entry("the limits that the grouped design has to keep")
    count: int = entry("classes allowed", COUNT)
    rounds: int = entry("how often panels above the limit were thickened and grouped anew", COUNT)
    classes: tuple[ThicknessClass, ...] = entry("the classes in rising order of thickness")
    ungrouped_volume_m3: float = entry("volume of the sized design before grouping", "m3")
    added_volume_relative: float = entry(
        "volume over that before grouping, less 1", "-", form="change"
    )
    seconds: float | None = elapsed()
