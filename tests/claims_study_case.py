"""The files of a small design that the claims read."""

from dataclasses import replace
from functools import cache

import numpy as np

from foldshell.files.whole import write_arrays
from foldshell.records.files import write_record
from foldshell.records.iteration import write_iteration
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.case import make_case
from foldshell.sizing.iteration import IterationTask
from foldshell.sizing.loop import run_loop
from record_cases import (
    make_comparison,
    make_convergence,
    make_engineering,
    make_quality,
    make_quantity,
)
from sizing_case import DESIGN, PANELS, SPAN, STRIP, ZIGZAG, corrugated_sheet, given

LAYOUT = (ZIGZAG, STRIP, "strip")
ROW = DESIGN | {"support": "strip", "tags": "table1,supports"}
SIZING = {"least_thickness": 0.1}


@cache
def sized_small():
    mesh = mesh_folded_sheet(corrugated_sheet(), "strip", 2)
    settings = given("size", **SIZING)
    case = make_case(mesh, settings)
    thickness = np.full(PANELS, settings.sizing.start_thickness)
    first = case.run(IterationTask(0, SPAN, thickness))
    result = run_loop(case, SPAN, settings.sizing)
    return mesh, first, (result.final, result.arrays)


def write_small_design(folder):
    mesh, first, last = sized_small()
    write_arrays(folder / "shell/mesh.npz", mesh)
    planarity = np.linspace(0, 0.01, PANELS)
    write_arrays(folder / "folded/folded.npz", corrugated_sheet() | {"planarity": planarity})
    for path, (record, arrays) in (("00/analysis", first), ("final", last)):
        places = (folder / f"sizing/{path}.{kind}" for kind in ("json", "npz"))
        write_iteration(*places, record, arrays)
    write_record(folder / "folded/quality.json", make_quality())
    errors = {"displacement_down_max_m": 0.02, "utilization_panel_mean_max": 0.01}
    other = {name: 0.015 for name in errors}
    record = make_convergence({"S2": other, "S4": errors, "D3": errors})
    write_record(folder / "mesh_convergence.json", record)
    found = make_quantity(True, relative_difference=0.01, primary=1.0, primary_meshes=(1.02, 1.0))
    far = replace(found, relative_difference=0.03, primary_meshes=(1.04, 1.0))
    names = (*errors, "buckling_factor")
    quantities = {
        f"{c} {q}": far if c == "S2" else found for c in ("S2", "S4", "D3") for q in names
    }
    governing = {"displacement": "D3", "utilization": "S4", "buckling": "S4"}
    path = folder / "crosscheck/comparison.json"
    write_record(path, make_comparison(True, quantities, governing=governing))
    strips = {"utilization_strip": tuple(np.linspace(0.5, 1.5, PANELS).tolist())}
    write_record(folder / "checks/engineering.json", make_engineering(panels=strips))
