"""Rule report_pages: summary, verification and settings as pages for the report."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from foldshell.engine.environment import list_versions
from foldshell.engine.job import run_job
from foldshell.files.whole import atomic_path
from foldshell.records.summary import SummaryRow
from foldshell.records.table import read_rows
from foldshell.report.study_pages import (
    write_markdown_page,
    write_settings_page,
    write_summary_page,
)
from foldshell.results.summary import hash_study
from foldshell.settings.stage import Plain, read_stage
from foldshell.settings.stages import STAGES

PACKAGES = ("snakemake", "numpy", "scipy", "vtk", "meshio", "XlsxWriter", "openpyxl", "Pillow",
            "matplotlib")  # fmt: skip


def main(
    summary: str | Path,
    verification: Sequence[str | Path],
    pages: Mapping[str, str | Path],
    settings: Plain,
) -> None:
    """Write `pages`: summary, verification (of Markdown files), settings."""
    versions = list_versions(PACKAGES)
    text = "\n\n".join(Path(path).read_text(encoding="utf-8") for path in verification)
    study_hash = hash_study(read_rows(summary, SummaryRow))
    given = read_stage(settings, *STAGES["study"])
    written = {
        "summary": write_summary_page(summary),
        "verification": write_markdown_page("Verification", text),
        "settings": write_settings_page(given, study_hash, versions),
    }
    for name, page in written.items():
        with atomic_path(pages[name]) as temporary:
            temporary.write_text(page, encoding="utf-8")


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input.summary,  # noqa: F821
            snakemake.input.verification,  # noqa: F821
            dict(snakemake.output.items()),  # noqa: F821
            snakemake.params.settings,  # noqa: F821
        )
