"""Analytic Jacobians against central differences, on a skewed, irregular sheet."""

import math

import numpy as np
import pytest

from folding_cases import differentiate, skewed_sheet
from foldshell.folding.problem import build_terms
from foldshell.folding.quadric import make_quadric
from foldshell.settings.design import SURFACES
from foldshell.settings.fold import FoldWeights

NAMES = ("stretch", "crease hinges", "neutral folds", "attraction", "plan edges")


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("number", range(5), ids=NAMES)
def test_jacobian_is_the_slope_of_the_residual(surface, number):
    """Central differences with step 1e-6 m are exact to about 1e-9 here."""
    sheet, vertices = skewed_sheet()
    target = make_quadric(surface, 4.0, 1.5)
    term = build_terms(sheet, target, "lowest", FoldWeights())[number]
    residual, values = term.evaluate(vertices)
    dense = np.zeros((len(residual), vertices.size))
    np.add.at(dense, (np.arange(len(residual))[:, None], term.columns), values)
    numeric = differentiate(lambda x: term.evaluate(x)[0], vertices)
    assert np.abs(numeric).max() > 1e-3
    assert np.abs(dense - numeric).max() < 1e-6 * np.abs(numeric).max()


def test_hinge_residual_wraps_to_the_nearest_turn():
    """A fold of 3.1 against a rest of -3.1 rad is 0.083 rad away, not 6.2."""
    from foldshell.folding.terms import Hinge

    angle = 3.1
    vertices = np.array(
        [[0, 0, 0], [0, 1, 0], [-1, 0.5, 0], [math.cos(angle), 0.5, math.sin(angle)]]
    )
    hinge = Hinge(np.array([[0, 1, 2, 3]]), np.array([-3.1]), 1.0)
    residual, _ = hinge.evaluate(vertices)
    assert abs(residual[0]) == pytest.approx(2 * math.pi - 6.2, abs=1e-12)
