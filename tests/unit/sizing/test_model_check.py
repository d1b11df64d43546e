"""The state that ends a loop says what theory or mesh does not hold of it."""

import numpy as np
import pytest

from foldshell.records.plain import to_plain
from foldshell.sizing.case import open_case
from foldshell.sizing.iteration import IterationTask
from sizing_case import PANELS, SPAN, given, write_small_mesh


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    """A sheet of 6 m: panels of 2 x 1.6 m, width 1.5 m."""
    return write_small_mesh(tmp_path_factory.mktemp("mesh") / "mesh.npz")


def _analyse(mesh, thickness):
    """Analyse the last allowed iteration, so that the loop ends whatever it finds."""
    case = open_case(mesh, given("analyse"))
    last = case.sizing.iterations_max
    return case.run(IterationTask(last, SPAN, np.full(PANELS, thickness)))[0]


def test_panels_in_the_range_of_theory_and_mesh_give_no_warning(mesh):
    record = _analyse(mesh, 0.05)
    assert not record.goes_on
    assert record.model_warnings == () and record.warning is None
    assert to_plain(record)["model_warnings"] == []


@pytest.mark.parametrize(
    ("thickness", "words"),
    [
        (0.3, "12 of 12 panels are thicker than 1/10 of their width"),
        (0.01, "12 of 12 panels are thinner than 1/80 of their width"),
    ],
)
def test_thick_and_thin_panels_are_named(mesh, thickness, words):
    record = _analyse(mesh, thickness)
    assert words in record.model_warnings[0] and words in record.warning


def test_thicknesses_are_looked_at_without_displacements_too(mesh):
    """1 mm buckles below its loads: unstable, and named as too thin."""
    record = _analyse(mesh, 0.001)
    assert record.state == "unstable"
    assert "thinner than 1/80" in record.warning


def test_an_iteration_that_goes_on_says_nothing_yet(mesh):
    case = open_case(mesh, given("analyse"))
    record, _ = case.run(IterationTask(0, SPAN, np.full(PANELS, 0.3)))
    assert record.goes_on and record.model_warnings is None
    assert "model_warnings" not in to_plain(record)
