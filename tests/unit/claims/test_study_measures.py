"""Measures of an analysed state on small sheets with known answers."""

import numpy as np
import pytest

from foldshell.claims.measures import (
    Layout,
    measure_depth,
    measure_edge_displacement,
    measure_panel_areas,
    measure_state,
    measure_utilization,
    weighted_variation,
)
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.settings.loads import Combinations
from foldshell.shell.mesh_files import mesh_folded_sheet
from record_cases import make_analysis
from sizing_case import PANELS, STRIP, ZIGZAG, corrugated_sheet


def make_arrays(**arrays):
    return AnalysisArrays(thickness=np.full(PANELS, 0.1), **arrays)


@pytest.mark.parametrize(
    ("support", "panels"),
    [
        ("all", []),
        ("strip", [0, 1, 2, 3, 8, 9, 10, 11]),
        ("zigzag", [0, 3, 4, 7, 8, 11]),
    ],
)
def test_panels_along_free_edges(support, panels):
    """Panel p = i (strip_count - 1) + j; strips held leave the first and last row of i free."""
    assert np.flatnonzero(Layout(ZIGZAG, STRIP, support).free_edge_panels).tolist() == panels


def test_largest_displacement_along_free_edges_and_elsewhere():
    """Downward by y in one combination: largest along the last zig-zag, a free edge. Nodes off
    the rows beside free edges reach two thirds into the middle row of 2 m."""
    mesh = mesh_folded_sheet(corrugated_sheet(), "strip", 2)
    moved = np.zeros((len(mesh["nodes"]), 3, 4))
    moved[:, 2, 0] = -99.0  # a strength combination
    moved[:, 2, 2] = -mesh["nodes"][:, 1]
    found = measure_edge_displacement(mesh, Layout(ZIGZAG, STRIP, "strip"), moved, 2)
    assert found["displacement_edge"] == pytest.approx(6.3)
    assert found["displacement_inner"] == pytest.approx(2 + 2 * 2 / 3 + 0.3)
    held = measure_edge_displacement(mesh, Layout(ZIGZAG, STRIP, "all"), moved, 2)
    assert held == {"displacement_edge": None, "displacement_inner": None}


def test_panels_of_edge_beams_do_not_count():
    """A strip's panels follow those of the sheet; its nodes hang below the edge."""
    from foldshell.shell.edge_beams import make_edge_beam

    beam = make_edge_beam(0.5, 0.2)
    mesh = mesh_folded_sheet(corrugated_sheet(), "strip", 2, edge_beam=beam)
    bare = mesh_folded_sheet(corrugated_sheet(), "strip", 2)
    layout = Layout(ZIGZAG, STRIP, "strip")
    arrays = make_arrays(utilization_panel_mean=np.linspace(0.1, 1.2, PANELS))
    with_beam, without = (
        measure_utilization(one, layout, arrays, "panel_mean") for one in (mesh, bare)
    )
    assert with_beam == pytest.approx(without)
    areas = [measure_panel_areas(one, layout) for one in (mesh, bare)]
    assert areas[0] == pytest.approx(areas[1])
    moved = np.ones((len(mesh["nodes"]), 3, 1))
    assert measure_edge_displacement(mesh, layout, moved, 1)["displacement_edge"] == -1.0


def test_panels_above_one_by_the_measure_of_the_limits():
    mesh = mesh_folded_sheet(corrugated_sheet(), "zigzag", 1)
    arrays = make_arrays(
        utilization_panel_mean=np.full(PANELS, 0.5),
        utilization_element_max=np.where(np.arange(PANELS) < 2, 1.5, 0.9),
    )
    layout = Layout(ZIGZAG, STRIP, "zigzag")
    found = measure_utilization(mesh, layout, arrays, "element_max")
    assert (found["above_one"], found["above_one_at_free_edge"]) == (2, 1)
    assert found["utilization_variation"] == pytest.approx(0, abs=1e-12)
    assert measure_utilization(mesh, layout, arrays, "panel_mean")["above_one"] == 0


def test_no_answer_gives_no_numbers():
    mesh = mesh_folded_sheet(corrugated_sheet(), "all", 1)
    groups = Combinations({"S1": {}}, {"D1": {}})
    layout = Layout(ZIGZAG, STRIP, "all")
    found = measure_state(mesh, layout, make_analysis(), make_arrays(), groups, "panel_mean")
    assert found.utilization_variation is None and found.above_one is None
    assert found.panel_area > 0 and found.volume_change is None


def test_least_factor_is_that_of_the_strength_combinations():
    factors = {"S1": 4.0, "S2": 3.0, "S3": None, "D1": 2.0}
    record = make_analysis(iteration=14, volume_m3=80.0, area_m2=1600.0, buckling_factor=factors)
    groups = Combinations(strength={"S1": {}, "S2": {}, "S3": {}}, deflection={"D1": {}})
    mesh = mesh_folded_sheet(corrugated_sheet(), "all", 1)
    found = measure_state(
        mesh, Layout(ZIGZAG, STRIP, "all"), record, make_arrays(), groups, "panel_mean"
    )
    assert found.buckling_factor == 3.0 and found.iterations == 15
    assert found.volume_per_area == 0.05 and found.displacement is None


def test_depth_of_a_folded_sheet_on_a_slope():
    """Zig-zags alternately 0.4 m above and below a plane stand 0.8 m off their neighbours'
    middle, whatever the slope along and across."""
    zigzag, strip = (index.ravel() for index in np.indices((7, 4)))
    height = 0.4 * (-1.0) ** zigzag
    slope = 0.3 * zigzag + 0.2 * strip
    vertices = np.column_stack([strip, zigzag, slope + height])
    assert measure_depth(vertices, 7, 4) == pytest.approx(0.8)


def test_weighted_variation():
    """Values 1 and 3 with weights 3 and 1: mean 1.5, variance 0.75."""
    found = weighted_variation(np.array([1.0, 3.0]), np.array([3.0, 1.0]))
    assert found == pytest.approx(0.75**0.5 / 1.5)
