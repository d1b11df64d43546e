"""Richardson extrapolation against sequences whose limit is known."""

import numpy as np
import pytest

from crosscheck.extrapolation import compute_mesh_error, extrapolate, measure_order


@pytest.mark.parametrize("order", [1.0, 2.0, 3.0, 3.7])
def test_a_power_law_gives_its_limit_and_order(order):
    sizes = [2, 3, 5]
    values = [7.0 - 4.0 / n**order for n in sizes]
    assert measure_order(sizes, values, 9.0) == pytest.approx(order, abs=1e-9)
    assert extrapolate(sizes, values, order) == pytest.approx(7.0, abs=1e-12)


def test_two_meshes_keep_the_given_order_and_one_is_returned():
    assert measure_order([2, 3], [1.0, 1.1], 3.0) == 3.0
    assert extrapolate([4], [0.5], 3.0) == 0.5


def test_values_that_do_not_settle_in_one_direction_keep_the_given_order():
    assert measure_order([2, 3, 4], [1.0, 1.2, 1.1], 2.5) == 2.5


def test_an_order_out_of_bounds_is_held_at_them():
    assert measure_order([2, 3, 4], [0.0, 1.0, 1.9], 3.0) == pytest.approx(1.0)
    assert measure_order([2, 3, 4], [0.0, 1.0, 1.0001], 3.0) == pytest.approx(4.0)


def test_mesh_error():
    assert compute_mesh_error(0.98, 1.0) == pytest.approx(0.02)
    assert compute_mesh_error(0.0, 0.0) == 0.0
    assert np.isfinite(compute_mesh_error(1.0, 0.0))
