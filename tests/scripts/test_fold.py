"""Entry script of rule fold."""

import json
from itertools import pairwise

import meshio
import numpy as np
import pytest

import fold
import pattern
from entry_defaults import fold_parameters, pattern_parameters
from foldshell.files.errors import InputError
from foldshell.files.whole import read_arrays
from foldshell.folding.targets import make_target


def _run(folder, kind="miura", **values):
    pattern.main(
        folder / "a.fold", design="x", **pattern_parameters(pattern=kind, zigzag=7, strip=8)
    )
    fold.main(
        folder / "a.fold", folder / "f.npz", folder / "f.vtu", folder / "q.json",
        design="x", **fold_parameters(**values),
    )  # fmt: skip
    return read_arrays(folder / "f.npz"), json.loads((folder / "q.json").read_text())


@pytest.mark.parametrize("kind", ["miura", "smooth", "flat"])
def test_files_keep_the_contract(tmp_path, kind):
    data, quality = _run(tmp_path, kind)
    assert data["vertices"].shape == (56, 3) and data["facets"].shape == (84, 3)
    corners = data["vertices"][data["facets"]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # Above means along the target's normal: facets of a bent sheet may overhang.
    plan = data["vertices"][data["facets"]].mean(axis=1)
    above = make_target("paraboloid", 28, 10).find_normals(plan[:, 0], plan[:, 1])
    if kind == "flat":
        above = np.array([0, 0, 1.0])
    assert ((normals * above).sum(axis=1) > 0).all()
    for p in (0, 20, 41):  # rows 2p and 2p + 1 are panel p, which is i (strip_count - 1) + j
        assert set(data["facets"][2 * p : 2 * p + 2].ravel()) == set(data["quads"][p])
        first = data["quads"][p, 0]
        assert p == data["zigzag"][first] * 7 + data["strip"][first]
    keys = """
        state reason rms_over_span max_over_span edge_strain_max edge_strain_rms iterations
        angle_defect_max_rad planarity_max planarity_mean neutral_fold_mean_deg flipped_folds
        self_intersections plan_coverage
    """
    keys = keys.split()
    assert set(keys) <= set(quality)
    assert quality["state"] == "ok"
    if kind == "smooth":
        assert quality["max_over_span"] < 1e-12
    if kind == "flat":
        assert np.ptp(data["vertices"][:, 2]) == 0


def test_vtu_holds_the_fields(tmp_path):
    data, quality = _run(tmp_path)
    mesh = meshio.read(tmp_path / "f.vtu")
    assert len(mesh.cells_dict["triangle"]) == 84
    assert {"panel", "planarity", "strain"} <= set(mesh.cell_data)
    assert {"distance", "zigzag", "strip"} <= set(mesh.point_data)
    distance = mesh.point_data["distance"]
    known = distance[mesh.point_data["attracted"] == 1]
    assert np.isfinite(distance).all() and len(known) == 32
    rms = np.sqrt(np.mean(known**2)) / 28
    assert rms == pytest.approx(quality["rms_over_span"], rel=1e-12)
    assert np.array_equal(mesh.points, data["vertices"])


def test_border_polylines_can_be_supported(tmp_path):
    """Zig-zag and strip borders are chains of facet edges, in order of the other index."""
    data, _ = _run(tmp_path)
    sides = {
        tuple(sorted(e))
        for f in data["facets"].tolist()
        for e in zip(f, f[1:] + f[:1], strict=True)
    }
    for index, last in ((data["zigzag"], 6), (data["strip"], 7)):
        for border in (0, last):
            chain = np.flatnonzero(index == border)
            assert all(tuple(e) in sides for e in pairwise(chain))


def test_an_unknown_mode_is_refused(tmp_path):
    with pytest.raises(InputError, match="fold_mode"):
        _run(tmp_path, fold_mode="soft")
    assert not (tmp_path / "f.npz").exists()
