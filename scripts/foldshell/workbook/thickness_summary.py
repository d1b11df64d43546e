"""What the summary sheet of thickness.xlsx says: limits, and what is known of which analysis."""

from foldshell.records.analysis import AnalysisRecord
from foldshell.settings.sizing import Sizing
from foldshell.workbook.styles import Line

NOT_ANALYSED = "not analysed yet"


def summarise_start(
    design: str, least_thickness: float, largest_thickness: float, settings_hash: str
) -> list[Line]:
    """Return the lines of the first workbook, which no analysis stands behind; bounds in m."""
    verdict = Line("verdict", NOT_ANALYSED, judged=True)
    bounds = _bounds(least_thickness, largest_thickness)
    return [*_head(design, 0), verdict, *bounds, Line("settings hash", settings_hash)]


def summarise_step(design: str, analysis: AnalysisRecord, sizing: Sizing) -> list[Line]:
    """Return the lines of the workbook that follows an analysis.

    Verdict, volume and the columns of results are those of that analysis, and say so.
    """
    of_it = f"of analysis {analysis.iteration:02d}"
    return [
        *_head(design, analysis.iteration + 1),
        Line(f"verdict {of_it}", f"{analysis.verdict}: {analysis.reason}", judged=True),
        Line(f"volume {of_it}", analysis.volume_m3, "m3"),
        Line("columns previous, utilization", of_it),
        Line("utilization of a panel", sizing.measure.replace("_", " ")),
        *_bounds(sizing.least_thickness, sizing.largest_thickness),
        Line("utilization, at least", sizing.utilization_min),
        Line("utilization, at most", sizing.utilization_max),
        Line("settings hash", analysis.settings_hash),
    ]


def _head(design: str, iteration: int) -> list[Line]:
    return [Line("design", design), Line("iteration", iteration)]


def _bounds(least: float, largest: float) -> list[Line]:
    return [Line("least thickness", least, "m"), Line("largest thickness", largest, "m")]
