"""The engineering verdict on a small sheet: linear theory by superposition, closed forms."""

import numpy as np
import pytest

import checked_case
from foldshell.checks.strips import find_strips
from foldshell.files.whole import read_arrays, read_json, write_arrays
from foldshell.records.analysis import write_analysis
from foldshell.records.analysis_arrays import AnalysisArrays
from foldshell.records.arrays import write_typed_arrays
from foldshell.results import engineering_record, engineering_state
from foldshell.results.section_forces import average_panels
from foldshell.shell.analysis import ShellAnalysis
from foldshell.shell.effort import KNOWN, USUAL
from foldshell.shell.stress import stress_resultants
from foldshell.sizing.case import open_case
from foldshell.sizing.iteration import IterationTask
from sizing_case import PANELS, SPAN, given, write_small_mesh

LINEAR = {"analysis": {"second_order": False}}
THICKNESS = 0.06


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A design whose loop ended after one analysis."""
    folder = tmp_path_factory.mktemp("checked")
    mesh = write_small_mesh(folder / "mesh.npz")
    case = open_case(mesh, given("analyse", iterations_max=1))
    task = IterationTask(0, SPAN, np.full(PANELS, THICKNESS))
    record, arrays = case.run(task, alone=True)
    (folder / "sizing").mkdir()
    assert isinstance(arrays, AnalysisArrays)
    write_typed_arrays(folder / "sizing/final.npz", arrays)
    write_analysis(folder / "sizing/final.json", record)
    return folder


def checked(folder, **settings):
    path = checked_case.run_check(folder, **settings)
    return read_json(path), read_arrays(path.with_suffix(".npz"))


def test_long_term_displacement_is_1_plus_phi_times_that_of_linear_theory(folder):
    """Of G alone, whose characteristic combination is SLS1; E / (1 + phi) softens all alike."""
    young = checked(folder, checks={"creep_coefficient": 0.0, "cracked_stiffness": 1.0}, **LINEAR)
    old = checked(folder, checks={"creep_coefficient": 2.0, "cracked_stiffness": 1.0}, **LINEAR)
    values = [one[0]["checks"]["displacement_long_term"]["value"] for one in (young, old)]
    assert values[1] == pytest.approx(3 * values[0], rel=1e-9)
    assert "displacement_long_term_cracked" not in old[0]["checks"]


@pytest.mark.parametrize("load", [1.0, 900.0])
def test_sustained_states_begin_with_known_modes_and_are_those_of_a_full_search(
    folder, monkeypatch, load
):
    """Modes decide nothing but whether there is a state, so displacements are equal to the bit.
    Under 900 times the load least factors are low: random vectors come in there."""
    efforts = []

    class Watched(ShellAnalysis):
        def run(self, effort, start=None):
            efforts.append(effort)
            return super().run(USUAL if plain else effort, start)

    monkeypatch.setattr(engineering_state, "ShellAnalysis", Watched)
    heavy = {"loads": {"superimposed_dead": load, "live": load}}
    heavy["material"] = {"strength_tension": 1.0}  # all panels crack
    plain = False
    found, _ = checked(folder, **heavy)
    low = load > 1
    assert efforts == [USUAL, KNOWN, *[USUAL] * low, KNOWN, *[USUAL] * low]
    plain = True
    expected, _ = checked(folder, **heavy)
    names = ("displacement_long_term", "displacement_long_term_cracked")
    assert [found["checks"][name] for name in names] == [expected["checks"][n] for n in names]


def test_cracked_panels_are_softer_and_the_effect_stands_beside(folder):
    """With every panel cracked all stiffness halves, and displacements double."""
    weak = {"strength_tension": 1.0}
    found, _ = checked(folder, material=weak, **LINEAR)
    one, two = (
        found["checks"][name]["value"]
        for name in ("displacement_long_term", "displacement_long_term_cracked")
    )
    assert all(found["panels"]["cracked"]) and two == pytest.approx(2 * one, rel=1e-9)
    assert found["analyses"] == 3


def test_reactions_close_with_the_loads_under_every_combination(folder):
    found, arrays = checked(folder)
    total = arrays["edge_reaction"].sum(axis=0)
    assert total == pytest.approx(-arrays["load_sum"], abs=1e-7)
    assert arrays["vertex_reaction"].sum(axis=0) == pytest.approx(total, abs=1e-9)
    names = [*found["combinations"]["strength"], *found["combinations"]["characteristic"]]
    for k, name in enumerate(names):
        factors = found["combinations"]["strength"] | found["combinations"]["characteristic"]
        by_cases = sum(f * np.array(found["loads"][c]) for c, f in factors[name].items())
        assert by_cases == pytest.approx(arrays["load_sum"][:, k], abs=1e-7)


def test_wind_turns_round(folder):
    """Both signs of each wind stand among the combinations of EN 1990."""
    found, _ = checked(folder)
    for purpose in ("strength", "characteristic"):
        for case in ("WX", "WY"):
            factors = {one.get(case, 0) for one in found["combinations"][purpose].values()}
            assert {np.sign(f) for f in factors} == {-1, 0, 1}


def test_materials_have_their_own_strength(folder):
    """Steel by von Mises over gamma_M: the value is in proportion to it."""
    values = []
    for gamma in (1.0, 1.25):
        found, _ = checked(folder, material={"kind": "steel"}, checks={"partial_factor": gamma})
        values.append(found["checks"]["strength"]["value"])
        assert found["buckling_terms"]["required"] == 1.5
    assert values[1] == pytest.approx(1.25 * values[0], rel=1e-9)
    plain = {"kind": "none"}
    concrete, _ = checked(folder, material={"strength_tension": 100.0}, reinforcement=plain)
    assert concrete["verdict"] == "fails"
    assert concrete["reason"].startswith("tension without reinforcement in ")


def test_without_second_order_stability_is_not_known_and_not_met(folder):
    found, _ = checked(folder, **LINEAR)
    check = found["checks"]["stability"]
    assert check["met"] is False and check["value"] is None
    assert "not known" in found["reason"]


def test_panel_means_of_a_constant_field_are_that_field(folder):
    """u = a x: N = E t / (1 - nu^2) eps on every facet, in axes that follow global x.

    On a facet with unit tangent axes e1, e2 the strain is e_i . A . e_j of the gradient A.
    """
    settings = given("analyse")
    case = open_case(folder / "mesh.npz", settings)
    model, material = case.model, case.material
    mesh = model.mesh
    gradient = 1e-4 * np.array([[1.0, 0.3, 0.0], [0.3, -0.5, 0.2], [0.0, 0.2, 0.4]])
    moved = np.zeros((mesh.dof_count, 1))
    moved[: 3 * len(mesh.nodes), 0] = (mesh.nodes @ gradient).ravel()
    thickness = model.to_elements(np.full(PANELS, THICKNESS))
    found = stress_resultants(model.operators, moved, thickness, material.youngs_modulus)
    strips = find_strips(model.operators, 0.3)
    means = average_panels(model.operators, strips, found)[0]
    rows = np.flatnonzero(strips.edge[:, 0] < 0)
    normal, nu = strips.axes[rows, 2], material.poissons_ratio
    x = np.array([1.0, 0, 0]) - normal[:, :1] * normal
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    axes = np.stack([x, np.cross(normal, x)], axis=1)
    strain = np.einsum("fax,xy,fby->fab", axes, gradient, axes)
    xx, yy, xy = strain[:, 0, 0], strain[:, 1, 1], strain[:, 0, 1]
    scale = material.youngs_modulus * THICKNESS / (1 - nu**2)
    own = scale * np.stack([xx + nu * yy, yy + nu * xx, (1 - nu) * xy], axis=1)
    area, panel = strips.area[rows], strips.panel[rows]
    due = [np.bincount(panel, area * own[:, k]) / np.bincount(panel, area) for k in range(3)]
    assert means[:, :3] == pytest.approx(np.stack(due, axis=1), rel=1e-9, abs=1e-9)


def test_a_rule_that_makes_no_combinations_leaves_the_verdict_open(folder, monkeypatch):
    """One sentence in the record; all files are there."""

    def refuse(*_):
        raise ValueError("the rule makes 900 combinations of these cases: at most 200 are allowed")

    monkeypatch.setattr(engineering_record, "engineering_combinations", refuse)
    found, arrays = checked(folder)
    assert found["verdict"] == "not_applicable" and "900 combinations" in found["reason"]
    assert not arrays and not found["checks"]


def test_a_shell_that_buckles_fails_and_one_that_is_a_mechanism_too(folder, tmp_path):
    """All files are whole; the reason says what happened."""
    soft, arrays = checked(folder, material={"youngs_modulus": 1e3})
    assert soft["verdict"] == "fails" and soft["checks"]["stability"]["met"] is False
    assert "is below 1" in soft["reason"] and "edge_reaction" in arrays
    final = read_arrays(folder / "sizing/final.npz")
    home = tmp_path / "thin"
    (home / "sizing").mkdir(parents=True)
    for name in ("mesh.npz", "sizing/final.json"):
        (home / name).write_bytes((folder / name).read_bytes())
    thin = {"thickness": np.full(PANELS, 1e-9)}
    names = ("utilization_cell", "displacement", "buckling_modes", "translations")
    rest = {name: values for name, values in final.items() if name not in names}
    write_arrays(home / "sizing/final.npz", rest | thin)
    found, arrays = checked(home)
    assert found["verdict"] == "fails" and found["reason"].startswith("mechanism: ")
    assert not arrays and not found["checks"]
