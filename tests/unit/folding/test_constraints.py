"""Constraints of true origami: analytic Jacobians, and zero on a folded Miura sheet."""

import numpy as np
import pytest

from folding_cases import differentiate, skewed_sheet
from foldshell.folding.constraints import (
    Fairness,
    find_chains,
    keep_convex,
    keep_folded,
    require_developable,
    require_flat_foldable,
    require_planar,
)

BUILD = {
    "planar": lambda s: require_planar(s.grid, s.rest, 0.8, 2.0),
    "developable": lambda s: require_developable(s.grid, 2.0),
    "flat_foldable": lambda s: require_flat_foldable(s.grid, 2.0),
    "fairness": lambda s: Fairness(find_chains(s.grid), 0.8, 0.3),
    "convex": lambda s: keep_convex(s.grid, 1.3, 2.0),
    "folded": lambda s: keep_folded(s.grid, 1.2, 2.0),
}


@pytest.mark.parametrize("name", BUILD)
def test_jacobian_is_the_slope_of_the_residual(name):
    """Margins are set so wide that some corners and folds are outside, some inside."""
    sheet, vertices = skewed_sheet(8, 8)
    term = BUILD[name](sheet)
    residual, values = term.evaluate(vertices)
    dense = np.zeros((len(residual), vertices.size))
    np.add.at(dense, (np.arange(len(residual))[:, None], term.columns), values)
    numeric = differentiate(lambda x: term.evaluate(x)[0], vertices)
    assert np.abs(residual).max() > 1e-3
    assert np.abs(dense - numeric).max() < 1e-6 * np.abs(numeric).max()
    if name in ("convex", "folded"):
        assert (residual == 0).any()


@pytest.mark.parametrize("name", ["planar", "developable", "flat_foldable", "fairness"])
def test_folded_miura_meets_every_constraint(name):
    sheet, _ = skewed_sheet(9, 8)
    residual, _ = BUILD[name](sheet).evaluate(sheet.rest)
    assert len(residual) and np.abs(residual).max() < 1e-13
