"""Rule size: gather the iterations of a design into its history and its final state."""

from collections.abc import Sequence
from pathlib import Path

from foldshell.engine.job import run_job
from foldshell.records.history import HistoryRow
from foldshell.records.table import write_rows
from foldshell.results.gather import gather_iterations, remove_superseded, write_final
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.design import Design, Row
from foldshell.settings.stage import Plain, read_stage
from foldshell.workbook.design_report import make_design_report
from foldshell.workbook.history import write_history


def main(
    mesh_path: str | Path,
    json_paths: Sequence[str | Path],
    csv_path: str | Path,
    history_path: str | Path,
    final_paths: Sequence[str | Path],
    *,
    design: Row,
    settings: Plain,
    folded: Sequence[str | Path] = (),
) -> None:
    """Write histories, panels of all iterations and the analysis that is delivered.
    What is left behind the last is removed; edited workbooks of that stay in sizing/superseded."""
    one, given = Design.from_row(design), read_stage(settings, *ANALYSED)
    iterations = gather_iterations(json_paths, one.span, given, mesh_path)
    report = make_design_report(iterations, one, given, {}, folded=folded)
    write_rows(csv_path, HistoryRow, iterations.history)
    write_history(history_path, iterations.history, *report.judged)
    write_final(*final_paths, iterations)
    remove_superseded(Path(csv_path).parent, len(json_paths))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.mesh,  # noqa: F821
            snakemake.input.analyses,  # noqa: F821
            (files := snakemake.output).csv,  # noqa: F821
            files.history,
            (files.final, files.arrays, files.panels),
            folded=snakemake.input.get("folded", ()),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
