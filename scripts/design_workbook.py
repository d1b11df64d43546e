"""Rule design_workbook: the workbook of a design that an engineer opens."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from foldshell.engine.environment import list_versions
from foldshell.engine.job import run_job
from foldshell.records.arrays import read_typed_arrays
from foldshell.records.engineering import EngineeringArrays, EngineeringRecord
from foldshell.records.files import read_record
from foldshell.records.iteration import read_classes
from foldshell.results.gather import read_gathered
from foldshell.settings.analysed import ANALYSED
from foldshell.settings.design import Design, Row
from foldshell.settings.stage import Plain, read_stage
from foldshell.workbook.design import write_design
from foldshell.workbook.design_report import make_design_report

PACKAGES = ("numpy", "scipy", "cvxopt", "snakemake", "openpyxl", "XlsxWriter")


def main(
    paths: Mapping[str, str | Path],
    workbook_path: str | Path,
    *,
    design: Row,
    settings: Plain,
    folded: Sequence[str | Path] = (),
) -> None:
    """Write design.xlsx.

    `paths` are final, classes, engineering (json), class_arrays and engineering_arrays (npz); the
    rest of the loop stands beside final.json.
    """
    one, given = Design.from_row(design), read_stage(settings, *ANALYSED)
    gathered = read_gathered(Path(paths["final"]).parent, given.sizing.measure)
    classes = read_classes(paths["classes"], paths["class_arrays"])
    record = read_record(paths["engineering"], EngineeringRecord)
    arrays = read_typed_arrays(paths["engineering_arrays"], EngineeringArrays)
    more = list_versions(PACKAGES), *classes, folded, record, arrays
    write_design(workbook_path, make_design_report(gathered, one, given, *more))


if "snakemake" in globals():
    with run_job(snakemake):  # noqa: F821
        main(
            snakemake.input,  # noqa: F821
            snakemake.output.workbook,  # noqa: F821
            folded=snakemake.input.get("folded", ()),  # noqa: F821
            **snakemake.params,  # noqa: F821
        )
