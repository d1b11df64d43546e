"""What the rows of a set hold of a sheet: places, sentences, refusals, shares of reactions."""

import numpy as np
import pytest

from foldshell.settings.support_row import SupportRow
from foldshell.shell.border import Border
from foldshell.shell.held_supports import list_holds, share_nodes, sum_supports
from foldshell.shell.mesh import build_mesh
from foldshell.shell.mesh_files import mesh_folded_sheet
from foldshell.shell.select import HeldSheet, select
from foldshell.shell.support_rows import resolve_rows

ROWS, COLUMNS = 4, 5


def grid(turn=0.0):
    """Panels of 1 m x 2 m in 3 rows and 4 columns, saw-toothed by 0.5 m along x, in quads."""
    i, j = np.divmod(np.arange(ROWS * COLUMNS), COLUMNS)
    points = np.column_stack([1.0 * j, 2.0 * i, 0.5 * (j % 2)])
    c, s = np.cos(turn), np.sin(turn)
    points[:, :2] = points[:, :2] @ [[c, s], [-s, c]]
    number = np.arange(ROWS * COLUMNS).reshape(ROWS, COLUMNS)
    quads = np.stack(
        [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], -1
    ).reshape(-1, 4)
    facets = quads[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    return points, facets, i, j


def sheet(**more):
    points, facets, i, j = grid()
    panel = np.arange(len(facets)) // 2
    return HeldSheet(points, facets, panel, {"zigzag": i, "strip": j}, **more)


def folded():
    points, facets, i, j = grid()
    return {"vertices": points, "facets": facets, "zigzag": i, "strip": j}


def pairs_of(text):
    pairs, vertices = select(sheet(), text)
    return pairs.tolist(), vertices.tolist()


FIRST = [[0, 1], [1, 2], [2, 3], [3, 4]]
WEST = [[0, 5], [5, 10], [10, 15]]


@pytest.mark.parametrize(
    ("text", "pairs", "vertices"),
    [
        ("zigzag=first", FIRST, []),
        ("zigzag=last", [[15, 16], [16, 17], [17, 18], [18, 19]], []),
        ("strip=0", WEST, []),
        ("strip=1", [[1, 6], [6, 11], [11, 16]], []),
        ("side=y_min", FIRST, []),
        ("side=x_min", WEST, []),
        ("side=x_max", [[4, 9], [9, 14], [14, 19]], []),
        ("box -0.1 -0.1 2.1 0.1", [[0, 1], [1, 2]], []),
        ("box 0.9 1.9 1.1 2.1", [], [6]),
        ("polygon -1 -1, 2.2 -1, -1 4", [[0, 1], [0, 5]], []),
        ("zigzag=first & strip=first", [], [0]),
        ("zigzag=first & box -1 -1 1.5 1", [[0, 1]], []),
        ("border & z -1 0.1", [*WEST, [4, 9], [9, 14], [14, 19]], [2, 17]),
        ("edges 6-1 3-2", [[1, 6], [2, 3]], []),
        ("vertices 7 3", [], [3, 7]),
        ("point 2.2 2.1, 0 0 0.1", [], [0, 7]),
        ("corners", [], [0, 4, 15, 19]),
        ("edges 0-1 | corners", [[0, 1]], [4, 15, 19]),
    ],
)
def test_a_text_names_sides_and_vertices(text, pairs, vertices):
    found, alone = pairs_of(text)
    assert sorted(found) == sorted(pairs)
    assert sorted(alone) == sorted(vertices)


def test_a_region_does_not_hold_the_diagonal_of_a_panel():
    found, _ = pairs_of("box -0.1 -0.1 1.1 2.1")
    assert sorted(found) == [[0, 1], [0, 5], [1, 6], [5, 6]]


def test_sides_of_an_outline_are_counted_from_one():
    outline = np.array([[0, 0], [4, 0], [4, 6], [0, 6.0]])
    pairs, _ = select(sheet(outline=outline), "side=2")
    assert sorted(pairs.tolist()) == [[4, 9], [9, 14], [14, 19]]
    with pytest.raises(ValueError, match="the outline has 4 sides"):
        select(sheet(outline=outline), "side=5")


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (SupportRow("a", "box 50 50 60 60"), "holds nothing"),
        (SupportRow("a", "row=first"), r"no label row \(zigzag, strip\)"),
        (SupportRow("a", "zigzag=9"), "zigzag=9: the last one is 3"),
        (SupportRow("a", "side=2"), "has no outline"),
        (SupportRow("a", "edges 0-2"), "0-2 is no side of a panel"),
        (SupportRow("a", "edges 0-6"), "0-6 is no side of a panel"),
        (SupportRow("a", "vertices 99"), "99 is no vertex"),
        (SupportRow("a", "corners", "xyz", True), "vertex 0 at .* a vertex cannot be clamped"),
        (SupportRow("a", "edges 0-1 | corners", "", False, (1, 0, 0)), "at once"),
    ],
)
def test_a_row_that_cannot_hold_is_refused(row, words):
    with pytest.raises(ValueError, match=f"support 'a': .*{words}"):
        resolve_rows(sheet(), [row])


def test_each_row_says_what_it_holds():
    found = resolve_rows(sheet(), [SupportRow("west", "strip=first", "", True, (0, 0, 500.0))])
    assert found.reports == (
        "support 'west': 3 edges of 6 m, 4 vertices: clamped, spring along z of 500 kN/m per m",
    )
    assert found.warnings == ()


def test_what_a_run_leaves_unheld_is_named():
    rows = [SupportRow("half", "box -0.1 -0.1 0.1 4.1"), SupportRow("east", "strip=last")]
    (sentence,) = resolve_rows(sheet(), rows).warnings
    assert sentence == (
        "support 'half': 1 border edges of the same run are not held: 10-15, about "
        "[0.0, 5.0, 0.0] m"
    )


def test_a_point_far_from_any_vertex_is_spoken_of():
    (sentence,) = resolve_rows(sheet(), [SupportRow("p", "point 30 0")]).warnings
    assert "26 m off, vertex 4 at (4.000, 0.000, 0.000) m" in sentence


def test_corners_prefer_vertices_with_one_panel():
    """The nearest vertex of all would be another one where the sheet falls short of its corner."""
    points, facets, _, _ = grid()
    points[0] = [0.9, 0.4, 0]  # the corner of the sheet has drawn back
    border = Border(points, facets, np.arange(len(facets)) // 2)
    assert border.find_corners(np.array([[0.0, 0.0]])).tolist() == [0]


def test_a_vertex_at_the_corner_is_it_whatever_its_panels():
    """Corners of a grid cut into triangles from there have two panels, others beside them one."""
    points, facets, _, _ = grid()
    panel = np.arange(len(facets))
    border = Border(points, facets, panel)
    assert border.panels_at[[0, 19]].tolist() == [2, 2]
    assert border.find_plan_corners().tolist() == [0, 4, 19, 15]


def test_supports_that_leave_the_roof_free_are_refused():
    with pytest.raises(ValueError, match="free to move along"):
        mesh_folded_sheet(folded(), [SupportRow("a", "border", "yz")], 1)


def test_pinned_borders_and_a_set_of_them_hold_the_same():
    one = mesh_folded_sheet(folded(), "zigzag", 2)
    rows = [SupportRow("a", "zigzag=first"), SupportRow("b", "zigzag=last")]
    other = mesh_folded_sheet(folded(), rows, 2)
    assert np.array_equal(one["supported_nodes"], other["supported_nodes"])
    assert "support_names" not in one
    holds = list_holds(other)
    assert {name: hold.pairs.tolist() for name, hold in holds.items()} == {
        "a": one["support_pairs"][one["support_border"] == 0].tolist(),
        "b": one["support_pairs"][one["support_border"] == 1].tolist(),
    }


def test_reactions_are_shared_and_lost_nowhere():
    """A corner of two pins counts by half, and a spring beside a pin takes nothing."""
    rows = [
        SupportRow("a", "zigzag=first"),
        SupportRow("b", "strip=first", "xz"),
        SupportRow("c", "strip=first | zigzag=last", "", False, (0, 7.0, 0)),
    ]
    arrays = mesh_folded_sheet(folded(), rows, 2)
    points, facets, _, _ = grid()
    mesh = build_mesh(points, facets, subdivisions=2)
    nodes = arrays["supported_nodes"]
    shares = share_nodes(mesh, list_holds(arrays), nodes)
    corner = int(np.flatnonzero(nodes == 0)[0])
    assert shares["a"][corner].tolist() == [0.5, 1.0, 0.5]
    assert shares["b"][corner].tolist() == [0.5, 0.0, 0.5]
    assert shares["c"][corner].tolist() == [0.0, 0.0, 0.0]
    force = np.random.default_rng(1).normal(size=(len(nodes), 3, 2))
    total = sum(shares.values())
    assert set(np.unique(total.round(12))) <= {0.0, 1.0}
    found = sum_supports(mesh, arrays, nodes, force * total[:, :, None])
    assert sum(found.values()) == pytest.approx((force * total[:, :, None]).sum(axis=0))
