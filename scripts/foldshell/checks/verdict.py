"""Checks with their limits, and the verdict that they make together."""

from collections.abc import Mapping
from dataclasses import dataclass

from foldshell.records.engineering import EngineeringCheck, EngineeringVerdict


@dataclass(frozen=True)
class Found:
    """A largest (or least) value, the combination and the panel where it stands."""

    value: float | None
    combination: str | None = None
    panel: int | None = None


def hold_against(
    words: str,
    found: Found,
    limit: float | None,
    unit: str = "",
    at_least: bool = False,
    mesh_error: float | None = None,
) -> EngineeringCheck:
    """Return a check: met where the value keeps its limit, or has no value to fail by.

    A value that may cross its limit within its relative mesh error says so.
    """
    value = found.value
    met = None if limit is None else _keeps(value, limit, at_least)
    turned = False
    if met is not None and value and mesh_error:
        bounds = (value * (1 + mesh_error), value / (1 + mesh_error))
        turned = any(_keeps(one, limit, at_least) != met for one in bounds)
    return EngineeringCheck(
        words=words, value=value, limit=limit, unit=unit, at_least=at_least, met=met,
        governing_combination=found.combination, panel=found.panel, mesh_error=mesh_error,
        within_mesh_error=turned,
    )  # fmt: skip


def _keeps(value: float | None, limit: float, at_least: bool) -> bool:
    if value is None:
        return True
    return value >= limit if at_least else value <= limit


def unknown_check(words: str, limit: float, unit: str = "", at_least: bool = False):
    """Return a check that is not met because nothing is known of it."""
    return EngineeringCheck(
        words=words, value=None, limit=limit, unit=unit, at_least=at_least, met=False,
        governing_combination=None, panel=None, mesh_error=None, within_mesh_error=False,
    )  # fmt: skip


def judge_checks(
    checks: Mapping[str, EngineeringCheck], failures: Mapping[str, str]
) -> tuple[EngineeringVerdict, str]:
    """Return verdict and reason; `failures` begins the words of a check that fails; where it has no
    value they are all.

    A check that may turn within its mesh error is named in either case.
    """
    failed = {name: one for name, one in checks.items() if one.met is False}
    near = [one.words for one in checks.values() if one.within_mesh_error]
    doubt = f"; within the mesh error: {', '.join(near)}" if near else ""
    if not failed:
        return "passes", f"all checks are met{doubt}"
    words = [
        failures[name]
        if name in failures and one.value is None
        else _describe(one, failures.get(name, one.words))
        for name, one in failed.items()
    ]
    return "fails", "; ".join(words) + doubt


def _describe(check: EngineeringCheck, begin: str) -> str:
    if check.value is None:
        return f"{begin}: not known"
    relation = "below" if check.at_least else "above"
    unit = f" {check.unit}" if check.unit else ""
    where = [check.governing_combination, None if check.panel is None else f"panel {check.panel}"]
    placed = ", ".join(filter(None, where))
    value, limit = show_both(check.value, check.limit)
    text = f"{begin}: {value} {relation} {limit}{unit}"
    return f"{text} ({placed})" if placed else text


def show_both(value: float, limit: float) -> tuple[str, str]:
    """Return both with three digits, or as many as tell them apart."""
    pairs = ((show(value, digits), show(limit, digits)) for digits in range(3, 18))
    return next((pair for pair in pairs if pair[0] != pair[1]), (str(value), str(limit)))


def show(value: float, digits: int) -> str:
    """Return a number with some digits, or all before the point."""
    return f"{value:.{digits}g}" if abs(value) < 10**digits else f"{value:.0f}"
