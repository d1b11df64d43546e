"""The neutral model: everything another FE program needs, in words and plain numbers."""

from collections.abc import Mapping

import numpy as np

from foldshell.files.whole import Json
from foldshell.settings.stage import StageSettings

FORMAT = "foldshell-neutral-model 1"

EDGE_BEAM_FORMAT = "foldshell-neutral-model 2"
"""Format 1, and `self_weight_only_panels`: who does not know those must not read such a file."""


def make_neutral_model(
    design: str,
    mesh: Mapping[str, np.ndarray],
    panel_thickness: np.ndarray,
    settings: StageSettings,
) -> Json:
    """Return the neutral model as plain data in kN, m and kPa.

    Facets are flat triangles, counter-clockwise seen from above; every mesh node on a supported
    edge is pinned (translations only). The superimposed dead load acts against the normal of the
    sheet, also where a facet overhangs (`dead_side`). No finite element mesh is given: the reader
    makes its own. The panels of an edge beam have fixed thickness and come last; they
    are listed as `self_weight_only_panels`, on which no other load acts.

    Parameters
    ----------
    mesh : arrays of mesh.npz
    panel_thickness : (P,) m, of the sized panels
    settings : those of the stage `crosscheck`
    """
    material, loads = settings.material, settings.loads
    compare = settings.crosscheck
    fixed = mesh.get("fixed_thickness", np.empty(0))
    sized = len(panel_thickness)
    edge_beam_panels = list(range(sized, sized + len(fixed)))
    return {
        "format": EDGE_BEAM_FORMAT if len(fixed) else FORMAT,
        "design": design,
        "vertices_m": mesh["vertices"].tolist(),
        "facets": mesh["facets"].tolist(),
        "facet_panel": mesh["facet_panel"].tolist(),
        "panel_thickness_m": [*panel_thickness.tolist(), *fixed.tolist()],
        **({"self_weight_only_panels": edge_beam_panels} if edge_beam_panels else {}),
        "supported_edges": mesh["support_pairs"].tolist(),
        "material": {
            "youngs_modulus_kpa": material.youngs_modulus,
            "poissons_ratio": material.poissons_ratio,
            "unit_weight_kn_m3": material.unit_weight,
            "strength_kpa": material.strength,
            "strength_tension_kpa": material.strength_tension,
            "criterion": material.criterion,
        },
        "loads_kn_m2": {
            "SDL": loads.superimposed_dead,
            "LL": loads.live,
            "W": loads.wind,
            "wind_fraction": loads.wind_fraction,
            "dead_side": "sheet",
        },
        "area_basis": loads.area_basis,
        "combinations": settings.combinations.all,
        "compare": {"strength": compare.strength, "deflection": compare.deflection},
    }
