"""Panels to cut: flat shapes that fold back, drawings, sheets that they are nested on."""

import csv
import io
import math

import ezdxf
import ezdxf.bbox
import numpy as np
import pytest

from export_cases import CASES, make_export_model
from foldshell.exchange.flat_panels import flatten_panels
from foldshell.exchange.nesting import nest_panels
from foldshell.exchange.options import ExportOptions
from foldshell.exchange.panel_files import write_nesting, write_panels
from foldshell.exchange.row_packing import exact_slide

ALL = pytest.mark.parametrize("case", CASES)


@ALL
def test_flat_panels_put_back_give_the_folded_sheet(tmp_path, case):
    """Panel by panel across its edges by twice the mitre angle, bent at bend lines: to 1e-6 m."""
    assert largest_gap(make_export_model(tmp_path, **CASES[case])) < 1e-6


def largest_gap(model):
    """Return how far flat panels put back by their angles lie from the folded sheet, m."""
    flats = {flat.panel.number: flat for flat in flatten_panels(model)}
    first = flats[0]
    solids = {0: fold_panel(first)}
    turn, shift = fit(solids[0], model.vertices[first.panel.corners])
    placed = {0: solids[0] @ turn + shift}
    todo = [0]
    while todo:
        number = todo.pop()
        flat = flats[number]
        for k, edge in enumerate(flat.edges):
            if edge.neighbour is None or edge.neighbour.number in placed:
                continue
            other = flats[edge.neighbour.number]
            placed[other.panel.number] = attach(placed[number], flat, k, other, 2 * edge.mitre)
            todo.append(other.panel.number)
    assert len(placed) == len(flats)
    return max(
        float(np.linalg.norm(points - model.vertices[flats[k].panel.corners], axis=1).max())
        for k, points in placed.items()
    )


def fold_panel(flat):
    """Return a panel's corners (k, 3) bent at its bend line, the first corners' side kept flat."""
    points = np.column_stack([flat.corners, np.zeros(len(flat.corners))])
    for line, bend in zip(flat.inner, flat.bends, strict=True):
        start, along = line[0], line[1] - line[0]
        along = along / np.linalg.norm(along)
        side = along[0] * (flat.corners - start)[:, 1] - along[1] * (flat.corners - start)[:, 0]
        beyond = side < -1e-9  # right of the line, its left facet stays
        away = -side[beyond]
        ahead = (flat.corners[beyond] - start) @ along
        out = np.array([along[1], -along[0]])
        moved = start + np.outer(ahead, along) + np.outer(away * math.cos(bend), out)
        points[beyond] = np.column_stack([moved, away * math.sin(bend)])
    return points


def fit(points, onto):
    """Return the rotation (3, 3) and shift that lay points (k, 3) on others best."""
    middle, there = points.mean(axis=0), onto.mean(axis=0)
    left, _, right = np.linalg.svd((points - middle).T @ (onto - there))
    turn = (left * [1, 1, np.sign(np.linalg.det(left @ right))]) @ right
    return turn, there - middle @ turn


def attach(points, flat, k, other, angle):
    """Place a neighbour beside side k of a placed panel, folded by `angle` there."""
    a, b = points[k], points[(k + 1) % len(points)]
    length = flat.edges[k].length
    m = next(i for i, e in enumerate(other.edges)
             if e.neighbour is flat.panel and math.isclose(e.length, length))  # fmt: skip
    own = fold_panel(other)
    c, d = own[m], own[(m + 1) % len(own)]  # runs from b to a
    here, there = side_normal(points, flat, k), side_normal(own, other, m)
    along = (b - a) / np.linalg.norm(b - a)
    out = np.cross(along, here)
    across = math.cos(angle) * out + math.sin(angle) * here
    up = math.cos(angle) * here - math.sin(angle) * out
    local = (d - c) / np.linalg.norm(d - c)
    source = np.stack([local, np.cross(there, local), there])
    target = np.stack([-along, across, up])
    turn = source.T @ target
    return (own - c) @ turn + b


def side_normal(points, flat, k):
    """Return the unit normal of the part of a bent panel that has side k."""
    count = len(points)
    a, b = points[k], points[(k + 1) % count]
    choices = [points[(k + 2) % count], points[k - 1]]
    if len(flat.inner):
        corners = flat.corners
        ends = {int(np.abs(corners - end).sum(axis=1).argmin()) for end in flat.inner[0]}
        third = next(c for c in ends if c not in (k, (k + 1) % count))
        choices = [points[third]]
    vector = np.cross(b - a, choices[0] - a)
    return vector / np.linalg.norm(vector)


@ALL
def test_panels_dxf_is_sound(tmp_path, case):
    """Audit without error, true extents, one outline a panel, bend lines, no line twice."""
    model = make_export_model(tmp_path, **CASES[case])
    paths = [tmp_path / f"panels.{kind}" for kind in ("dxf", "csv", "xlsx")]
    write_panels(model, tuple(paths), ExportOptions())
    document = ezdxf.readfile(paths[0])
    assert not document.audit().errors
    space = document.modelspace()
    outlines = space.query('LWPOLYLINE[layer=="BORDER"]')
    assert len(outlines) == len(model.panels)
    bends = space.query('LINE[layer=="BEND"]')
    assert len(bends) == sum(len(p.inner) for p in model.panels if not p.planar)
    box = ezdxf.bbox.extents(outlines)
    assert box.extmin.isclose(document.header["$EXTMIN"], abs_tol=1e-6)
    assert box.extmax.isclose(document.header["$EXTMAX"], abs_tol=1e-6)
    segments = set()
    for outline in outlines:
        points = [tuple(np.round(p[:2], 6)) for p in outline]
        for a, b in zip(points, [*points[1:], points[0]], strict=True):
            assert frozenset((a, b)) not in segments
            segments.add(frozenset((a, b)))
    area = sum(abs(_shoelace([p[:2] for p in outline])) for outline in outlines) / 1e6
    assert area == pytest.approx(model.areas.sum(), rel=1e-9)


def _shoelace(points):
    x, y = np.array(points).T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


@pytest.mark.parametrize(("length", "width"), [(2.0, 1.0), (4.0, 3.0)])
def test_nested_panels_are_all_there_and_apart(tmp_path, length, width):
    """Rows of large panels and, on a large sheet, the library's nest: checked with shapely here."""
    shapely = pytest.importorskip("shapely")
    pytest.importorskip("spyrrow")
    model = make_export_model(tmp_path, **CASES["planar"])
    panels = flatten_panels(model)
    nesting = nest_panels(panels, length, width, 1)
    numbers = [n for sheet in nesting.sheets for n in sheet.numbers]
    assert sorted(numbers) == [panel.number for panel in model.panels] and not nesting.oversize
    flats = {flat.panel.number: flat for flat in panels}
    for sheet in nesting.sheets:
        shapes = [shapely.Polygon(outline) for outline in sheet.outlines]
        union = shapely.union_all(shapes)
        assert union.area == pytest.approx(sum(shape.area for shape in shapes), rel=1e-9)
        assert shapely.box(-1e-6, -1e-6, length + 1e-6, width + 1e-6).covers(union)
        for number, outline in zip(sheet.numbers, sheet.outlines, strict=True):
            flat = flats[number].corners
            assert _shoelace(outline) == pytest.approx(flats[number].area)  # not turned over
            sides = [np.linalg.norm(np.roll(p, -1, axis=0) - p, axis=1) for p in (outline, flat)]
            assert sides[0] == pytest.approx(sides[1], abs=1e-9)


def test_panel_larger_than_a_sheet_is_named(tmp_path):
    pytest.importorskip("shapely")
    model = make_export_model(tmp_path)
    paths = (tmp_path / "sheets.dxf", tmp_path / "sheets.csv")
    write_nesting(model, paths, ExportOptions(sheet_length=2.0, sheet_width=0.3))
    assert "P0,larger than a sheet" in paths[1].read_text()
    text = " ".join(e.dxf.text for e in ezdxf.readfile(paths[0]).layout("Layout1").query("TEXT"))
    assert "larger than a sheet" in text


def test_exact_slide_of_two_triangles():
    """A triangle's right side leans as the other's left: they touch along it."""
    one, two = np.array([[0, 0], [1, 0], [0, 1.0]]), np.array([[1, 1], [0, 1], [1, 0.0]])
    assert exact_slide(one, two) == pytest.approx(0.0, abs=1e-12)
    assert exact_slide(one, two + np.array([0, 0.5])) == pytest.approx(-0.5)


def test_panels_csv_is_what_the_design_is(tmp_path):
    """Sums close: area, volume, weight; each fold stands on both sides of its edge."""
    model = make_export_model(tmp_path, **CASES["bent, graded, beam"])
    paths = [tmp_path / f"panels.{kind}" for kind in ("dxf", "csv", "xlsx")]
    write_panels(model, tuple(paths), ExportOptions())
    rows = list(csv.DictReader(io.StringIO(paths[1].read_text())))
    assert len(rows) == len(model.panels)
    assert sum(float(r["volume_m3"]) for r in rows) == pytest.approx(model.volume, rel=1e-12)
    assert sum(float(r["area_m2"]) for r in rows) == pytest.approx(model.areas.sum(), rel=1e-12)
    seen = {}
    for row in rows:
        for k in range(1, int(row["corners"]) + 1):
            if row[f"e{k}_neighbour"]:
                pair = frozenset((row["panel"], row[f"e{k}_neighbour"]))
                seen.setdefault(pair, []).append(
                    [float(row[f"e{k}_{name}"]) for name in ("length_m", "fold_deg", "mitre_deg")]
                )
                assert math.isclose(seen[pair][-1][1], 2 * seen[pair][-1][2])
    assert all(len(ends) == 2 and np.allclose(*ends, atol=1e-9) for ends in seen.values())
