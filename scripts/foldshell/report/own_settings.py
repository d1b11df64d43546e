"""Designs under settings of their own beside the same designs under those of the paper."""

from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path

from foldshell.files.errors import InputError
from foldshell.records.design_row import DesignRow
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows
from foldshell.report.markup import Cell, Table, make_table
from foldshell.report.study_columns import judge

OWN = ("design", "tags", "settings")
"""Columns in which designs differ that are the same but for their settings."""
HEADER = (
    "design", "settings", "verdict", "volume [m³]", "over the study's", "reinforcement [kg/m²]",
    "[kg/m³]", "governs", "panels over [%]", "CO2e [kg/m²]", "cost [1/m²]", "buckling factor",
    "displacement [mm]", "iterations", "engineering",
)  # fmt: skip


def compare_settings(rows: Sequence[SummaryRow], beside: Mapping[str, str | Path]) -> Table:
    """Return a table of designs that stand under several settings, those of the study's first.

    `rows` are those of the study, `beside` the summaries of others; one that cannot be read is left
    out. A group counts where one of its designs is in the study. Empty for none.
    """
    groups: dict[tuple, dict[str, SummaryRow]] = {}
    for row in [*rows, *_read_others(beside)]:
        groups.setdefault(_key(row), {}).setdefault(row.design, row)
    named = {row.design for row in rows}
    cells = []
    for members in groups.values():
        settings = {one.settings for one in members.values()}
        if len(settings) > 1 and named & set(members):
            cells += _tabulate(sorted(members.values(), key=lambda one: one.settings or ""))
    return make_table(HEADER, cells)


def _read_others(beside: Mapping[str, str | Path]) -> list[SummaryRow]:
    found: list[SummaryRow] = []
    for path in beside.values():
        try:
            found += read_rows(path, SummaryRow)
        except InputError:
            continue
    return found


def _key(row: SummaryRow) -> tuple:
    return tuple(getattr(row, one.name) for one in fields(DesignRow) if one.name not in OWN)


def _tabulate(members: Sequence[SummaryRow]) -> list[list[Cell]]:
    """Return a row a design; volumes are set against that of the first."""
    base = members[0].volume_m3 if not members[0].settings else None
    return [_make_row(one, base) for one in members]


def _make_row(row: SummaryRow, base: float | None) -> list[Cell]:
    volume, down = row.volume_m3, row.displacement_vertical_max_m
    emitted = row.co2_kg_m2 is not None
    return [
        Cell(row.design),
        Cell((row.settings or "the study's").rpartition("/")[2]),
        Cell(row.state.replace("_", " "), judge(row.state)),
        Cell(volume),
        Cell(volume / base if volume and base else None),
        Cell(row.steel_kg_m2),
        Cell(row.steel_kg_m3),
        Cell(row.steel_governing),
        Cell(None if row.steel_over_share is None else 100 * row.steel_over_share),
        Cell(f"{row.co2_kg_m2:.0f} ({row.co2_low_kg_m2:.0f} to {row.co2_high_kg_m2:.0f})"
             if emitted else None),
        Cell(row.cost_m2),
        Cell(row.buckling_factor_min),
        Cell(None if down is None else 1e3 * down),
        Cell(row.iterations),
        Cell((row.engineering or "").replace("_", " ") or None, judge(row.engineering or "")),
    ]  # fmt: skip
