"""What a search knows of its box: points, aims, limits of the candidates that were tried."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from foldshell.explore.measures import BOUNDS
from foldshell.records.candidate import CandidateRecord
from foldshell.settings.design import GRID_PATTERNS, NONE, PARAMETERS
from foldshell.settings.exploration import AIMS, ALL_PARAMETERS, SPAN_RATIO, Exploration

LEADS = ("volume_m3", "engineering_volume_m3", "steel_kg", "co2_kg", "cost")
"""Aims that go with the cheap answer."""
MIDDLE = 0.5
"""Where a point stands in a variable that its pattern does not have."""
SIDES = ("span_m", "span_x_m", "span_y_m")


def to_columns(exploration: Exploration, point: np.ndarray) -> dict[str, float | int | str]:
    """Return the values of the variables at a point (d,) in ranges, from 0 to 1; no unit."""
    pairs = zip(exploration.variables, point, strict=True)
    return {variable.name: variable.to_value(float(share)) for variable, share in pairs}


def to_point(exploration: Exploration, record: CandidateRecord) -> np.ndarray:
    """Return the point (d,) of a candidate, no unit; wholes and choices in the middle of a part,
    what its pattern does not have in the middle."""
    silent = find_silent(record.columns.get("pattern"))
    return np.array([
        MIDDLE if v.name in silent else v.to_share(_value(record, v.name))
        for v in exploration.variables
    ])  # fmt: skip


def find_silent(pattern: object) -> set[str]:
    """Return the columns that a pattern does not have, none where it is not known."""
    return set(ALL_PARAMETERS) - set(PARAMETERS.get(str(pattern), ())) if pattern else set()


def _value(record: CandidateRecord, name: str) -> object:
    return record.value_of(name) if name == SPAN_RATIO else record.columns[name]


@dataclass(frozen=True)
class Found:
    """What a search knows: points (k, d), aims (k, m) as logarithms to be made small (nan where
    there are none), which are feasible (k,), logarithms of the cheap answers (k,), margins (k, l)
    to the limits; `told` has the aims that columns tell without a model, as functions of points."""

    points: np.ndarray
    aims: np.ndarray
    feasible: np.ndarray
    cheap: np.ndarray
    margins: np.ndarray
    leads: tuple[bool, ...]
    told: Mapping[int, Callable[[np.ndarray], np.ndarray]]


def gather(exploration: Exploration, records: Sequence[CandidateRecord]) -> Found:
    """Return what the candidates within the box came to, as arrays."""
    inside = [record for record in records if _is_inside(exploration, record)]
    size, count = len(exploration.variables), len(exploration.aims)
    points = np.array([to_point(exploration, record) for record in inside]).reshape(-1, size)
    aims = np.array([[_aim(record, aim) for aim in exploration.aims] for record in inside])
    cheap = np.log([record.cheap_m3 or np.nan for record in inside]).reshape(-1)
    margins = np.array([_margins(exploration, record) for record in inside])
    feasible = np.array([record.feasible for record in inside], dtype=bool)
    leads = tuple(aim in LEADS for aim in exploration.aims)
    counted = exploration.aims if _is_counted(exploration) else ()
    told = {
        column: partial(_count_panels, exploration)
        for column, aim in enumerate(counted) if aim == "panels"
    }  # fmt: skip
    return Found(points, aims.reshape(-1, count), feasible, cheap,
                 margins.reshape(-1, len(BOUNDS)), leads, told)  # fmt: skip


def _is_counted(exploration: Exploration) -> bool:
    """Whether the numbers of lines tell the number of panels of every candidate."""
    varied = {variable.name: variable.choices for variable in exploration.variables}
    columns = exploration.base | varied
    patterns = varied.get("pattern") or (exploration.base.get("pattern", "miura"),)
    whole = all(columns.get(name, NONE) == NONE for name in ("outline", "openings", "folded"))
    return whole and {"zigzag", "strip"} <= columns.keys() and set(patterns) <= set(GRID_PATTERNS)


def _count_panels(exploration: Exploration, points: np.ndarray) -> np.ndarray:
    """Return the logarithm of the numbers of panels (k,) at points (k, d), no unit."""
    rows = [exploration.base | to_columns(exploration, point) for point in points]
    counts = [(int(row["zigzag"]) - 1) * (int(row["strip"]) - 1) for row in rows]
    return AIMS["panels"] * np.log(np.array(counts, dtype=float))


def _is_inside(exploration: Exploration, record: CandidateRecord) -> bool:
    silent = find_silent(record.columns.get("pattern"))
    for variable in exploration.variables:
        if variable.name in silent:
            continue
        value = _value(record, variable.name)
        known = str(value) in variable.choices if variable.choices else True
        if not known or not (variable.choices or variable.low <= float(value) <= variable.high):
            return False
    free = {variable.name for variable in exploration.variables}
    free |= set(SIDES) if SPAN_RATIO in free else set()
    free |= silent if "pattern" in free else set()
    return all(
        record.columns[key] == value for key, value in exploration.base.items() if key not in free
    )


def _aim(record: CandidateRecord, aim: str) -> float:
    value = getattr(record, aim)
    if value is None or value <= 0:
        return np.nan
    return AIMS[aim] * float(np.log(value))


def _margins(exploration: Exploration, record: CandidateRecord) -> list[float]:
    """Return by how much each limit is kept, 0 at the limit; relative where it is not 0."""
    found = []
    for name, (key, sign) in BOUNDS.items():
        value, limit = getattr(record, key), getattr(exploration.limits, name)
        scale = limit or 1.0
        found.append(np.nan if value is None else float(np.clip(sign * (value - limit) / scale,
                                                                 -2, 2)))  # fmt: skip
    return found
