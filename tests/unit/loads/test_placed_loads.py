"""Loads on a folded sheet: sums, moments and nodal forces against sums made otherwise.

The sums by hand close to rounding, 1e-9 of the largest is asked for: parts of elements are cut out
exactly, and the polynomial that stands for them has their integrals.
"""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import shapely

from foldshell.folding.files import folded_arrays
from foldshell.folding.targets import make_target
from foldshell.library import fold_sheet, make_sheet
from foldshell.loads.cases import FORCE, LINE, WEIGHT, SurfaceLoad
from foldshell.shell.nodal_loads import mean_loads, nodal_forces, sum_loads
from foldshell.shell.placed_loads import place_loads
from own_load_cases import (
    facet_values,
    folded_sheet,
    height_of,
    make_load,
    mesh_sheet,
    sum_by_hand,
    turn,
)

POLYGON = "polygon -5 -6, 6 -3, 8 9, 0 1, -7 6"
CORNERS = [(-5, -6), (6, -3), (8, 9), (0, 1), (-7, 6)]


@cache
def fold_arch():
    """The sheet of the study, whose areas were measured."""
    target = make_target("arch", 28.0, 10.0)
    sheet = make_sheet(target, 15, 16)
    folded = fold_sheet(sheet, target)
    arrays = folded_arrays(folded.sheet, folded.result)
    return arrays.vertices, arrays.facets


def place(operators, *loads, own=None):
    count = len(operators.mesh.elements)
    own = np.zeros(count, dtype=bool) if own is None else own
    return place_loads(operators, own, loads)


def sums(operators, *loads):
    placed = place(operators, *loads)
    return sum_loads(operators, placed.at(np.full(len(operators.mesh.elements), 0.1)))


def close(found, exact):
    return found == pytest.approx(exact, rel=1e-9, abs=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("subdivisions", [1, 4, 8])
def test_areas_of_the_arch(subdivisions):
    """28/10 arch of 15 x 16 lines, in m2: 754.9 by |n_z|, 737.3 by n_z, 746.1 by max(n_z, 0),
    740.3 of footprint, which is the area of the union of all facets in plan."""
    vertices, facets = fold_arch()
    operators = mesh_sheet(vertices, facets, subdivisions)
    _, normal, area = facet_values(vertices, facets)
    plan = [shapely.Polygon(one[:, :2]) for one in vertices[facets]]
    exact = {
        "sheet": area.sum(),
        "plan_abs": area @ np.abs(normal[:, 2]),
        "plan_net": area @ normal[:, 2],
        "plan_up": area @ np.maximum(normal[:, 2], 0),
        "footprint": shapely.union_all(plan).area,
    }
    for name, size in exact.items():
        assert close(sums(operators, make_load(area=name))[0][:, 0], np.array([0, 0, -size]))
    rounded = {name: round(size, 1) for name, size in exact.items()}
    assert rounded == {"sheet": rounded["sheet"], "plan_abs": 754.9, "plan_net": 737.3,
                       "plan_up": 746.1, "footprint": 740.3}  # fmt: skip


@pytest.mark.parametrize("angle", [0.0, 0.4, 1.1])
def test_the_footprint_turns_with_the_sheet(angle):
    """Also of a sheet that is turned about z, and of one that is tilted: the union in plan."""
    for tilt in (0.0, 0.3):
        vertices, facets = folded_sheet()
        vertices = turn(vertices, angle, tilt)
        plan = [shapely.Polygon(one[:, :2]) for one in vertices[facets]]
        found = sums(mesh_sheet(vertices, facets), make_load(area="footprint"))[0][2, 0]
        assert found == pytest.approx(-shapely.union_all(plan).area, rel=1e-9)


@pytest.mark.parametrize("order", [1, 2, 5])
@pytest.mark.parametrize("angle", [0.0, 0.7])
@pytest.mark.parametrize("zone", ["box -3.3 -20 5.1 20", POLYGON, "side x-", "side y+"])
def test_resultants_and_moments_of_zones(zone, angle, order):
    """On facets cut by the zone's border, skewed and turned, for elements of several orders."""
    vertices, facets = folded_sheet()
    vertices = turn(vertices, angle) + np.array([0, 0, 2.0])
    operators = mesh_sheet(vertices, facets, order=order)
    middle = (vertices.max(axis=0) + vertices.min(axis=0)) / 2
    region = {
        "box": shapely.box(-3.3, -20, 5.1, 20),
        "polygon": shapely.Polygon(CORNERS),
        "side x-": shapely.box(-99, -99, middle[0], 99),
        "side y+": shapely.box(-99, middle[1], 99, 99),
    }[zone if zone.startswith("side") else zone.split()[0]]
    _, normal, _ = facet_values(vertices, facets)
    for direction, along in [((0.6, 0, -0.8), None), (None, -normal)]:
        along = np.tile([0.6, 0, -0.8], (len(facets), 1)) if along is None else along
        force, moment = sums(operators, make_load(zone, direction=direction))
        exact = sum_by_hand(vertices, facets, region, along)
        assert close(force[:, 0], exact[0]) and close(moment[:, 0], exact[1])


def test_plan_areas_within_a_zone():
    vertices, facets = folded_sheet("hypar")
    _, normal, _ = facet_values(vertices, facets)
    region, down = shapely.Polygon(CORNERS), np.tile([0.0, 0, -1], (len(facets), 1))
    for area, share in [("plan_net", normal[:, 2]), ("plan_up", np.maximum(normal[:, 2], 0))]:
        force, moment = sums(mesh_sheet(vertices, facets), make_load(POLYGON, area=area))
        exact = sum_by_hand(vertices, facets, region, down, share)
        assert close(force[:, 0], exact[0]) and close(moment[:, 0], exact[1])


def test_whole_facets_stay_uniform():
    """Panels by number carry one value an element: resultant and moment of their triangles."""
    vertices, facets = folded_sheet()
    operators = mesh_sheet(vertices, facets, 2)
    placed = place(operators, make_load("panels 3-9, 30", direction=None))
    assert placed.fixed.shape[1] == 1
    chosen = np.isin(np.arange(len(facets)) // 2, [*range(3, 10), 30])
    corners, normal, area = facet_values(vertices, facets)
    each = -(area * chosen)[:, None] * normal
    force, moment = sum_loads(operators, placed.at(np.full(len(operators.mesh.elements), 1.0)))
    assert close(force[:, 0], each.sum(axis=0))
    assert close(moment[:, 0], np.cross(corners.mean(axis=1), each).sum(axis=0))


def test_nodal_forces_of_a_cut_element_are_its_integrals():
    """int N q over the part of one triangle beyond a line, by a fine sum over small triangles; for
    a border along its edge nothing is cut."""
    vertices = np.array([[0, 0, 0], [2.0, 0.3, 0.5], [0.4, 1.5, 0.2]])
    operators = mesh_sheet(vertices, np.array([[0, 1, 2]]), 1, 3)
    found = nodal_forces(operators, place(operators, make_load("box 0.5 -9 9 9")).fixed)
    from foldshell.shell.reference import lagrange_basis

    n = 600
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    up = np.stack([i + 1 / 3, j + 1 / 3], axis=-1)[i + j < n]
    low = np.stack([i + 2 / 3, j + 2 / 3], axis=-1)[i + j < n - 1]
    points = np.concatenate([up, low]) / n
    inside = points[:, 0] * 2.0 + points[:, 1] * 0.4 > 0.5
    shape = lagrange_basis(3, points[inside])[0].sum(axis=0) / n**2
    area = operators.geometry.area[0]
    nodes = operators.mesh.elements[0]
    z = found[2 : 3 * len(operators.mesh.nodes) : 3, 0][nodes]
    assert z == pytest.approx(-shape * area, abs=2e-3 * area)  # what the jump costs the sum
    whole = place(operators, make_load("box 0 -9 9 9"))
    assert whole.fixed.shape[1] == 1


def test_a_piecewise_linear_pressure():
    """Two triangles of snow, 0 at the eaves and the crown, in plan: by hand, and by parts."""
    vertices, facets = folded_sheet("paraboloid")
    operators = mesh_sheet(vertices, facets)
    places = [-14, -7, 0, 7, 14]
    factors = [0, 0.5, 0, 1, 0]
    pairs = ", ".join(f"{p}:{f}" for p, f in zip(places, factors, strict=True))
    force, moment = sums(operators, make_load(variation=f"x {pairs}", area="plan_up"))
    corners, normal, _ = facet_values(vertices, facets)
    exact, arm = 0.0, 0.0
    for corner, n in zip(corners, normal, strict=True):
        if n[2] <= 0:
            continue
        plan = shapely.Polygon(corner[:, :2])
        for k in range(4):
            strip = plan.intersection(shapely.box(places[k], -99, places[k + 1], 99))
            if strip.area == 0:
                continue
            x, y = strip.centroid.x, strip.centroid.y
            size = strip.area * np.interp(x, places, factors)  # linear: by its centroid
            exact -= size
            arm -= size * y  # y is not the load's centre, so a bound below
    assert force[2, 0] == pytest.approx(exact, rel=1e-9)
    assert moment[0, 0] == pytest.approx(arm, abs=0.01 * abs(exact))


def test_a_pressure_that_grows_with_height():
    """q = z on a facet acts with its area times the height of its centroid."""
    vertices, facets = folded_sheet()
    vertices = turn(vertices, 0.3, 0.2)
    low, high = vertices[:, 2].min(), vertices[:, 2].max()
    load = make_load(variation=f"z {low}:{low}, {high}:{high}", direction=(1.0, 0, 0))
    corners, _, area = facet_values(vertices, facets)
    exact = area @ corners[..., 2].mean(axis=1)
    assert sums(mesh_sheet(vertices, facets), load)[0][0, 0] == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("subdivisions", [1, 3])
def test_a_line_load_is_as_long_as_the_line_on_the_sheet(subdivisions):
    """kN/m along the sheet, on every facet that the line crosses in plan."""
    vertices, facets = folded_sheet()
    operators = mesh_sheet(vertices, facets, subdivisions)
    load = make_load("line -20 0.3, 3 1.7, 3 99", kind=LINE, value=2.0)
    corners, normal, _ = facet_values(vertices, facets)
    exact, arm = 0.0, np.zeros(3)
    for line in map(shapely.LineString, pairwise([(-20, 0.3), (3, 1.7), (3, 99)])):
        for corner, n in zip(corners, normal, strict=True):
            common = shapely.Polygon(corner[:, :2]).intersection(line)
            if common.length > 0:
                ends = np.array([[x, y, height_of(corner, n, x, y)] for x, y in common.coords])
                size = 2.0 * np.linalg.norm(ends[1] - ends[0])
                exact += size
                arm += np.cross(ends.mean(axis=0), [0, 0, -size])
    force, moment = sums(operators, load)
    assert close(force[:, 0], np.array([0, 0, -exact])) and close(moment[:, 0], arm)


def test_a_line_along_a_fold_acts_once():
    """On one of the two facets, whichever way it runs."""
    vertices = np.array(
        [[0, 0, 0], [2, 0, 0], [2, 1, 0.5], [0, 1, 0.5], [0, -1, 0.5], [2, -1, 0.5]]
    )
    facets = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 1], [4, 1, 0]])
    operators = mesh_sheet(vertices.astype(float), facets, 2)
    for zone in ("line 0 0, 2 0", "line 2 0, 0 0", "line -1 0, 1 0, 9 0"):
        force, _ = sums(operators, make_load(zone, kind=LINE))
        assert force[2, 0] == pytest.approx(-2, rel=1e-12)


def test_a_point_load_acts_on_the_topmost_facet():
    """Force and moment of a point on the sheet, where facets overhang too."""
    vertices, facets = folded_sheet()
    operators = mesh_sheet(vertices, facets, 2)
    corners, normal, _ = facet_values(vertices, facets)
    for x, y in [(1.1, 2.2), (-9.7, 4.05), (11.93, -3.3)]:
        load = make_load(f"point {x} {y}", kind=FORCE, value=7.0)
        heights = [height_of(c, n, x, y) for c, n in zip(corners, normal, strict=True)
                   if shapely.Polygon(c[:, :2]).covers(shapely.Point(x, y))]  # fmt: skip
        force, moment = sums(operators, load)
        assert close(force[:, 0], np.array([0, 0, -7.0]))
        assert close(moment[:, 0], np.cross([x, y, max(heights)], [0, 0, -7.0]))


def test_a_force_on_a_zone_is_spread_over_it():
    vertices, facets = folded_sheet()
    operators = mesh_sheet(vertices, facets)
    load = make_load(POLYGON, kind=FORCE, value=12.0, area="plan_up", direction=(0, 1.0, 0))
    assert close(sums(operators, load)[0][:, 0], np.array([0, 12.0, 0]))


def test_weight_acts_on_all_and_the_rest_on_loaded_elements():
    """As of the panels of an edge beam, which carry nothing but their own weight."""
    vertices, facets = folded_sheet()
    operators = mesh_sheet(vertices, facets)
    own = np.arange(len(facets)) >= 400
    weight = make_load(case="W", kind=WEIGHT, value=25.0)
    cases = [weight, *(make_load(zone, case=name) for name, zone in (("A", "all"), ("B", POLYGON)))]
    placed = place(operators, *cases, own=own)
    thickness = np.linspace(0.05, 0.2, len(facets))
    mean = mean_loads(operators, placed.at(thickness))
    assert mean[:, 2, 0] == pytest.approx(-25 * thickness, rel=1e-12)
    assert not mean[own][..., 1:].any() and mean[~own, 2, 1] == pytest.approx(-1)
    part = place(operators, make_load("panels 0-9", kind=WEIGHT, value=25.0))
    assert np.flatnonzero(part.weight[:, 2, 0]).tolist() == list(range(20))


def test_rows_of_a_case_add_up_and_cases_stay_apart():
    vertices, facets = folded_sheet()
    operators = mesh_sheet(vertices, facets)
    loads = [make_load("side x-", value=2.0), make_load("side x+", value=0.5), make_load(case="B")]
    placed = place(operators, *loads)
    assert placed.names == ("A", "B")
    found, _ = sum_loads(operators, placed.fixed)
    parts = [sums(operators, load)[0][2, 0] for load in loads]
    assert found[2] == pytest.approx([parts[0] + parts[1], parts[2]], rel=1e-12)


@pytest.mark.parametrize(
    "load",
    [
        make_load("box 20 20 30 30"),
        make_load("line 20 20, 30 30", kind=LINE),
        make_load("point 20 20", kind=FORCE),
        make_load("polygon 50 0, 60 0, 55 3", kind=FORCE),
        make_load("panels 500-600"),
    ],
)
def test_a_zone_that_meets_no_panel_is_refused(load):
    vertices, facets = folded_sheet()
    with pytest.raises(ValueError, match=f"load case A: zone '{load.where}' meets no panel"):
        place(mesh_sheet(vertices, facets), load)


def test_a_sheet_without_facets_that_face_up_carries_no_snow():
    vertices = np.array([[0, 0, 0], [0, 1.0, 0], [1, 0, 0.3]])
    operators = mesh_sheet(vertices, np.array([[0, 1, 2]]))
    with pytest.raises(ValueError, match="the whole sheet meets no panel with an area plan_up"):
        place(operators, make_load(area="plan_up"))


def test_the_five_cases_are_what_they_were():
    """Bit by bit: the uniform load of each case on each element."""
    from foldshell.loads.cases import make_load_cases, surface_loads
    from foldshell.settings.loads import Loads

    vertices, facets = folded_sheet()
    operators = mesh_sheet(vertices, facets, 2)
    thickness = np.random.default_rng(1).uniform(0.03, 0.2, len(operators.mesh.elements))
    own = np.arange(len(thickness)) % 17 == 3
    for basis in ("sheet", "plan_abs"):
        cases = make_load_cases(Loads(area_basis=basis), 25.0)
        found = place_loads(operators, own, cases).at(thickness)
        assert found.shape[1] == 1
        plain = surface_loads(operators.geometry.frame[:, 2], thickness, cases, own)
        assert np.array_equal(found[:, 0], plain)


def test_evaluate_knows_all_areas():
    normal = np.array([[0.6, 0, 0.8], [0.6, 0, -0.8]])
    for area, share in [("plan_net", [0.8, -0.8]), ("plan_up", [0.8, 0]), ("plan_abs", [0.8, 0.8])]:
        load = SurfaceLoad("A", "pressure", 2.0, (0.0, 0.0, -1.0), area)
        assert load.evaluate(normal, np.ones(2))[:, 2] == pytest.approx(-2 * np.array(share))
