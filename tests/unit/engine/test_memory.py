"""Memory that jobs take, from panels and subdivisions, and what there is for them."""

import numpy as np
import pytest

from foldshell.engine.memory import (
    MB_AND_PER_NODE,
    check_room,
    choose_threads,
    count_nodes,
    estimate_memory,
    find_free_memory,
    find_memory,
    share_memory,
)
from foldshell.files.errors import InputError
from foldshell.pattern.grid import build_grid
from foldshell.shell.mesh import build_mesh

MEASURED = {
    "analyse": {5396: 551, 22776: 939, 40376: 1570},
    "mesh_convergence": {5396: 555, 22776: 1786, 40376: 3000},
    "compare": {5396: 558, 22776: 1909, 40376: 2908},
    "draw": {5396: 631, 22776: 631, 40376: 627},
    "page": {5396: 213, 22776: 375, 40376: 534},
}
"""Largest resident memory (MB) of jobs by nodes, two-core machine, 29 November 2026."""


@pytest.mark.parametrize("subdivisions", [1, 2, 4, 8])
@pytest.mark.parametrize("counts", [(3, 3), (5, 8), (15, 16)])
def test_nodes_are_those_of_the_mesh(counts, subdivisions):
    grid = build_grid(*counts)
    vertices = np.column_stack([grid.strip_index, grid.zigzag_index, 0 * grid.strip_index])
    mesh = build_mesh(vertices, grid.facets, None, subdivisions)
    assert count_nodes(*counts, subdivisions) == len(mesh.nodes)


@pytest.mark.parametrize(
    ("rule", "nodes", "measured"),
    [(rule, nodes, mb) for rule, found in MEASURED.items() for nodes, mb in found.items()],
)
def test_what_was_measured_is_covered_and_not_far_below(rule, nodes, measured):
    assert measured <= estimate_memory(rule, nodes) <= 1.25 * measured


def test_every_rule_takes_more_on_a_larger_mesh():
    for rule in MB_AND_PER_NODE:
        assert estimate_memory(rule, 1000) < estimate_memory(rule, 50_000)


def test_processes_that_wait_have_their_share():
    """Nine tenths of what is free, a fifth of it for them."""
    assert share_memory(10_000) == (7200, 1800)
    assert share_memory(None) == (None, None)
    assert find_free_memory() > 100


def test_a_design_beyond_the_machine_is_refused_with_what_it_takes_and_what_there_is():
    """100 x 100 lines at n = 4 are 0.89 million freedoms: 7.1e9 bytes at 8 kB each."""
    nodes = count_nodes(100, 100, 4)
    check_room("roof", 9801, nodes, 8000)
    check_room("roof", 9801, nodes, None)
    with pytest.raises(InputError) as refused:
        check_room("roof", 9801, nodes, 6000)
    assert "9801 panels" in str(refused.value) and "5.9 GB" in str(refused.value)
    assert "takes 7.0 GB" in str(refused.value)
    assert find_memory() >= find_free_memory()


def test_large_designs_alone_take_two_threads():
    assert choose_threads(count_nodes(15, 16, 4)) == 1
    assert choose_threads(count_nodes(52, 58, 4)) == 2
