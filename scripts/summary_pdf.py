"""Rule summary_pdf: the summary of a study as PDF, A4."""

import io
from collections.abc import Mapping
from pathlib import Path

from PIL import Image

from foldshell.engine.job import run_job
from foldshell.report.pdf import pack_data, write_pdf
from foldshell.report.study_report import read_study
from foldshell.report.summary_sheet import make_summary_sheet


def main(
    paths: Mapping[str, str | Path],
    pdf_path: str | Path,
    *,
    study: str,
    results: str | Path,
) -> None:
    """Write counts, worst checks, a table of all designs, and the page of all pictures.

    `paths` are summary (csv), tiles (json) and sheet (png), `results` has one folder per design.
    """
    files = read_study(study, paths, results, {})
    data = make_summary_sheet(files)
    stream = io.BytesIO()
    with Image.open(paths["sheet"]) as whole:
        whole.convert("RGB").save(stream, format="PNG")
    pictures = {"all_thickness.png": stream.getvalue()}
    write_pdf(pdf_path, "summary", {"summary.json": pack_data(data)} | pictures)


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            dict(snakemake.input.items()),  # noqa: F821
            snakemake.output.pdf,  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
