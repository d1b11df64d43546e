"""A design with an edge beam through all entry scripts from mesh to pictures."""

import csv

import numpy as np
import openpyxl
import pytest
import pyvista

import analyse
import draw
import group
import mesh
import resize
import size
import start
from checked_case import write_design_workbook
from foldshell.files.whole import read_arrays, read_json, write_arrays
from foldshell.report.arrays import pack_arrays, unpack_arrays
from foldshell.report.viewer_data import make_viewer_data
from foldshell.results.design_view import view_design
from foldshell.results.state import read_state
from foldshell.results.summary import make_summary_row
from foldshell.shell.mesh_files import read_mesh
from foldshell.sizing.case import open_case
from foldshell.sizing.iteration import IterationTask
from foldshell.workbook.panels import make_panel_grid
from foldshell.workbook.read_thickness import read_thickness
from sizing_case import DESIGN, PANELS, SPAN, STRIP, ZIGZAG, corrugated_sheet, given, stage

BEAM = [0.4, 0.1]
BEAM_PANELS = 2 * (ZIGZAG - 1)
PLACE = {"zigzag": ZIGZAG, "strip": STRIP}
SIZES = {"edge_beam_depth_m": BEAM[0], "edge_beam_thickness_m": BEAM[1]}


def write_mesh_files(folder):
    sheet = corrugated_sheet() | {"planarity": np.zeros(PANELS)}
    write_arrays(folder / "folded.npz", sheet)
    paths = [folder / name for name in ("folded.npz", "mesh.npz", "mesh.vtu")]
    mesh.main(*paths, design="small", support="zigzag", subdivisions=2, edge_beam=BEAM)
    return paths[1]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Run the entry scripts for one analysis; return the folder of the design."""
    folder = tmp_path_factory.mktemp("design")
    shell = write_mesh_files(folder)
    loop, here = folder / "sizing", folder / "sizing/00"
    start.main(
        here / "thickness.xlsx", here / "written.json", design="small", **PLACE,
        settings=stage("start", start_thickness=0.06), settings_hash="",
    )  # fmt: skip
    files = here / "analysis.json", here / "analysis.npz"

    def run_analysis(**sizing):
        """Analyse iteration 00; without any iteration allowed it is the last one."""
        analyse.main(
            shell, here / "thickness.xlsx", *files, design="small", iteration=0, span_m=SPAN,
            **PLACE, settings=stage("analyse", **sizing), settings_hash="base",
        )  # fmt: skip

    run_analysis()
    after = loop / "01"
    resize.main(
        *files, after / "thickness.xlsx", after / "memory.npz", after / "written.json",
        design="small", **PLACE, settings=stage("resize"),
    )  # fmt: skip
    new = read_thickness(after / "thickness.xlsx", make_panel_grid(ZIGZAG, STRIP), 0.04, 1.0)
    assert new.shape == (PANELS,)
    run_analysis(iterations_max=1)
    classes = loop / "classes.json", loop / "classes.npz"
    settings = stage("analyse")
    group.main(shell, [files[0]], *classes, span_m=SPAN, classes=2, settings=settings)
    size.main(
        shell, [files[0]], loop / "history.csv", loop / "history.xlsx",
        [loop / name for name in ("final.json", "final.npz", "iterations.npz")],
        design=DESIGN | SIZES, settings=stage("size"),
    )  # fmt: skip
    write_design_workbook(folder, DESIGN | SIZES)
    return folder


def test_edge_beam_panels_are_reported_and_not_sized(folder):
    """Volume of sheet and edge beam adds up; the edge beam's utilization stands on its own."""
    report = read_json(folder / "sizing/final.json")
    arrays = read_arrays(folder / "sizing/final.npz")
    shell, mesh_arrays = read_mesh(folder / "mesh.npz")
    corner = mesh_arrays.vertices[mesh_arrays.facets]
    area = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    area = np.linalg.norm(area, axis=1) / 2
    sheet, beam = np.split(area, [2 * PANELS])
    assert arrays["thickness"].shape == arrays["utilization_panel_mean"].shape == (PANELS,)
    assert report["edge_beam_volume_m3"] == pytest.approx(beam.sum() * BEAM[1])
    total = 0.06 * sheet.sum() + beam.sum() * BEAM[1]
    assert report["volume_m3"] == pytest.approx(total)
    assert report["area_m2"] == pytest.approx(sheet.sum())
    cell = arrays["utilization_cell"]
    bare = shell.panel >= PANELS
    assert report["edge_beam_utilization_max"] == cell[bare].max()
    assert report["utilization_max"] == cell[~bare].max()
    criterion = report["criteria"]["edge_beam_utilization"]
    assert criterion["value"] == report["edge_beam_utilization_panel_mean_max"]
    assert criterion["limit"] == 1.0
    grouped = read_json(folder / "sizing/classes.json")["criteria"]["edge_beam_utilization"]
    assert grouped["value"] == pytest.approx(criterion["value"])


def test_workbooks_and_summary_show_the_edge_beam(folder):
    with open(folder / "sizing/history.csv", newline="") as file:
        (row,) = csv.DictReader(file)
    report = read_json(folder / "sizing/final.json")
    assert float(row["edge_beam_utilization_max"]) == report["edge_beam_utilization_max"]
    book = openpyxl.load_workbook(folder / "design.xlsx", read_only=True)
    words = dict(line[:2] for line in book["summary"].iter_rows(values_only=True))
    assert words["edge beam depth"] == BEAM[0]
    assert words["edge beam utilization max"] == pytest.approx(report["edge_beam_utilization_max"])
    rows = list(book["panels"].iter_rows(values_only=True))
    assert [row[0] for row in rows[2 : 3 + PANELS]] == [*range(PANELS), None]
    line = make_summary_row(DESIGN | SIZES, folder)
    assert line.edge_beam_depth_m == BEAM[0]
    assert line.edge_beam_utilization_max == report["edge_beam_utilization_max"]
    plain = make_summary_row(DESIGN | dict.fromkeys(SIZES, 0.0), folder)
    assert plain.edge_beam_depth_m is None


@pytest.mark.slow
def test_pictures_and_fields_show_the_edge_beam(folder):
    names = ("thickness", "classes", "utilization", "planarity")
    pictures = {name: folder / f"{name}.png" for name in names}
    loop = folder / "sizing"
    figures = {"figures": {"width_px": 320, "height_px": 240}}
    draw.main(
        folder / "mesh.npz", folder / "folded.npz", loop / "final.npz", loop / "final.json",
        loop / "classes.npz", folder / "design.vtu", folder / "lines.vtu", pictures,
        design="small", span_m=SPAN, pattern="miura", settings=stage("size") | figures,
    )  # fmt: skip
    assert all(path.stat().st_size > 1000 for path in pictures.values())
    fields = dict(pyvista.read(folder / "design.vtu").cell_data)
    beam = fields["panel"] >= PANELS
    assert np.unique(fields["panel"]).size == PANELS + BEAM_PANELS
    assert (fields["thickness"][beam] == BEAM[1]).all()
    assert (fields["thickness_class"][beam] == 0).all()
    assert (fields["class_thickness"][beam] == BEAM[1]).all()


def test_page_shows_the_edge_beam(folder):
    """Thickness and utilization of sheet and edge beam; planarity and class of panels only."""
    loop = folder / "sizing"
    inputs = [folder / "mesh.npz", folder / "folded.npz", loop / "final.npz", loop / "final.json"]
    state = read_state("small", *inputs, given("size").combinations, loop / "classes.npz")
    view = make_viewer_data(view_design(state, given("size"), SPAN, "miura"))
    arrays = unpack_arrays(*pack_arrays(view.arrays))
    beam = slice(PANELS, PANELS + BEAM_PANELS)
    known = read_arrays(loop / "final.npz")["edge_beam_utilization_panel_mean"]
    assert known.shape == (BEAM_PANELS,)
    half_step = 1e-5 * max(state.panel_utilization)
    for name in ("panel_utilization", "field_utilization_mean"):
        assert arrays[name][beam] == pytest.approx(known, abs=half_step)
    assert arrays["panel_thickness"][beam] == pytest.approx(BEAM[1], abs=1e-6)
    assert arrays["field_thickness"][beam] == pytest.approx(1e3 * BEAM[1], abs=1e-3)
    for name in ("field_planarity", "field_class"):
        assert np.isnan(arrays[name][beam]).all()
        assert np.isfinite(arrays[name][:PANELS]).all()
    assert len(arrays["panel_zigzag"]) == PANELS
    assert arrays["panel"].max() == PANELS + BEAM_PANELS - 1


def test_gradients_of_the_constraints_leave_the_edge_beam_out(folder):
    """d(utilization of the edge beam's worst panel)/dt of a panel against a central difference."""
    limit = 0.3
    settings = given("analyse", rule="optimality", utilization_max=limit, utilization_min=0.1)
    settings = settings.changed(settings.analysis.changed(second_order=False))
    case = open_case(folder / "mesh.npz", settings)
    base = np.full(PANELS, 0.004)

    def run(thickness):
        return case.run(IterationTask(0, SPAN, thickness))

    report, arrays = run(base)
    beam = arrays.edge_beam_utilization_panel_mean
    assert arrays.panel_area.shape == (PANELS,)
    assert arrays.constraint_gradient.shape == (len(arrays.constraint_value), PANELS)
    assert report.criteria.edge_beam_utilization.value == beam.max() > limit
    above = (arrays.utilization_panel_mean > limit).sum()
    assert report.panels_above_one == above > 0 and report.panels_at_bound == PANELS
    row = int(np.argmin(np.abs(arrays.constraint_value - beam.max() / limit)))
    panel = int(np.abs(arrays.constraint_gradient[row]).argmax())
    step = 1e-6 * np.eye(PANELS)[panel]
    up, down = (run(base + sign * step)[1] for sign in (1, -1))
    up, down = (one.edge_beam_utilization_panel_mean for one in (up, down))
    slope = (up - down)[beam.argmax()] / 2e-6 / limit
    assert arrays.constraint_gradient[row, panel] == pytest.approx(slope, rel=1e-3)
