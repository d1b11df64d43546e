"""Thickness classes: never too thin, exactly the least added volume."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foldshell.sizing.classes import group_thicknesses


def brute_force(needed, area, count):
    """Least added volume over every choice of `count` class thicknesses among those needed."""
    values = np.unique(needed)
    best = np.inf
    for chosen in combinations(values, min(count, values.size)):
        if chosen[-1] < values[-1]:
            continue
        given_thickness = np.array(chosen)[np.searchsorted(chosen, needed)]
        best = min(best, float(np.sum(area * (given_thickness - needed))))
    return best


@settings(max_examples=200, deadline=None)
@given(
    st.lists(st.tuples(st.integers(40, 70), st.floats(0.1, 10.0)), min_size=1, max_size=9),
    st.integers(1, 5),
)
def test_equals_brute_force(panels, count):
    needed = np.array([thickness / 1000 for thickness, _ in panels])
    area = np.array([size for _, size in panels])
    classes = group_thicknesses(needed, area, count)
    assert classes.added_volume == pytest.approx(brute_force(needed, area, count), abs=1e-12)
    assert (classes.thickness >= needed).all()
    assert classes.class_thickness.size == min(count, np.unique(needed).size)
    assert (np.diff(classes.class_thickness) > 0).all()
    assert (classes.class_thickness[classes.panel_class - 1] == classes.thickness).all()


def test_two_classes_by_hand():
    """t = 1, 2, 10 m on 1 m2 each: {1, 2} and {10} add 1 m3; {1} and {2, 10} would add 8."""
    classes = group_thicknesses([10.0, 1.0, 2.0], [1.0, 1.0, 1.0], 2)
    assert classes.class_thickness.tolist() == [2.0, 10.0]
    assert classes.panel_class.tolist() == [2, 1, 1]
    assert classes.added_volume == 1.0


def test_area_decides():
    """A large thin panel keeps its own class; equal areas would group otherwise."""
    needed = [1.0, 2.0, 4.0]
    assert group_thicknesses(needed, [1.0, 1.0, 1.0], 2).class_thickness.tolist() == [2.0, 4.0]
    assert group_thicknesses(needed, [5.0, 1.0, 1.0], 2).class_thickness.tolist() == [1.0, 4.0]


def test_enough_classes_change_nothing():
    needed = np.random.default_rng(1).uniform(0.04, 0.3, 50)
    classes = group_thicknesses(needed, np.ones(50), 50)
    assert (classes.thickness == needed).all() and classes.added_volume == 0.0


def test_more_classes_never_cost_more():
    generator = np.random.default_rng(2)
    needed, area = generator.uniform(0.04, 0.3, 210), generator.uniform(1, 3, 210)
    added = [group_thicknesses(needed, area, count).added_volume for count in range(1, 9)]
    assert added == sorted(added, reverse=True)
    assert added[0] == pytest.approx(float(np.sum(area * (needed.max() - needed))))


def test_order_of_panels_does_not_matter():
    generator = np.random.default_rng(3)
    needed, area = generator.uniform(0.04, 0.3, 60), generator.uniform(1, 3, 60)
    order = generator.permutation(60)
    plain = group_thicknesses(needed, area, 4)
    shuffled = group_thicknesses(needed[order], area[order], 4)
    assert (shuffled.thickness == plain.thickness[order]).all()


@pytest.mark.parametrize(
    ("needed", "area", "count"),
    [
        ([], [], 1),
        ([0.1], [1.0, 1.0], 1),
        ([0.1], [1.0], 0),
        ([np.nan], [1.0], 1),
        ([-0.1], [1.0], 1),
        ([0.1], [0.0], 1),
        ([0.1], [np.inf], 1),
    ],
)
def test_unusable_values(needed, area, count):
    with pytest.raises(ValueError):
        group_thicknesses(needed, area, count)
