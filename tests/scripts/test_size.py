"""Entry script of rule size, after a whole loop through the other three entry scripts."""

import csv

import numpy as np
import openpyxl
import pytest

import analyse
import group
import resize
import size
import start
from checked_case import write_design_workbook
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays, read_json
from sizing_case import DESIGN, PANELS, SPAN, STRIP, ZIGZAG, stage, write_small_mesh

PLACE = {"zigzag": ZIGZAG, "strip": STRIP}


@pytest.fixture(scope="module")
def loop(tmp_path_factory):
    """Run the loop from 60 mm until a verdict ends it; return its folder and analyses."""
    folder = tmp_path_factory.mktemp("design") / "sizing"
    mesh = write_small_mesh(folder.parent / "mesh.npz")
    start.main(
        folder / "00/thickness.xlsx", folder / "00/written.json", design="small", **PLACE,
        settings=stage("start", start_thickness=0.06), settings_hash="",
    )  # fmt: skip
    found, memory = [], None
    for number in range(31):
        here, after = folder / f"{number:02d}", folder / f"{number + 1:02d}"
        files = here / "analysis.json", here / "analysis.npz"
        before = tuple(str(path) for path in found[-1]) if found else None
        analyse.main(
            mesh, here / "thickness.xlsx", *files, design="small", iteration=number,
            span_m=SPAN, **PLACE, settings=stage("analyse"), settings_hash="base", previous=before,
        )  # fmt: skip
        found.append(files)
        if read_json(files[0])["verdict"] != "continue":
            break
        resize.main(
            *files, after / "thickness.xlsx", after / "memory.npz", after / "written.json",
            design="small", **PLACE, settings=stage("resize"),
            previous_memory=memory,
        )  # fmt: skip
        memory = after / "memory.npz"
    return folder, [files[0] for files in found]


def _size(folder, analyses, mesh=None):
    classes = folder / "classes.json", folder / "classes.npz"
    if mesh:
        group.main(mesh, analyses, *classes, span_m=SPAN, classes=3, settings=stage("analyse"))
    size.main(
        folder.parent / "mesh.npz", analyses,
        folder / "history.csv", folder / "history.xlsx",
        [folder / name for name in ("final.json", "final.npz", "iterations.npz")],
        design=DESIGN, settings=stage("size"),
    )  # fmt: skip


def test_loop_ends_and_is_gathered(loop):
    folder, analyses = loop
    _size(folder, analyses, folder.parent / "mesh.npz")
    last = read_json(analyses[-1])
    assert last["verdict"] in ("converged", "at_minimum_thickness")
    assert read_json(folder / "final.json") == last | {"delivered_iteration": len(analyses) - 1}
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [int(row["iteration"]) for row in rows] == list(range(len(analyses)))
    assert float(rows[-1]["volume_m3"]) == last["volume_m3"]
    final = read_arrays(folder / "final.npz")
    assert final["thickness"].shape == (PANELS,) and "utilization_cell" in final
    panels = read_arrays(folder / "iterations.npz")
    for number, path in enumerate(analyses):
        arrays = read_arrays(path.with_suffix(".npz"))
        assert np.array_equal(panels["thickness"][number], arrays["thickness"])
        used = panels["utilization_panel_mean"][number]
        assert np.array_equal(used, arrays["utilization_panel_mean"])
    write_design_workbook(folder.parent)
    book = openpyxl.load_workbook(folder.parent / "design.xlsx", read_only=True)
    assert {"checks", "reactions", "combinations"} <= set(book.sheetnames)
    assert {"summary", "panels", "history", "loads", "notes"} <= set(book.sheetnames)
    rows = list(book["panels"].iter_rows(values_only=True))
    column = rows[0].index("class")
    written = read_arrays(folder / "classes.npz")["panel_class"]
    assert [row[column] for row in rows[2 : 2 + PANELS]] == written.tolist()


def test_classes_cover_what_is_needed(loop):
    """No panel gets thinner, at most three thicknesses remain, and the volume adds up."""
    folder, analyses = loop
    classes = folder / "c.json", folder / "c.npz"
    mesh = folder.parent / "mesh.npz"
    group.main(mesh, analyses, *classes, span_m=SPAN, classes=3, settings=stage("analyse"))
    report, arrays = read_json(classes[0]), read_arrays(classes[1])
    needed = read_arrays(analyses[-1].with_suffix(".npz"))["thickness"]
    assert (arrays["thickness"] >= needed).all()
    assert len(np.unique(arrays["thickness"])) == len(report["classes"]) <= 3
    assert sum(item["panels"] for item in report["classes"]) == PANELS
    volume = sum(item["thickness_m"] * item["area_m2"] for item in report["classes"])
    assert volume == pytest.approx(report["volume_m3"], rel=1e-10)
    assert report["added_volume_relative"] == pytest.approx(
        volume / report["ungrouped_volume_m3"] - 1, abs=1e-10
    )
    assert report["verdict"] in ("holds", "fails") and set(report["criteria"]) == {
        "utilization_panel_mean", "displacement_vertical_m",
    }  # fmt: skip


def test_iterations_left_over_are_removed(loop):
    folder, analyses = loop
    (folder / "57").mkdir()
    (folder / "57/analysis.json").write_text("{}")
    _size(folder, analyses)
    assert not (folder / "57").exists() and analyses[-1].exists()


def test_cut_off_analysis_is_named(loop, tmp_path):
    analyses = loop[1]
    broken = tmp_path / "analysis.json"
    broken.write_text(analyses[0].read_text()[:40])
    with pytest.raises(InputError, match=r"analysis\.json: cannot be read as JSON: delete"):
        _size(tmp_path, [broken])
    assert not (tmp_path / "history.csv").exists()
