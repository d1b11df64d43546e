"""The checks of a design with the share of its limit that each uses; the largest one governs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from foldshell.records.analysis import AnalysisRecord, Criterion
from foldshell.records.entry import Entry
from foldshell.report.markup import format_number
from foldshell.report.places import PanelPlace, describe_place, read_panels

OF_PANELS = ("utilization_panel_mean", "utilization_element_max", "utilization_strip",
             "utilization_reinforced")  # fmt: skip
"""Criteria on the utilization of panels, by the measure of the loop."""
LIMITS = (*OF_PANELS, "displacement_vertical_m", "edge_beam_utilization")
"""Criteria of the sizing loop that are limits of a structure; the others stop the loop."""
ROUNDING = 1e-6
"""Tenths of a per cent by which the share of a limit may miss a whole one in binary numbers."""
BUCKLING = "buckling factor, elastic, perfect shell [-]"


OPEN = "(open:"
"""In the name of a check whose value does not settle with the mesh."""
MOST = 99.0
"""Where checks of reinforced concrete stop counting: there is no resistance to speak of."""


@dataclass(frozen=True)
class Check:
    """One check: value and limit in the unit of its name; `ratio` is 1 at the limit, above it the
    check fails; `where` says which combination or panel governs it."""

    name: str
    value: float | None
    limit: float | None
    ratio: float | None
    met: bool | None
    where: str = ""

    @property
    def words(self) -> str:
        """The check in one line."""
        share = "" if self.ratio is None else f" ({describe_share(self.ratio)} of its limit)"
        text = f"{self.name}: {format_number(self.value)}, limit {format_number(self.limit)}{share}"
        return f"{text}; {self.where}" if self.where else text


def list_checks(
    final: AnalysisRecord,
    panels: Mapping[str, PanelPlace] | None = None,
) -> list[Check]:
    """Return the checks of a final state by the paper's criteria.

    `panels` are the most utilized ones by the criterion that finds them.
    """
    checks = [
        _of_criterion(about, item, _find_where(about.key, final, panels or {}))
        for about, item in final.criteria.items()
        if about.key in LIMITS and item.value is not None
    ]
    factor = final.least_factor
    if factor is not None:
        where = f"combination {final.least_factor_combination}"
        ratio = 1 / factor if factor > 0 else None
        checks.append(Check(BUCKLING, factor, 1.0, ratio, factor >= 1.0, where))
    return checks


def _find_where(key: str, final: AnalysisRecord, panels: Mapping[str, PanelPlace]) -> str:
    """Return combination, panel and place that govern a criterion, as far as they are known."""
    if key == "displacement_vertical_m" and final.displacement_combination:
        place = final.displacement_place_m
        at = f" at {describe_place(place)}" if place else ""
        return f"combination {final.displacement_combination}{at}"
    if key not in OF_PANELS:
        return ""
    governing = final.governing_combination
    parts = [f"combination {governing}"] if governing else []
    return ", ".join([*parts, panels[key].words] if key in panels else parts)


def _of_criterion(about: Entry, item: Criterion, where: str) -> Check:
    scale, words = (1e3, f"{about.words} [mm]") if about.unit == "m" else (1.0, about.label())
    ratio = item.value / item.limit if item.limit else None
    return Check(words, scale * item.value, scale * item.limit, ratio, item.met, where)


def describe_share(ratio: float | None) -> str:
    """Return the share of a limit in per cent, a dash where there is none.

    In whole ones but near the limit: what is below the limit, or above it, is not rounded to it.
    """
    if ratio is None:
        return "–"
    if ratio >= MOST - ROUNDING:
        return "99 times or more"
    percent = 100 * ratio
    if round(percent) != 100 or percent == 100:
        return f"{percent:.0f} %"
    if percent < 100:
        return f"{min(math.floor(10 * percent + ROUNDING) / 10, 99.9):.1f} %"
    return f"{max(math.ceil(10 * percent - ROUNDING) / 10, 100.1):.1f} %"


def find_governing(checks: Sequence[Check]) -> Check | None:
    """Return the check that uses most of its limit.

    One that is open, since its value does not settle with the mesh, does not hide another that is
    above its limit.
    """
    known = [check for check in checks if check.ratio is not None]
    settled = [check for check in known if OPEN not in check.name and check.ratio > 1]
    return max(settled or known, key=lambda check: check.ratio, default=None)


def read_checks(final: AnalysisRecord, paths: Mapping[str, str | Path]) -> list[Check]:
    """Return the checks of a final state; `paths` are arrays (final.npz) and folded (npz)."""
    return list_checks(final, read_panels(paths["arrays"], paths["folded"]))
