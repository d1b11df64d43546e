"""Small models for the tests of the cross-check, and the six folded cases with known limits."""

import copy
import json
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix

DATA = Path(__file__).parent / "data"

# sheet, support, thickness m, largest downward displacement mm, strain energy kNm: the limits of
# two other element families refined to 16 x 16 sub-triangles per facet.
SIX_CASES = (
    ("paraboloid", "strip", 0.05, 370.0, 198.0),
    ("arch", "strip", 0.05, 301.5, 147.5),
    ("hypar", "zigzag", 0.05, 362.0, 151.5),
    ("arch", "zigzag", 0.08, 228.2, 105.5),
    ("paraboloid", "zigzag", 0.12, 108.0, 134.1),
    ("hypar", "all", 0.12, 8.85, 11.2),
)

COMBINATIONS = {
    "S2": {"SW": 1.2, "SDL": 1.2, "LL": 1.6, "WX": 0.5},
    "D2": {"SW": 1.0, "SDL": 1.0, "LL": 1.0, "WX": 1.0},
}


def describe_model(vertices, facets, supported_edges, thickness, facet_panel=None) -> dict:
    """A neutral model as plain data, with the paper's material and loads."""
    facets = np.asarray(facets)
    panel = np.arange(len(facets)) // 2 if facet_panel is None else np.asarray(facet_panel)
    return {
        "format": "foldshell-neutral-model 1",
        "design": "test",
        "vertices_m": np.asarray(vertices, float).tolist(),
        "facets": facets.tolist(),
        "facet_panel": panel.tolist(),
        "panel_thickness_m": np.broadcast_to(thickness, panel.max() + 1).tolist(),
        "supported_edges": np.asarray(supported_edges).tolist(),
        "material": {
            "youngs_modulus_kpa": 31e6,
            "poissons_ratio": 0.2,
            "unit_weight_kn_m3": 25.0,
            "strength_kpa": 16700.0,
            "strength_tension_kpa": 1670.0,
            "criterion": "von_mises",
        },
        "loads_kn_m2": {"SDL": 0.5, "LL": 1.0, "W": 1.7, "wind_fraction": 0.5},
        "area_basis": "sheet",
        "combinations": copy.deepcopy(COMBINATIONS),
        "compare": {"strength": "S2", "deflection": "D2"},
    }


def describe_folded_case(surface: str, support: str, thickness: float) -> dict:
    """One of the folded 28/10 sheets of 15 x 16 polylines."""
    data = np.load(DATA / f"{surface}_28_10_15x16_paper.npz")
    edges = np.vstack([data["edges_zigzag"], data["edges_strip"]])
    held = np.zeros(len(edges), bool)
    for name in ("zigzag", "strip"):
        if support in (name, "all"):
            line = data[name][edges]
            held |= (line == 0).all(axis=1) | (line == data[name].max()).all(axis=1)
    return describe_model(data["vertices"], data["triangles"], edges[held], thickness)


def describe_small_fold(thickness: float = 0.06) -> dict:
    """A corrugated roof of 3 x 2 skewed panels, 6 m x 3 m, pinned along both ends of the folds."""
    x = np.array([0.0, 1.0, 2.1, 3.0])
    y = np.array([0.0, 1.6, 3.0])
    ridge = np.array([0.0, 0.8, 0.05, 0.85])
    vertices = np.array(
        [[x[i] + 0.2 * y[j], y[j], ridge[i] + 0.05 * j] for j in range(3) for i in range(4)]
    )
    facets = []
    for j in range(2):
        for i in range(3):
            a, b = 4 * j + i, 4 * j + i + 1
            facets += [[a, b, a + 4], [b, b + 4, a + 4]]
    ends = [[i, i + 1] for i in range(3)] + [[8 + i, 9 + i] for i in range(3)]
    return describe_model(vertices, facets, ends, thickness)


def write_model(path: Path, model: dict) -> Path:
    """Write a model as the chain does."""
    path.write_text(json.dumps(model), encoding="utf-8")
    return path


def describe_primary(runs: list[dict], subdivisions: list[int], order: float = 3.0) -> dict:
    """Values of runs on several meshes as the primary code writes them.

    Second-order values stand within their combination, reactions by support.
    """
    values = {c: {k: [run[c][k] for run in runs] for k in runs[0][c]} for c in runs[0]}
    for entry in values.values():
        meshes = entry.get("support_reactions_kn")
        if meshes:
            entry["support_reactions_kn"] = {k: [mesh[k] for mesh in meshes] for k in meshes[0]}
    for name in [name for name in values if name.endswith(" Th.II")]:
        values[name.removesuffix(" Th.II")]["second_order"] = values.pop(name)
    return {"subdivisions": subdivisions, "order": order, "combinations": values}


def describe_strip(
    length: float, width: float, thickness: float, parts: int, poisson: float = 0.0
) -> dict:
    """A flat strip along x of `parts` panels, pinned at both ends: a beam where poisson is 0."""
    x = np.linspace(0.0, length, parts + 1)
    vertices = np.array([[place, y, 0.0] for y in (0.0, width) for place in x])
    over = parts + 1
    facets = [
        facet
        for k in range(parts)
        for facet in ([k, k + 1, over + k + 1], [k, over + k + 1, over + k])
    ]
    data = describe_model(vertices, facets, [[0, over], [parts, over + parts]], thickness)
    data["material"] |= {"poissons_ratio": poisson}
    return data


def assemble_skeleton(matrices, equations, size):
    """The same sum as the fronts', as one sparse matrix; -1 stands for no equation."""
    place = equations.reshape(len(equations), -1)
    rows = np.broadcast_to(place[:, :, None], matrices.shape)
    columns = np.broadcast_to(place[:, None, :], matrices.shape)
    keep = (rows >= 0) & (columns >= 0)
    return coo_matrix((matrices[keep], (rows[keep], columns[keep])), shape=(size, size)).tocsc()
