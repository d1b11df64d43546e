"""The history of a sizing loop: one row per iteration, as .csv and as a workbook with charts."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from foldshell.records.analysis import DECIDES
from foldshell.records.history import HistoryRow
from foldshell.workbook.styles import (
    LINE_WIDTH,
    Line,
    Options,
    Styles,
    add_sheet,
    create_workbook,
    mark_above,
    write_lines,
)
from foldshell.workbook.tables import write_records

_CHARTS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("Volume", "m3", ("volume_m3",)),
    (
        "Utilization",
        "-",
        (
            "utilization_max",
            "utilization_p99",
            "utilization_panel_mean_max",
            "edge_beam_utilization_panel_mean_max",
        ),
    ),
    ("Vertical displacement", "m", ("displacement_vertical_max_m", "displacement_limit_m")),
    ("Least buckling factor", "-", ("buckling_factor_min",)),
)
_COLOURS = ("#1D4ED8", "#B45309", "#6B7280", "#0F766E")
_FONT = {"name": "Arial", "size": 9, "bold": False}
_LIMIT_LINE = {
    "line": {"color": "#9F1239", "width": 1.5, "dash_type": "dash"},
    "marker": {"type": "none"},
}


def write_history(
    path: str | Path,
    rows: Sequence[HistoryRow],
    summary: Sequence[Line],
    utilization_max: float = 1.0,
    measure: str = "panel_mean",
) -> None:
    """Write `history.xlsx`: sheets summary, history (one row per iteration) and charts.

    `utilization_max` is the limit of the utilization that `measure` names.
    """
    with create_workbook(path, "History of the sizing loop") as (book, styles):
        sheet = add_sheet(book, "summary", landscape=False)
        sheet.set_column(0, 0, 34)
        sheet.set_column(1, 1, LINE_WIDTH)
        sheet.set_column(2, 2, 10)
        sheet.write_string(0, 0, "History of the sizing loop", styles["title"])
        write_lines(sheet, styles, 2, summary)
        add_history_sheets(book, styles, rows, utilization_max, measure)


def add_history_sheets(
    book: Any, styles: Styles, rows: Sequence[HistoryRow], utilization_max: float, measure: str
) -> None:
    """Add the sheets `history` and `charts`; what decides is marked where it is above its limit."""
    sheet = add_sheet(book, "history")
    keys = [about.key for about in write_records(sheet, styles, HistoryRow, rows)]
    first, last = 2, max(len(rows), 1) + 1
    judged = DECIDES[measure], f"edge_beam_{DECIDES[measure]}"
    for column in (number for number, key in enumerate(keys) if key in judged):
        mark_above(sheet, styles, (first, column, last, column), utilization_max)
    charts = add_sheet(book, "charts")
    charts.fit_to_pages(1, 1)
    for index, (title, unit, wanted) in enumerate(_CHARTS):
        drawn = [key for key in wanted if any(getattr(row, key) is not None for row in rows)]
        if drawn:
            columns = {key: keys.index(key) for key in drawn}
            chart = _make_chart(book, title, unit, columns, (first, last))
            charts.insert_chart(17 * (index // 2), 8 * (index % 2), chart)


def _make_chart(
    book: Any, title: str, unit: str, columns: Mapping[str, int], span: tuple[int, int]
) -> Any:
    """Return straight lines with markers over the iterations, header and units left out.

    `columns` gives the column of each drawn key, `span` the first and last row with numbers.
    """
    chart = book.add_chart({"type": "scatter", "subtype": "straight_with_markers"})
    first, last = span
    for (key, column), colour in zip(columns.items(), _COLOURS, strict=False):
        chart.add_series(
            {
                "name": ["history", 0, column],
                "categories": ["history", first, 0, last, 0],
                "values": ["history", first, column, last, column],
                **(_LIMIT_LINE if key.endswith("_limit_m") else _style_line(colour)),
            }
        )
    heading = {**_FONT, "size": 11, "bold": True}
    chart.set_title({"name": f"{title} [{unit}]", "name_font": heading})
    chart.set_x_axis(_make_iteration_axis(last - first))
    grid = {"visible": True, "line": {"color": "#E5E7EB"}}
    axis = {"num_font": _FONT, "min": 0, "num_format": "General", "major_gridlines": grid}
    chart.set_y_axis(axis)
    chart.set_legend({"position": "bottom", "font": _FONT} if len(columns) > 1 else {"none": True})
    chart.set_size({"width": 500, "height": 320})
    return chart


def _style_line(colour: str) -> Options:
    fill = {"color": colour}
    return {
        "line": {"color": colour, "width": 1.5},
        "marker": {"type": "circle", "size": 5, "fill": fill, "border": fill},
    }


def _make_iteration_axis(whole: int) -> Options:
    """Return an axis from 0 to the last iteration, with ten marks or so at whole numbers."""
    whole = max(whole, 1)
    return {
        "name": "iteration",
        "name_font": _FONT,
        "num_font": _FONT,
        "min": 0,
        "max": whole,
        "major_unit": max(1, whole // 10),
        "num_format": "0",
    }
