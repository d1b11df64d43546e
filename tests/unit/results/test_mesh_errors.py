"""Mesh errors from a state on two meshes."""

import pytest

from foldshell.records.mesh_convergence import CombinationStudy, MeshStudy, ReferenceMesh
from foldshell.results.mesh_errors import estimate_errors, find_largest_errors


def test_errors_against_the_extrapolated_value_and_buckling_apart():
    """Meshes 4 and 12, order 2: the limit is an eighth of the difference beyond the finer value."""
    names = ("displacement_max_m", "work_knm", "utilization_p99", "utilization_panel_mean_max")
    values = dict.fromkeys(names, (1.0, 1.0))
    values |= {"displacement_down_max_m": (0.92, 1.0), "buckling_factor": (5.35, 4.65)}
    sums = dict.fromkeys(("reaction_sum_kn", "load_sum_kn"), ((0.0, 0.0, 1.0),) * 2)
    study = MeshStudy(
        subdivisions=(4, 12), reference=ReferenceMesh(order=7),
        combinations={"S2": CombinationStudy(**values, **sums, support_reactions_kn={})},
    )  # fmt: skip
    errors = estimate_errors(study)
    assert errors["S2"]["displacement_down_max_m"] == pytest.approx(0.09 / 1.01)
    assert errors["S2"]["buckling_factor"] == pytest.approx(0.7875 / 4.5625)
    largest = find_largest_errors(errors)
    assert largest == {
        "mesh_error": pytest.approx(0.09 / 1.01),
        "buckling_mesh_error": pytest.approx(0.7875 / 4.5625),
    }
    assert find_largest_errors({}) == {"mesh_error": None, "buckling_mesh_error": None}
