"""The order observed on three meshes, and the flag of those that are not asymptotic."""

import numpy as np
import pytest

from foldshell.loads.cases import make_load_cases
from foldshell.records.mesh_convergence import ReferenceMesh
from foldshell.results.mesh_convergence import DesignOnMeshes, study_design
from foldshell.results.mesh_errors import make_record
from foldshell.results.mesh_order import (
    add_third_mesh,
    choose_third,
    is_asymptotic,
    observe_order,
)
from sizing_case import PANELS, corrugated_sheet, given


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("sizes", [(4, 8, 12), (2, 3, 6), (1, 2, 4)])
def test_an_order_is_found_again(order, sizes):
    """v = 3 - 2 h^p exactly; the table of orders is interpolated, to 1e-3."""
    values = [3 - 2 / size**order for size in sizes]
    assert observe_order(sizes, values) == pytest.approx(order, abs=2e-3)


def test_values_that_turn_back_or_jump_have_no_order():
    assert observe_order((4, 8, 12), (1.0, 1.2, 1.1)) is None
    assert observe_order((4, 8, 12), (1.0, 1.0, 1.0)) is None
    assert observe_order((4, 8, 12), (1.0, 2.0, 2.0 + 1e-12)) is None


def test_the_flag():
    """Settled within 1 %, or an order of at least 1, is asymptotic; else it is not."""
    assert is_asymptotic((1.0, 1.005, 1.001), None)
    assert is_asymptotic((1.0, 1.2, 1.25), 2.0)
    assert not is_asymptotic((1.0, 1.2, 1.25), 0.4)
    assert not is_asymptotic((1.0, 1.2, 1.1), None)


def test_which_mesh_is_the_third():
    folded, curved = corrugated_sheet(), {"surface": np.zeros((7, 7, 3))}
    assert choose_third(folded, 4) == (ReferenceMesh(subdivisions=8), 8.0)
    assert choose_third(curved, 4) == (ReferenceMesh(panel_parts=2), pytest.approx(8 / 3))
    flat = folded | {"vertices": folded["vertices"] * [1, 1, 0]}
    assert choose_third(flat, 4)[0].subdivisions == 2


def test_the_record_says_what_the_third_mesh_found():
    settings = given("analyse")
    cases = make_load_cases(settings.loads, settings.material.unit_weight)
    names = {name: settings.combinations.all[name] for name in ("S2", "D3")}
    design = DesignOnMeshes(corrugated_sheet(), "all", np.full(PANELS, 0.05), settings.material,
                            cases, names)  # fmt: skip
    record = make_record(study_design(design, 1))
    assert record.third is None
    third = add_third_mesh(record, design).third
    assert third.mesh.subdivisions == 2 and third.subdivisions == 2
    assert set(third.values) == {"S2", "D3"} == set(third.observed_order)
    assert third.not_asymptotic == bool(third.doubtful)
    own = design.analyse({"subdivisions": 2}).values
    assert third.values["D3"]["work_knm"] == own["D3"].work_knm
