"""Headline numbers of the mesh in use, each made a second time from its displacements."""

import numpy as np
import pytest

from foldshell.checks.utilization import compute_utilization
from foldshell.loads.cases import make_load_cases
from foldshell.results.mesh_convergence import study_mesh
from foldshell.shell.analysis import analyse_shell
from foldshell.sizing.case import open_case
from sizing_case import PANELS, corrugated_sheet, given, write_small_mesh


def test_numbers_of_the_first_mesh_are_those_of_its_own_displacements(tmp_path):
    """The percentile by NumPy's weighted quantile; panel means by averages panel by panel."""
    settings = given("analyse")
    case = open_case(write_small_mesh(tmp_path / "mesh.npz"), settings)
    model, material = case.model, settings.material
    thickness = np.linspace(0.03, 0.06, PANELS)
    cases = make_load_cases(settings.loads, material.unit_weight)
    names = {name: settings.combinations.all[name] for name in ("S2", "D3")}
    study = study_mesh(corrugated_sheet(), "all", thickness, 2, material, cases, names)
    each = model.to_elements(thickness)
    moved = analyse_shell(model, each, material, cases, names).first_order
    used = compute_utilization(model, moved, each, material).combination
    area, panel = model.operators.geometry.area, model.mesh.panel
    nodes = moved[: 3 * len(model.mesh.nodes)].reshape(-1, 3, len(names))
    for column, name in enumerate(names):
        found, point = study.combinations[name], used[column].reshape(len(area), -1)
        weights = np.repeat(area, point.shape[1])
        p90, p99 = np.quantile(
            point.ravel(), [0.9, 0.99], weights=weights, method="inverted_cdf"
        )  # fmt: skip
        assert found.utilization_p99[0] == pytest.approx(p99, rel=1e-9)
        assert p90 < 0.95 * p99 < 0.95 * point.max()
        means = [
            np.average(point[panel == number].mean(axis=1), weights=area[panel == number])
            for number in range(PANELS)
        ]
        assert found.utilization_panel_mean_max[0] == pytest.approx(max(means), rel=1e-9)
        down = -nodes[:, 2, column].min()
        assert found.displacement_down_max_m[0] == pytest.approx(down, rel=1e-9)
        largest = np.linalg.norm(nodes[:, :, column], axis=1).max()
        assert found.displacement_max_m[0] == pytest.approx(largest, rel=1e-9)
