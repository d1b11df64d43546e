"""The shell element against published problems: values, bounds, orders and the table of them."""

import re

import numpy as np
import pytest
from shell_chapter import PROBLEMS, README, measured_order, patch_rows, render

QUICK = [problem for problem in PROBLEMS if problem.quick]
LONG = [problem for problem in PROBLEMS if not problem.quick]


def check(problem):
    """Every mesh within its bound of the limit, and no mesh worse than the first."""
    error = np.abs(np.array(problem.values()) - problem.limit)
    assert (error <= problem.bounds).all(), dict(zip(problem.meshes, error, strict=True))
    assert error[-1] <= error[0]


@pytest.mark.parametrize("problem", QUICK, ids=lambda problem: problem.name)
def test_quick_problem(problem):
    check(problem)


@pytest.mark.verification
@pytest.mark.parametrize("problem", LONG, ids=lambda problem: problem.name)
def test_long_problem(problem):
    check(problem)


def test_order_of_a_known_sequence():
    assert measured_order((1, 2, 4), (1.16, 1.04, 1.01)) == pytest.approx(2)
    assert measured_order((1, 2), (1.1, 1.00001)) is None


@pytest.mark.verification
def test_smooth_problems_converge_fast_and_singular_ones_at_their_rate():
    """Supported and clamped plates are smooth; a ring's facets turn, which costs h^2."""
    for problem in PROBLEMS:
        order = measured_order(problem.meshes, problem.values(), problem.limit)
        if "plate buckling" in problem.name:
            assert order > 2.5, problem.name
        if problem.name == "ring under dead radial load":
            assert order == pytest.approx(2, abs=0.3)


@pytest.mark.verification
def test_the_table_shows_what_is_computed_now():
    """Text equal but for numbers, and numbers within 3 in the last of four digits."""
    number = r"\d+\.\d+"
    written, fresh = README.read_text(encoding="utf-8"), render()
    assert re.sub(number, "#", written) == re.sub(number, "#", fresh), "regenerate the table"
    old, new = (np.array(re.findall(number, text), float) for text in (written, fresh))
    orders = np.abs(old - new) <= 0.11
    assert (np.abs(old - new) <= 3e-4).sum() >= len(old) - len(PROBLEMS)
    assert orders.all()


@pytest.mark.verification
def test_patches_are_exact_and_rigid_motions_free():
    rows = patch_rows()
    assert [row[4] for row in rows] == ["largest relative error below 1e-10"] * 2 + ["6"]
