"""Any crease pattern through the folding engine: anonymous Miura, generators, honest failures."""

import json

import numpy as np
import pytest

from foldshell.files.errors import InputError
from foldshell.folding.exact_panels import solve_net
from foldshell.folding.fold_panels import fold_panels
from foldshell.folding.net import make_net
from foldshell.folding.panel_path import follow_net
from foldshell.folding.soft import fold_softly
from foldshell.folding.soft_panels import fold_net_softly, start_net
from foldshell.folding.targets import make_target
from foldshell.pattern.angles import measure_folds
from foldshell.pattern.design import design_sheet
from foldshell.pattern.fans import find_families, trace_polylines
from foldshell.pattern.generators import (
    make_accordion,
    make_fan,
    make_resch,
    make_waterbomb,
    make_yoshimura,
)
from foldshell.pattern.read_panels import read_panels
from foldshell.settings.fold import Fold

COUNTS = (9, 8)


def write_anonymous(path, sheet, turn=0.5, seed=1, **more):
    """Write a Miura sheet as a FOLD file of another program: vertices, panels and edges shuffled,
    turned and moved, with letters and rest angles alone. Returns the new number of each vertex."""
    rng = np.random.default_rng(seed)
    grid = sheet.grid
    order = rng.permutation(len(sheet.flat))
    new = np.argsort(order)
    cosine, sine = np.cos(turn), np.sin(turn)
    points = (sheet.flat[:, :2] @ [[cosine, sine], [-sine, cosine]] + [3, -7])[order]
    kept = rng.permutation(np.flatnonzero(grid.assignments != "F"))
    folds = np.degrees(measure_folds(sheet.rest, grid))[kept]
    panels = [np.roll(row, rng.integers(4)).tolist() for row in new[rng.permutation(grid.quads)]]
    path.write_text(json.dumps({
        "vertices_coords": points.tolist(), "edges_vertices": new[grid.edges[kept]].tolist(),
        "edges_assignment": grid.assignments[kept].tolist(), "edges_foldAngle": folds.tolist(),
        "faces_vertices": panels, **more,
    }))  # fmt: skip
    return new


@pytest.mark.parametrize("surface", ["hypar", "paraboloid"])
def test_an_anonymous_miura_folds_as_the_grid_does(tmp_path, surface):
    """1e-8 m, with both minimised to a fall of 1e-14: the soft valley of 15 x 16 is well found."""
    target = make_target(surface, 28.0, 10.0)
    sheet = design_sheet("miura", target.section_lengths(), 15, 16, 60.0)
    new = write_anonymous(tmp_path / "a.fold", sheet)
    settings = Fold().changed(tolerance=1e-14, max_iterations=300)
    net = make_net(read_panels(tmp_path / "a.fold"))
    start = start_net(net, target, "lowest")
    shape = fold_net_softly(net, start, target, settings)
    due = fold_softly(sheet, target, settings)
    assert np.abs(shape.vertices[new] - due.vertices).max() <= 1e-8


def test_an_anonymous_miura_has_the_lines_of_the_grid(tmp_path):
    sheet = design_sheet("miura", (30.0, 30.0), *COUNTS, 60.0)
    new = write_anonymous(tmp_path / "a.fold", sheet)
    net = make_net(read_panels(tmp_path / "a.fold"))
    number = new[np.arange(np.prod(COUNTS))].reshape(COUNTS)
    due = {tuple(line) for line in number.tolist()} | {tuple(line) for line in number.T.tolist()}
    found = {tuple(line) for line in trace_polylines(net.mesh.panels)}
    assert {min(k, k[::-1]) for k in found} == {min(k, k[::-1]) for k in due}
    families, _ = find_families(net.mesh.panels)
    assert sorted(np.bincount(families)) == sorted([9 * 7, 8 * 8])
    rows = {min(tuple(r), tuple(r[::-1])) for r in net.chains.tolist()}
    expected = [line[k : k + 7 : 2] for line in due for k in range(len(line) - 6)]
    assert rows == {min(tuple(r), tuple(r[::-1])) for r in expected}


def test_a_set_of_vertices_says_what_is_attracted(tmp_path):
    target = make_target("hypar", 28.0, 6.0)
    sheet = design_sheet("miura", target.section_lengths(), *COUNTS, 60.0)
    new = write_anonymous(tmp_path / "a.fold", sheet)
    data = json.loads((tmp_path / "a.fold").read_text())
    chosen = sorted(new[sheet.grid.zigzag_index % 2 == 1].tolist())
    data["foldshell:sets"] = {"attract": chosen}
    (tmp_path / "a.fold").write_text(json.dumps(data))
    result = fold_panels(read_panels(tmp_path / "a.fold"), target, "elastic", Fold())
    assert result.attracted.tolist() == chosen and result.state == "ok"


EXACT = [
    ("yoshimura", "arch", make_yoshimura, (8, 6)),
    ("waterbomb", "arch", make_waterbomb, (6, 6)),
    ("waterbomb", "paraboloid", make_waterbomb, (6, 6)),
    ("resch", "paraboloid", make_resch, (12, 12)),
    ("resch", "hypar", make_resch, (12, 12)),
    ("resch", "arch", make_resch, (12, 12)),
    ("fan", "paraboloid", make_fan, (8, 13)),
]


@pytest.mark.parametrize(("name", "surface", "make", "counts"), EXACT)
def test_generators_become_true_origami(name, surface, make, counts):
    """Residual, gap of the unfolded sheet, strain of its edges: round-off of double precision."""
    target = make_target(surface, 28.0, 5.0 if name == "fan" else 8.0)
    mesh = make(target.section_lengths(), *counts)
    result = fold_panels(mesh, target, "exact", Fold())
    assert result.state == "ok", result.reason
    assert result.residuals["constraint_residual"] <= 1e-12
    assert result.residuals["unfold_closure_m"] <= 1e-9
    quality = result.quality
    assert quality.flipped_folds == quality.self_intersections == 0
    assert quality.edge_strain_max <= 1e-11


def test_the_path_of_a_waterbomb_keeps_its_lengths():
    target = make_target("arch", 28.0, 8.0)
    mesh = make_waterbomb(target.section_lengths(), 4, 4)
    result = fold_panels(mesh, target, "exact", Fold())
    true = result.mesh
    path = follow_net(make_net(true), true.flat, true.folded, np.linspace(0, 1, 6), rigid=False)
    assert path.strain <= 1e-12
    assert np.abs(path.states[-1] - true.folded).max() <= 1e-9
    assert np.ptp(path.states[0][:, 2]) <= 1e-9


def test_a_miura_is_rigid_and_a_waterbomb_says_that_it_is_not(tmp_path):
    target = make_target("hypar", 28.0, 6.0)
    write_anonymous(
        tmp_path / "a.fold", design_sheet("miura", target.section_lengths(), *COUNTS, 60.0)
    )
    result = fold_panels(read_panels(tmp_path / "a.fold"), target, "rigid", Fold())
    assert result.state == "ok" and result.residuals["refold_closure_m"] <= 1e-10
    mesh = make_waterbomb(make_target("arch", 28.0, 8.0).section_lengths(), 4, 4)
    result = fold_panels(mesh, make_target("arch", 28.0, 8.0), "rigid", Fold())
    assert result.state != "ok" and "degree 4" in result.reason


@pytest.mark.parametrize(
    ("make", "surface"), [(make_accordion, "paraboloid"), (make_yoshimura, "arch_strip")]
)
def test_what_cannot_be_reached_is_no_ok(make, surface):
    """An accordion keeps straight lines, a Yoshimura sheet curves along its rows alone."""
    target = make_target(surface, 28.0, 8.0)
    result = fold_panels(make(target.section_lengths(), 8, 7), target, "exact", Fold())
    assert result.state in ("not_reached", "crumpled") and result.reason


def test_an_isometric_miura_keeps_its_lengths(tmp_path):
    target = make_target("hypar", 28.0, 6.0)
    write_anonymous(
        tmp_path / "a.fold", design_sheet("miura", target.section_lengths(), *COUNTS, 60.0)
    )
    result = fold_panels(read_panels(tmp_path / "a.fold"), target, "isometric", Fold())
    assert result.quality.edge_strain_max <= 1e-12
    assert result.quality.rms_over_span <= 1.6e-3


def test_a_pattern_of_another_size_is_refused_with_its_unit():
    target = make_target("arch", 28.0, 8.0)
    mesh = make_waterbomb((28e3, 28e3), 4, 4)
    with pytest.raises(ValueError, match="it looks like millimetres"):
        fold_panels(mesh, target, "elastic", Fold())


def test_solving_needs_no_target_for_planar_panels():
    """n-gon panels: a resch sheet of triangles has none, an accordion of quadrilaterals has."""
    target = make_target("arch", 28.0, 8.0)
    net = make_net(make_accordion(target.section_lengths(), 4, 7))
    start = start_net(net, target, "lowest")
    soft = fold_net_softly(net, start, target, Fold())
    found = solve_net(net, start, soft.vertices, target, Fold().exact, rigid=False)
    assert not found.faults and found.unfolded.closure <= 1e-9


def test_a_fold_file_without_a_flat_sheet_is_unfolded(tmp_path):
    from foldshell.pattern.make_panels import read_pattern

    path = tmp_path / "a.fold"
    path.write_text(json.dumps({
        "vertices_coords": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.5]],
        "faces_vertices": [[0, 1, 2], [1, 3, 2]],
    }))  # fmt: skip
    mesh = read_pattern(path, "m")  # two triangles are always flat once they are laid down
    assert np.ptp(mesh.flat[:, 2]) == 0 and "unfolded" in mesh.notes[-1]
    path.write_text(json.dumps({
        "vertices_coords": [[0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]],
        "faces_vertices": [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]],
    }))  # fmt: skip
    with pytest.raises(InputError, match="no flat sheet, and its panels part by"):
        read_pattern(path, "m")
