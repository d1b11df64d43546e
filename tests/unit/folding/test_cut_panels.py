"""Sheets cut by an outline: what is left in plan, no seams, true pieces, facets for analysis.

The sheets are the paraboloid of 9 x 8 lines over 14 m, 4 m high, in two modes: planar panels, and
warped ones whose facets are cut. Overlaps in plan are measured by shapely on their own.
"""

from collections import Counter
from functools import cache

import numpy as np
import pytest
import shapely

from foldshell.files.errors import InputError
from foldshell.folding.cut_files import cut_arrays, cut_folded_sheet, read_exact_cut
from foldshell.folding.fold import fold_sheet
from foldshell.folding.targets import make_target, measure_turning
from foldshell.folding.unfold_files import unfold_panels
from foldshell.pattern.design import design_sheet
from foldshell.pattern.facet_angles import measure_angles
from foldshell.pattern.outline import read_outline
from foldshell.records.arrays import list_arrays
from foldshell.settings.fold import Fold
from foldshell.settings.support_row import SupportRow
from foldshell.shell.edge_beams import EdgeBeam
from foldshell.shell.mesh_files import mesh_folded_sheet

CIRCLE = "polygon " + ", ".join(
    f"{5.5 * np.cos(a):.6f} {5.5 * np.sin(a):.6f}" for a in np.linspace(0, 2 * np.pi, 33)[:-1]
)
OUTLINES = {
    "circle": (CIRCLE, "none"),
    "ell": ("polygon -6 -6, 6 -6, 6 0, 0 0, 0 6, -6 6", "none"),
    "u": ("polygon -6 -6, 6 -6, 6 6, 2.5 6, 2.5 -2, -2.5 -2, -2.5 6, -6 6", "none"),
    "hole": ("box -6 -6 6 6", "polygon 0 -2, 2 0, 0 2, -2 0"),
    "holes in panels": ("box -6 -6 6 6", "box 0.3 0.3 0.5 0.45; box -3 1 -2.7 1.4"),
}


@cache
def whole(mode):
    target = make_target("paraboloid", 14, 4)
    sheet = design_sheet("miura", target.section_lengths(), 9, 8, 60.0,
                         turning=measure_turning(target))  # fmt: skip
    result = fold_sheet(sheet, target, mode, Fold())
    assert result.state == "ok"
    return sheet, result


@cache
def cut(mode, name):
    outline = read_outline(*OUTLINES[name])
    return cut_folded_sheet(*whole(mode), outline), outline


BOTH = pytest.mark.parametrize("mode", ["exact", "elastic"])
EACH = pytest.mark.parametrize("name", sorted(OUTLINES))


def plan_of(vertices, rings):
    return shapely.union_all(
        [shapely.make_valid(shapely.Polygon(vertices[ring, :2])) for ring in rings]
    )


def left_of(mode, outline):
    """What the outline leaves of the whole sheet's plan, by shapely alone."""
    sheet, result = whole(mode)
    plan = plan_of(result.shape.vertices, sheet.grid.facets)
    return plan.intersection(shapely.Polygon(outline.outer, outline.openings))


def overlap(one, two):
    return one.intersection(two).area / one.union(two).area


@BOTH
@EACH
def test_what_is_left_follows_the_outline(mode, name):
    found, outline = cut(mode, name)
    due = left_of(mode, outline)
    exact = overlap(plan_of(found.exact.vertices, found.exact.panels), due)
    shell = overlap(plan_of(found.shell.vertices, found.facets), due)
    assert exact >= 0.9999 and shell >= 0.995
    assert found.exact_share == pytest.approx(exact, abs=1e-9)
    assert found.shell_share == pytest.approx(shell, abs=1e-9)


@BOTH
@EACH
def test_no_seam_opens(mode, name):
    """Each side is run along once in each direction at most; one that is run along once lies on
    the outline or on the border of the whole sheet."""
    found, outline = cut(mode, name)
    sheet, result = whole(mode)
    edges = Counter(map(tuple, np.sort(sheet.grid.facets[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))
                        .tolist()))  # fmt: skip
    own = [shapely.LineString(result.shape.vertices[list(e)]) for e, n in edges.items() if n == 1]
    border = shapely.union_all(own)
    rings = [outline.outer, *outline.openings]
    drawn = shapely.union_all([shapely.LinearRing(ring) for ring in rings])
    for vertices, polygons in ((found.exact.vertices, found.exact.panels),):
        sides = Counter()
        for ring in polygons:
            sides.update(zip(ring.tolist(), np.roll(ring, -1).tolist(), strict=True))
        assert max(sides.values()) == 1
        for a, b in sides:
            if (b, a) not in sides:
                middle = shapely.Point(vertices[[a, b], :2].mean(axis=0))
                assert min(drawn.distance(middle), border.distance(middle)) < 1e-6


@BOTH
@EACH
def test_facets_can_be_analysed(mode, name):
    """Angles of 4 to 155 deg, no facet twice, and every side in one direction once."""
    found, _ = cut(mode, name)
    angles = np.degrees(measure_angles(found.shell.vertices, found.facets))
    assert angles.min() >= 4 and angles.max() <= 155
    sides = found.facets[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    assert len(np.unique(sides, axis=0)) == len(sides)
    assert np.array_equal(np.unique(found.facet_panel), np.arange(len(found.shell.panels)))
    assert np.array_equal(np.unique(found.facets), np.arange(len(found.shell.vertices)))


@EACH
def test_pieces_unfold_without_a_gap(name):
    """Distances between all corners of a piece are the same folded and flat, to 1e-9 m."""
    exact = cut("exact", name)[0].exact
    for ring in exact.panels:
        one, two = (
            np.linalg.norm(state[ring][:, None] - state[ring][None], axis=2)
            for state in (exact.vertices, exact.flat)
        )
        assert np.abs(one - two).max() < 1e-9


@EACH
def test_pieces_are_planar(name):
    exact = cut("exact", name)[0].exact
    assert exact.measure_warp().max() < 1e-9


@BOTH
def test_small_pieces_share_a_thickness(mode):
    """Each panel has at least 3 % of one of the whole sheet, and every piece a panel."""
    found, _ = cut(mode, "circle")
    sheet, result = whole(mode)
    corner = result.shape.vertices[sheet.grid.facets]
    size = np.linalg.norm(
        np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1
    )
    before = size.reshape(-1, 2).sum(axis=1) / 2
    assert set(found.piece_panel.tolist()) == set(range(len(found.shell.panels)))
    corner = found.shell.vertices[found.facets]
    size = np.linalg.norm(
        np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1
    )
    assert np.bincount(found.facet_panel, size / 2).min() > 0.02 * before.min()


def test_creases_keep_their_kind():
    """A sheet cut well inside keeps mountains and valleys alone, and its border."""
    exact = cut("exact", "ell")[0].exact
    assert set(exact.assignments.tolist()) == {"B", "M", "V"}


@BOTH
def test_the_arrays_make_a_mesh_with_supports_by_side(mode):
    found, outline = cut(mode, "hole")
    arrays = list_arrays(cut_arrays(found, outline))
    rows = [SupportRow("south", "side=1"), SupportRow("north", "side=3", "z")]
    mesh = mesh_folded_sheet(arrays, rows, 1)
    south = mesh["vertices"][mesh["support_pairs"][mesh["support_border"] == 0]]
    assert np.abs(south[..., 1] + 6).max() < 0.4, "short sides are collapsed, 0.2 of a panel's here"
    assert np.abs(np.diff(south[..., 0], axis=1)).sum() == pytest.approx(12, rel=0.05)
    assert not len(mesh["support_warnings"])
    pinned = mesh_folded_sheet(arrays, "all", 1)
    places = pinned["vertices"][np.unique(pinned["support_pairs"]), :2]
    assert np.abs(places).max(axis=1).min() > 5, "openings are not pinned"


def test_edge_beams_hang_from_cut_borders():
    found, outline = cut("exact", "hole")
    arrays = list_arrays(cut_arrays(found, outline))
    mesh = mesh_folded_sheet(arrays, [SupportRow("s", "side=1")], 1, edge_beam=EdgeBeam(0.4, 0.1))
    border = int((found.shell.assignments == "B").sum())
    held = int((mesh["support_border"] == 0).sum())
    assert len(mesh["fixed_thickness"]) == border - held


def test_the_flat_drawing_shows_the_cut(tmp_path):
    found, outline = cut("exact", "hole")
    arrays = cut_arrays(found, outline)
    drawing = unfold_panels(arrays, tmp_path / "flat.fold", "hole", "exact", 1.0)
    assert len(drawing.holes) == 1
    exact = read_exact_cut(arrays)
    area = sum(shapely.Polygon(exact.flat[ring, :2]).area for ring in exact.panels)
    drawn = shapely.Polygon(drawing.outline, drawing.holes)
    assert drawn.area * 1e-6 == pytest.approx(area, rel=1e-9)


@pytest.mark.parametrize(
    ("outline", "openings", "words"),
    [
        ("box 100 100 120 120", "none", "meets no panel of the sheet"),
        ("box -6000 -6000 6000 6000", "none", "it looks like millimetres"),
        ("box 1 1 1.02 1.02", "none", "less of the sheet than can be analysed"),
        ("box -6 -6 6 6", "box -5.999 -1 5.999 1", "outline: "),
        ("none", "box 30 30 31 31", "opening 1 meets no panel"),
    ],
)
def test_an_outline_that_cannot_be_is_one_sentence(outline, openings, words):
    with pytest.raises(InputError) as caught:
        cut_folded_sheet(*whole("exact"), read_outline(outline, openings))
    assert words in str(caught.value) and "\n" not in str(caught.value)


def test_an_outline_larger_than_the_sheet_says_how_much_is_covered():
    found = cut_folded_sheet(*whole("exact"), read_outline("box -10 -10 10 10", "none"))
    assert found.covered < 0.6
    assert any("the sheet covers" in note for note in found.shell.notes)
