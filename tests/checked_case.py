"""The engineering checks and the workbook of a design whose loop has run, for tests."""

from pathlib import Path

import check
import design_workbook
from foldshell.records.files import write_record
from record_cases import make_convergence
from sizing_case import DESIGN, SPAN, stage


def run_check(folder: Path, design: str = "small", **settings) -> Path:
    """Write checks/engineering.* of a design from mesh.npz and sizing/final.*; return the JSON."""
    home = folder / "checks"
    errors = folder / "mesh_convergence.json"
    if not errors.exists():
        write_record(errors, make_convergence())
    paths = {
        "mesh": folder / "mesh.npz",
        "mesh_convergence": errors,
        "arrays": folder / "sizing/final.npz",
        "final": folder / "sizing/final.json",
    }
    given = stage("size") | stage("checks")
    for group, values in settings.items():
        given[group] = given[group] | values
    files = [home / f"engineering.{kind}" for kind in ("json", "npz", "xlsx")]
    check.main(paths, *files, design=design, span_m=SPAN, settings=given)
    return files[0]


def write_design_workbook(folder: Path, design: dict = DESIGN) -> Path:
    """Write design.xlsx of a design after its checks."""
    record = run_check(folder)
    loop = folder / "sizing"
    paths = {
        "final": loop / "final.json",
        "classes": loop / "classes.json",
        "class_arrays": loop / "classes.npz",
        "engineering": record,
        "engineering_arrays": record.with_suffix(".npz"),
    }
    path = folder / "design.xlsx"
    design_workbook.main(paths, path, design=design, settings=stage("size"))
    return path
