"""Smooth shells in finer facets: places, numbers, panels, supports, and that they converge."""

import numpy as np
import pytest

from foldshell.folding.files import folded_arrays
from foldshell.folding.fold import fold_sheet
from foldshell.folding.quadric import make_quadric
from foldshell.loads.cases import make_load_cases
from foldshell.pattern.design import design_sheet
from foldshell.records.arrays import list_arrays
from foldshell.records.sheet_arrays import FoldedArrays
from foldshell.results.creases import find_creases
from foldshell.results.mesh_convergence import CURVED_REFERENCE, choose_reference
from foldshell.settings.fold import Fold
from foldshell.settings.loads import Combinations, Loads
from foldshell.settings.material import Material
from foldshell.shell.analysis import analyse_shell
from foldshell.shell.curved_panels import refine_panels
from foldshell.shell.held_supports import build_supported_model
from foldshell.shell.mesh_files import mesh_folded_sheet, mesh_from_arrays, result_mesh

TARGET = make_quadric("paraboloid", 10.0, 3.0)


@pytest.fixture(scope="module")
def smooth():
    """Return the arrays of folded.npz of a dome of 4 x 5 panels."""
    sheet = design_sheet("smooth", TARGET.section_lengths(), 5, 6, 60.0)
    return list_arrays(folded_arrays(sheet, fold_sheet(sheet, TARGET, "elastic", Fold())))


@pytest.mark.parametrize("parts", [1, 2, 3, 6])
def test_every_vertex_lies_on_the_surface_and_panels_keep_their_numbers(smooth, parts):
    found = refine_panels(smooth, parts)
    x, y, z = found["vertices"].T
    assert z == pytest.approx(TARGET.evaluate_height(x, y), abs=1e-12)
    count = len(smooth["vertices"])
    assert np.array_equal(found["vertices"][:count], smooth["vertices"])
    assert len(found["facets"]) == parts**2 * len(smooth["facets"])
    middle = found["vertices"][found["facets"]].mean(axis=1)
    own = np.stack([middle[found["facet_panel"] == panel].mean(axis=0) for panel in range(20)])
    due = smooth["vertices"][smooth["quads"]].mean(axis=1)
    assert np.linalg.norm((own - due)[:, :2], axis=1).max() < 0.02 * 2.0  # panels of 2 m


def test_one_part_is_the_sheet_itself(smooth):
    found = refine_panels(smooth, 1)
    assert np.array_equal(found["facets"], smooth["facets"])
    assert np.array_equal(found["zigzag"], smooth["zigzag"])


def test_facets_keep_their_upper_side_and_cover_the_plan_once(smooth):
    found = refine_panels(smooth, 3)
    corner = found["vertices"][found["facets"]]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    assert (normal[:, 2] > 0).all()
    ends = smooth["vertices"][:, :2]
    assert normal[:, 2].sum() / 2 == pytest.approx(np.prod(np.ptp(ends, axis=0)), rel=1e-12)


def test_supported_borders_are_whole(smooth):
    """Pins along strips: all nodes of both borders at the least and the largest x."""
    mesh = mesh_folded_sheet(smooth, "strip", 4)
    x = mesh["nodes"][:, 0]
    on = np.flatnonzero(np.isin(x.round(9), [x.min().round(9), x.max().round(9)]))
    assert np.array_equal(np.sort(mesh["supported_nodes"]), on)
    assert set(mesh["support_border"]) == {2, 3} and mesh["subdivisions"] == 2


def test_parts_that_the_points_do_not_have_are_refused(smooth):
    with pytest.raises(ValueError, match="4 parts: a divisor of 6"):
        refine_panels(smooth, 4)


def test_three_quads_a_side_are_near_six_where_one_is_not(smooth):
    """A dome of 10 m and 4 x 5 panels of 2 m, 60 mm, first order. An error c / r^2 leaves three
    (1/9 - 1/36) / (1 - 1/36) = 1/11.7 of the distance that one has from six; one is too coarse for
    that, three may then have less. Displacement within 6 % on these few panels."""
    material, plan = Material(), Combinations()
    cases = make_load_cases(Loads(), material.unit_weight)

    def settle(parts):
        arrays = mesh_folded_sheet(smooth, "all", 4, panel_parts=parts)
        model = build_supported_model(mesh_from_arrays(arrays), arrays, material.poissons_ratio)
        thickness = model.to_elements(np.full(20, 0.06))
        result = analyse_shell(model, thickness, material, cases, {"D1": plan.all["D1"]})
        return -result.first_order[2 : 3 * len(model.mesh.nodes) : 3].min()

    one, three, six = (settle(parts) for parts in (1, 3, 6))
    assert (one - six) / (three - six) > 10 and three / six - 1 < 0.06


def test_the_mesh_error_looks_at_six(smooth):
    assert choose_reference(smooth, 4) == CURVED_REFERENCE
    assert CURVED_REFERENCE.panel_parts == 6
    flat = {name: values for name, values in smooth.items() if name != "surface"}
    assert choose_reference(flat, 4).panel_parts is None


def test_borders_of_panels_are_drawn_on_the_surface(smooth):
    """4 x 5 panels, three sides of facets each: 3 (4 x 6 + 5 x 5) = 147 in all, 54 on the border;
    every point of them on the surface."""
    mesh = mesh_folded_sheet(smooth, "all", 4)
    cells = result_mesh(mesh_from_arrays(mesh), mesh["vertices"], mesh["facets"])
    found = find_creases(cells, FoldedArrays(**smooth), creased=False)
    assert len(found.border) == 54 and len(found.flat) == 147 - 54
    assert len(found.mountain) == len(found.valley) == 0
    lines = np.concatenate([found.flat, found.border])
    x, y, z = cells.nodes[lines[:, [0, -1]].ravel()].T
    assert z == pytest.approx(TARGET.evaluate_height(x, y), abs=1e-12)
