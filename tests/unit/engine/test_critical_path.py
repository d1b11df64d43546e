"""The simulation of many cores, against cases that can be counted on one hand."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "cluster"))

from critical_path import Job, find_longest, make_jobs, simulate

DIAMOND = {
    "a": Job(1.0, 0, ()),
    "b": Job(2.0, 0, ("a",)),
    "c": Job(3.0, 0, ("a",)),
    "d": Job(1.0, 0, ("b", "c")),
}


@pytest.mark.parametrize(("cores", "seconds"), [(1, 7.0), (2, 5.0), (8, 5.0)])
def test_a_diamond_of_jobs(cores, seconds):
    assert simulate(DIAMOND, cores) == seconds and find_longest(DIAMOND) == 5.0


def test_what_snakemake_takes_is_one_after_the_other():
    """Ten jobs at once, one more second between starts."""
    jobs = {str(number): Job(5.0, 0, ()) for number in range(10)}
    assert simulate(jobs, 10, 1.0) == 15.0


def test_the_longest_first_and_the_end_of_a_study():
    jobs = make_jobs({"x": {"size": 4.0, "draw": 1.0}, "y": {"size": 2.0}}, 0.0, (3.0,), True)
    assert simulate(jobs, 2) == find_longest(jobs) == 8.0
    assert simulate(make_jobs({"x": {"size": 4.0, "draw": 1.0}}, 0.0, (3.0,), False), 4) == 8.0
