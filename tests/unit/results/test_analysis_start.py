"""The mesh error of a state that is known is that of one analysed from nothing."""

from dataclasses import replace

import numpy as np
import pytest

from foldshell.loads.cases import make_load_cases
from foldshell.records.plain import to_plain
from foldshell.results import analysis_start
from foldshell.results.analysis_start import pick_known
from foldshell.results.mesh_convergence import DesignOnMeshes, study_design
from foldshell.shell.analysis import ShellAnalysis
from foldshell.sizing.case import open_case
from foldshell.sizing.iteration import IterationTask
from sizing_case import PANELS, SPAN, corrugated_sheet, given, write_small_mesh

NAMES = ("S2", "D3")


@pytest.fixture(scope="module")
def delivered(tmp_path_factory):
    """A thin sheet, which buckles at a low factor, as a loop would deliver it."""
    settings = given("analyse")
    path = write_small_mesh(tmp_path_factory.mktemp("mesh") / "mesh.npz")
    task = IterationTask(0, SPAN, np.linspace(0.012, 0.02, PANELS))
    report, final = open_case(path, settings).run(task, alone=True)
    names = {name: settings.combinations.all[name] for name in NAMES}
    cases = make_load_cases(settings.loads, settings.material.unit_weight)
    cold = DesignOnMeshes(
        corrugated_sheet(), "all", final.thickness, settings.material, cases, names
    )
    known = pick_known(final, report, settings.combinations.all, NAMES)
    return cold, known


def compare(cold, warm, tolerance):
    """Hold every number of two studies against each other; forces against the largest one."""
    for name in NAMES:
        pairs = [(cold.combinations[name], warm.combinations[name])]
        pairs += [tuple(one.second_order for one in pairs[0])]
        for one, other in pairs:
            for key, value in to_plain(one).items():
                if key != "second_order":
                    mine, given = (np.array(_flatten(x)) for x in (value, to_plain(other)[key]))
                    scale = np.abs(mine).max()
                    assert np.abs(mine - given).max() <= tolerance * scale, (name, key)


def _flatten(value):
    if isinstance(value, dict):
        return [number for one in value.values() for number in _flatten(one)]
    if isinstance(value, list):
        return [number for one in value for number in _flatten(one)]
    return [value]


def test_a_known_state_has_the_numbers_of_one_analysed_from_nothing(delivered, monkeypatch):
    """Factors are searched for to a change of 1e-2, which leaves up to 5e-5 of them in the cold
    study; second order ends at 1e-6. The known state takes one step and no search."""
    cold, known = delivered
    searches, steps = [], []

    class Watched(ShellAnalysis):
        def run(self, *given):
            searches.append(given)
            return super().run(*given)

        def bend(self, *given):
            result = super().bend(*given)
            steps.append(result.second_order.iterations)
            return result

    monkeypatch.setattr("foldshell.results.mesh_convergence.ShellAnalysis", Watched)
    warm = study_design(replace(cold, known=known), 2)
    assert len(searches) == 1 and steps[0] == 1
    searches.clear()
    steps.clear()
    expected = study_design(cold, 2)
    assert len(searches) == 2 and steps[0] > 2
    assert min(expected.combinations["S2"].buckling_factor) < 20
    compare(expected, warm, 1e-4)
    first = (expected.combinations[name].displacement_max_m for name in NAMES)
    assert list(first) == [warm.combinations[name].displacement_max_m for name in NAMES]


def test_where_a_state_begins_does_not_matter(delivered):
    """A displacement that is wrong, as that of an imperfect shape would be, is no answer: second
    order goes on from it to the state of the perfect shape. To 1e-5, a few steps of 1e-6."""
    cold, known = delivered
    wrong = replace(known, displacement=1.3 * known.displacement)
    found = study_design(replace(cold, known=wrong), 2)
    compare(study_design(replace(cold, known=known), 2), found, 1e-5)


def test_modes_of_another_mesh_are_no_start(delivered):
    cold, known = delivered
    found = study_design(replace(cold, known=known), 1)
    compare(study_design(cold, 1), found, 1e-12)


def test_what_is_missing_is_searched_for(delivered):
    """A factor that is not known (nothing compressed, or not asked for) is found from the modes."""
    cold, known = delivered
    parts = [replace(known, factors=None), replace(known, displacement=None)]
    for part in parts:
        compare(study_design(cold, 2), study_design(replace(cold, known=part), 2), 1e-4)
    assert analysis_start.remember(None, ResultOfNoBuckling()) is None


class ResultOfNoBuckling:
    buckling = None
