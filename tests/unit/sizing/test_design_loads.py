"""A design with a set of loads: the paper's five cases as a table, and gradients of own loads."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from foldshell.loads.cases import combination_matrix
from foldshell.records.plain import to_plain
from foldshell.settings.load_rows import LoadRow
from foldshell.settings.load_table import read_load_sets
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.make import make_settings
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.sizing.adjoint import open_adjoint
from foldshell.sizing.case import make_case
from foldshell.sizing.iteration import IterationTask
from sizing_case import corrugated_sheet

TABLE = Path(__file__).parents[3] / "config" / "loads.tsv"


def case_of(loads, **config):
    settings = replace(make_settings(config), loads=loads)
    return make_case(mesh_folded_sheet(corrugated_sheet(), "zigzag", 2), settings)


def run(case):
    thickness = np.linspace(0.05, 0.09, case.model.sized_panels)
    record, arrays = case.run(IterationTask(0, 6.0, thickness), alone=True)
    return {k: v for k, v in to_plain(record).items() if k != "seconds"}, arrays


@pytest.mark.parametrize("second_order", [True, False])
def test_the_table_of_the_five_cases_gives_the_same_bits(second_order):
    """Every number of the record, and displacements, bit for bit."""
    rows = tuple(row.to_text() for row in read_load_sets(TABLE)["table2"])
    config = {"analysis": {"second_order": second_order}}
    plain, arrays = run(case_of(Loads(), **config))
    found, others = run(case_of(Loads(rows=rows), **config))
    assert found == plain
    assert np.array_equal(arrays.displacement, others.displacement)


def test_table2_holds_the_defaults():
    sets = read_load_sets(TABLE)
    values = {row.case: row.value for row in sets["table2"]}
    plain = Loads()
    wind = plain.wind * plain.wind_fraction
    assert values == {"SW": 25.0, "SDL": plain.superimposed_dead, "LL": plain.live, "WX": wind,
                      "WY": wind}  # fmt: skip


def test_vertical_sdl_weighs_its_area():
    """0.5 kN/m2 of sheet straight down, in place of against the normals."""
    vertical = case_of(Loads(sdl_direction="vertical"))
    normal = case_of(Loads())
    area = vertical.model.operators.geometry.area
    sdl = vertical.placed.names.index("SDL")
    found = np.einsum("e,ex->x", area, vertical.placed.fixed[:, 0, :, sdl])
    assert found == pytest.approx([0, 0, -0.5 * area.sum()], abs=1e-12 * area.sum())
    up = normal.model.operators.geometry.frame[:, 2, 2]
    plan = np.einsum("e,ex->x", area, normal.placed.fixed[:, 0, :, sdl])
    assert plan[2] == pytest.approx(-0.5 * (area * up).sum())


def test_gradients_of_own_weights_are_those_of_differences():
    """The weight of some panels alone, at an angle of factors: d(displacement)/dt by the adjoint
    against central differences, first order."""
    rows = (
        LoadRow("A", "self_weight", 20.0, "-z", zone="panels 0-3"),
        LoadRow("B", "self_weight", None, "-z"),
        LoadRow("C", "pressure", 1.0, "-z", zone="side x-"),
        LoadRow("T", "temperature", 10.0, ""),
    )
    given = Combinations(strength={"S1": {"B": 1.0}}, deflection={"D1": {
        "A": 0.7, "B": 1.3, "C": 1.0, "T": 0.5}})  # fmt: skip
    settings = replace(
        make_settings({"analysis": {"second_order": False}}),
        loads=Loads(rows=tuple(row.to_text() for row in rows)), combinations=given,
    )  # fmt: skip
    case = make_case(mesh_folded_sheet(corrugated_sheet(), "zigzag", 2), settings)
    from foldshell.shell.analysis import analyse_shell

    model, rng = case.model, np.random.default_rng(2)
    start = np.linspace(0.05, 0.09, model.sized_panels)
    way = 1e-5 * rng.standard_normal(len(start))

    def solve(panels):
        thickness = model.to_elements(panels)
        return analyse_shell(
            model, thickness, case.material, case.placed, given.all, case.options
        ), thickness

    result, thickness = solve(start)
    node = int(np.argmin(result.displacement[2 : 3 * len(model.mesh.nodes) : 3, 1]))
    slope = case.placed.weight @ combination_matrix(given.all, case.placed.names)
    adjoint = open_adjoint(model, result, thickness, case.material, slope)
    unit = np.zeros((model.mesh.dof_count, 1))
    unit[3 * node + 2] = 1.0
    found = adjoint.sum_panels(adjoint.implicit(adjoint.solve(unit), np.array([1])))[0] @ way
    values = [solve(start + sign * way)[0].displacement[3 * node + 2, 1] for sign in (1, -1)]
    assert found == pytest.approx((values[0] - values[1]) / 2, rel=1e-5)
