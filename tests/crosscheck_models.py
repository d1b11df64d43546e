"""Small models for the tests of the cross-check, and the six folded cases with known limits."""

import copy
import json
from pathlib import Path

import numpy as np

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
