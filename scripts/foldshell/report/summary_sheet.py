"""The summary of a study on A4, as plain data."""

from foldshell.files.whole import Json
from foldshell.report.checks import find_governing
from foldshell.report.markup import format_number, make_table
from foldshell.report.sheet import list_texts
from foldshell.report.study_columns import GOVERNING, choose_columns, count_verdicts, make_row
from foldshell.report.study_report import StudyFiles, describe_kinds, list_worst
from foldshell.results.summary import hash_study

SHOWN = (GOVERNING.key, "state", "engineering", "crosscheck", "volume_m3", "volume_per_area_m",
         "utilization_mean", "displacement_vertical_max_m", "buckling_factor_min",
         "mesh_error")  # fmt: skip
"""Columns of the table, as far as the study has them; the governing check stands last."""


def make_summary_sheet(files: StudyFiles) -> Json:
    """Return counts of verdicts, the worst checks, and a table with one row per design."""
    rows = [entry.row for entry in files.designs]
    columns = [column for column in choose_columns(rows) if column.key in SHOWN]
    table = []
    for entry in files.designs:
        governing = find_governing(entry.checks)
        cells = make_row(entry.row, columns, governing)
        words = governing.name if governing else "–"
        table.append((entry.name, *(cells[column.key] for column in columns), words))
    header = ["design", *(column.words for column in columns), "governs by the paper's criteria"]
    return {
        "title": f"Folded shells: study {files.study}",
        "kinds": f"{len(rows)} {'design' if len(rows) == 1 else 'designs'}: {describe_kinds(rows)}",
        "verdicts": {kind: ", ".join(f"{format_number(count)} {words}" for words, count, _ in found)
                     or "none in these results"
                     for kind, found in count_verdicts(rows).items()},
        "worst": list_texts(list_worst(files.designs)),
        "designs": list_texts(make_table(header, table)),
        "study_hash": hash_study(rows),
    }  # fmt: skip
