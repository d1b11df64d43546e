"""The numbers of analysis.json, each made a second time from the fields of the same analysis."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from foldshell.checks.utilization import area_percentile, compute_utilization
from foldshell.sizing.case import open_case
from foldshell.sizing.iteration import IterationTask
from sizing_case import PANELS, SPAN, given, write_small_mesh

LEAST, LARGEST = 0.02, 0.05


@pytest.fixture(scope="module")
def analysed(tmp_path_factory):
    """Return case, record, arrays and utilization of the corrugated sheet, thin to thick, of a
    material so weak that some panels are used beyond the limit."""
    mesh = write_small_mesh(tmp_path_factory.mktemp("mesh") / "mesh.npz")
    case = open_case(mesh, given("analyse", least_thickness=LEAST, largest_thickness=LARGEST))
    case = replace(case, material=case.material.changed(strength=2000.0))
    thickness = np.linspace(LEAST, LARGEST, PANELS)
    thickness[3] = LEAST
    task = IterationTask(case.sizing.iterations_max, SPAN, thickness)
    record, arrays = case.run(task)
    strength = arrays.displacement[:, : len(case.combinations.strength)]
    each = case.model.to_elements(thickness)
    return case, record, arrays, compute_utilization(case.model, strength, each, case.material)


def test_largest_percentile_and_mean_are_those_of_the_sheet(analysed):
    """The percentile by NumPy's weighted quantile, whose inverse of the distribution it is."""
    case, record, arrays, used = analysed
    area = case.model.operators.geometry.area
    point = used.point.ravel()
    weights = np.repeat(area, point.size // len(area))
    p90, p99 = np.quantile(point, [0.9, 0.99], weights=weights, method="inverted_cdf")
    assert record.utilization_p99 == pytest.approx(p99, rel=1e-12)
    assert record.utilization_p99 == area_percentile(case.model, used.point)
    mean = np.average(arrays.utilization_cell.mean(axis=1), weights=area)
    assert record.utilization_mean == pytest.approx(mean, rel=1e-12)
    assert record.utilization_max == arrays.utilization_cell.max()
    numbers = sorted([mean, p90, p99, record.utilization_max])
    assert all(lower < 0.95 * higher for lower, higher in pairwise(numbers))


def test_percentile_is_the_99th_unless_asked_for_another(analysed):
    case, _, _, used = analysed
    assert area_percentile(case.model, used.point) == area_percentile(case.model, used.point, 99.0)
    assert area_percentile(case.model, used.point) > area_percentile(case.model, used.point, 90.0)


def test_panel_numbers_are_those_of_the_arrays(analysed):
    case, record, arrays, used = analysed
    mesh, area = case.model.mesh, case.model.operators.geometry.area
    cell_mean = arrays.utilization_cell.mean(axis=1)
    means = [
        np.average(cell_mean[mesh.panel == number], weights=area[mesh.panel == number])
        for number in range(PANELS)
    ]
    assert record.utilization_panel_mean_max == pytest.approx(max(means), rel=1e-12)
    assert arrays.utilization_panel_mean == pytest.approx(means, rel=1e-12)
    assert record.panels_at_bound == 3
    assert record.panels_above_one == sum(mean > 1 for mean in means) > 1
    own = mesh.panel == int(np.argmax(means))
    of_combination = [
        np.average(values[own].mean(axis=(1, 2)), weights=area[own]) for values in used.combination
    ]
    names = list(case.combinations.strength)
    assert record.governing_combination == names[int(np.argmax(of_combination))]


def test_displacement_is_the_largest_downward_one_of_deflection_combinations(analysed):
    case, record, arrays, _ = analysed
    nodes = case.model.mesh.nodes
    first = len(case.combinations.strength)
    down = -arrays.displacement[2 : 3 * len(nodes) : 3, first:]
    node, column = np.unravel_index(down.argmax(), down.shape)
    assert record.displacement_vertical_max_m == down.max() > 0
    assert record.displacement_combination == list(case.combinations.deflection)[column]
    assert record.displacement_place_m == tuple(nodes[node])


def test_volume_and_area_are_those_of_the_panels(analysed):
    case, record, arrays, _ = analysed
    corners = case.model.mesh.nodes[case.model.mesh.corners]
    sides = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.linalg.norm(np.cross(*sides), axis=1) / 2
    thickness = arrays.thickness[case.model.mesh.panel]
    assert record.volume_m3 == pytest.approx(area @ thickness, rel=1e-12)
    assert record.area_m2 == pytest.approx(area.sum(), rel=1e-12)
