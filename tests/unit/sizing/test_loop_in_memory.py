"""The loop in memory and the loop of the entry scripts give the same numbers, to the last bit."""

import json

import numpy as np
import pytest

import analyse
import resize
import start
from foldshell.files.whole import read_arrays
from foldshell.records.arrays import list_arrays
from foldshell.records.plain import to_plain
from foldshell.sizing.case import open_case
from foldshell.sizing.loop import run_loop
from foldshell.workbook.panels import make_panel_grid, mirror_panels
from sizing_case import SPAN, STRIP, ZIGZAG, given, stage, write_small_mesh

FILES_ONLY = {"workbook_sha256", "settings_hash"}


def _run_files(folder, mesh, **sizing):
    """Run start, analyse and resize as the rules do; return reports and the last arrays."""
    grid = {"zigzag": ZIGZAG, "strip": STRIP}
    start.main(folder / "00/thickness.xlsx", folder / "00/written.json", design="small",
               settings_hash="0" * 12, **grid, settings=stage("start", **sizing))  # fmt: skip
    reports, previous = [], None
    while not reports or reports[-1]["verdict"] == "continue":
        number = len(reports)
        step, before = folder / f"{number:02d}", folder / f"{number - 1:02d}"
        if number:
            memory = before / "memory.npz"
            resize.main(
                *previous, step / "thickness.xlsx", step / "memory.npz", step / "written.json",
                design="small", settings=stage("resize", **sizing),
                previous_memory=memory if memory.exists() else None, **grid,
            )  # fmt: skip
        paths = step / "analysis.json", step / "analysis.npz"
        analyse.main(mesh, step / "thickness.xlsx", *paths, design="small", iteration=number,
                     span_m=SPAN, settings=stage("analyse", **sizing), settings_hash="base",
                     previous=previous, **grid)  # fmt: skip
        previous = paths
        reports.append(json.loads(paths[0].read_text()))
    return reports, read_arrays(previous[1])


@pytest.mark.parametrize(
    "sizing",
    [
        {"least_thickness": 0.1},
        {"rule": "optimality", "least_thickness": 0.1},
        {"thickness_step": 0.01, "symmetry": "both", "least_thickness": 0.03},
        {"rule": "stress_ratio", "least_thickness": 0.02},
        {"analyse_only": True},
        {"rule": "filtered_dead_band", "measure": "strip", "buckling_factor_min": 60.0},
    ],
)
def test_same_numbers_as_in_files(tmp_path, sizing):
    mesh = write_small_mesh(tmp_path / "mesh.npz")
    reports, arrays = _run_files(tmp_path, mesh, **sizing)
    limits = mirror_panels(make_panel_grid(ZIGZAG, STRIP), sizing.get("symmetry", "none"))
    result = run_loop(open_case(mesh, given("analyse", **sizing)), SPAN,
                      given("size", **sizing).sizing, limits)  # fmt: skip
    assert len(result.analyses) == len(reports)
    assert len(reports) == 1 if "analyse_only" in sizing else len(reports) > 2
    for own, other in zip(result.analyses, reports, strict=True):
        plain = json.loads(json.dumps(to_plain(own)))
        assert {k: v for k, v in plain.items() if k not in FILES_ONLY} == {
            k: v for k, v in other.items() if k not in FILES_ONLY
        }
    own = list_arrays(result.arrays)
    assert set(arrays) == set(own)
    for name, values in arrays.items():
        empty = name in ("panel_least", "panel_largest")
        assert np.array_equal(values, own[name], equal_nan=empty), name
