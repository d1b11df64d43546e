"""The export model: panels, creases and loads of a design, against its geometry."""

import numpy as np
import pytest

from export_cases import BEAM, CASES, DESIGN, PANELS, make_export_model, stage_settings
from export_cases import write_export_case as write_case
from foldshell.exchange.model import combined_loads, load_on_facets
from foldshell.exchange.read_model import read_export_model
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays, write_arrays


def test_panels_of_a_miura_sheet(tmp_path):
    """Planar quadrilaterals with the corners of the grid; area and volume add up."""
    model = make_export_model(tmp_path)
    quads = read_arrays(tmp_path / "folded.npz")["quads"]
    assert [set(panel.corners) for panel in model.panels] == [set(quad) for quad in quads]
    assert all(panel.planar for panel in model.panels)
    assert model.panel_areas == pytest.approx(np.full(PANELS, 0.9 * 0.7 * np.sin(np.radians(63))))
    assert model.volume == pytest.approx(0.05 * model.panel_areas.sum())
    for panel in model.panels:  # counter-clockwise about the facets' normal
        a, b, c = model.vertices[panel.corners[:3]]
        assert np.cross(b - a, c - b) @ model.normals[panel.facets[0]] > 0


def test_creases_fold_as_the_pattern_says(tmp_path):
    """Assignments of the folded sheet are those of the grid it was made from."""
    from foldshell.pattern.grid import build_grid

    model = make_export_model(tmp_path)
    grid = build_grid(5, 6)
    known = {
        tuple(sorted(edge)): kind
        for edge, kind in zip(grid.edges.tolist(), grid.assignments.tolist(), strict=True)
        if kind != "F"
    }
    assert {tuple(sorted(c.ends)): c.assignment for c in model.creases} == known
    assert all(len(c.panels) == (1 if c.assignment == "B" else 2) for c in model.creases)


def test_bent_panels_have_an_inner_edge(tmp_path):
    model = make_export_model(tmp_path, bent=0.02)
    assert not any(panel.planar for panel in model.panels)
    for panel in model.panels:
        (ends,), (bend,) = panel.inner, panel.bends
        one, two = model.normals[panel.facets]
        assert abs(bend) == pytest.approx(np.arccos(one @ two), abs=1e-9)
        assert set(ends) < set(panel.corners)


def test_edge_beam_carries_only_itself(tmp_path):
    model = make_export_model(tmp_path, beam=True)
    beams = [panel for panel in model.panels if not panel.sized]
    assert len(beams) == len(model.panels) - PANELS == 10 and beams[0].name == f"B{PANELS}"
    assert {panel.thickness for panel in beams} == {BEAM.thickness}
    for case in model.load_cases:
        load = load_on_facets(model, case)
        assert (load[model.self_weight_only] != 0).any() == (case.case == "SW")


def test_combined_load_is_the_sum_of_its_cases(tmp_path):
    """S2 = 1.2 (SW + SDL) + 1.6 LL + 0.5 WX, facet by facet, from Table 2 of the paper."""
    model = make_export_model(tmp_path, thickness=np.linspace(0.03, 0.12, PANELS))
    normal, thick = model.normals, model.thickness
    exact = -1.2 * 0.5 * normal
    exact[:, 2] -= 1.2 * 25 * thick + 1.6 * 1.0
    exact[:, 0] += 0.5 * 0.85
    assert np.abs(combined_loads(model, "S2") - exact).max() < 1e-12


@pytest.mark.parametrize("case", CASES)
def test_every_case_closes_with_the_arrays(tmp_path, case):
    model = make_export_model(tmp_path, **CASES[case])
    mesh = read_arrays(tmp_path / "mesh.npz")
    assert np.array_equal(model.facets, mesh["facets"])
    own = np.concatenate([panel.facets for panel in model.panels])
    assert sorted(own) == list(range(len(model.facets)))


def test_design_without_results_is_refused(tmp_path):
    paths = write_case(tmp_path)
    write_arrays(paths["final"], {"thickness": np.full(PANELS, 0.05)})
    with pytest.raises(InputError, match=r"small: exports: converged .*only a design with results"):
        read_export_model(paths, DESIGN, stage_settings())
