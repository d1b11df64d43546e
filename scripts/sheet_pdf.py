"""Rule sheet_pdf: the calculation sheet of a design as PDF, A4."""

import io
from pathlib import Path

from PIL import Image

from foldshell.engine.job import run_job
from foldshell.files.whole import read_json
from foldshell.report.pdf import pack_data, write_pdf


def main(data_path: str | Path, picture: str | Path, pdf_path: str | Path) -> None:
    """Write the sheet of `data_path` (sheet.json), with the picture at half its size."""
    sheet = read_json(data_path)
    sketch = sheet.pop("sketch").encode()
    stream = io.BytesIO()
    with Image.open(picture) as whole:
        whole.convert("RGB").reduce(2).save(stream, format="PNG")
    files = {"sheet.json": pack_data(sheet), "sketch.svg": sketch}
    write_pdf(pdf_path, "sheet", files | {"utilization.png": stream.getvalue()})


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(snakemake.input.data, snakemake.input.picture, snakemake.output.pdf)  # noqa: F821
