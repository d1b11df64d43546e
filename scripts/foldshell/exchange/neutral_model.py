"""The neutral model: everything another FE program needs, in words and plain numbers."""

from collections.abc import Mapping, Sequence

import numpy as np

from foldshell.files.whole import Json
from foldshell.loads.cases import SETTLEMENT, TEMPERATURE, SurfaceLoad, make_load_cases
from foldshell.loads.words import unit_of
from foldshell.settings.loads import Loads
from foldshell.settings.material import Material
from foldshell.settings.stage import StageSettings
from foldshell.settings.support_row import AXES
from foldshell.shell.boundary import Hold
from foldshell.shell.held_supports import list_holds

OWN_LOADS = "foldshell-neutral-model 4"
"""Format 3 with `load_cases` in place of the paper's five."""

FORMAT = "foldshell-neutral-model 3"
"""Format 2 (`self_weight_only_panels`) with named supports, lists of combinations that are
compared, and limits: who does not know those must not read such a file."""


def make_neutral_model(
    design: str,
    mesh: Mapping[str, np.ndarray],
    panel_thickness: np.ndarray,
    settings: StageSettings,
    compared: Mapping[str, Sequence[str]],
    limits: Mapping[str, float],
) -> Json:
    """Return the neutral model as plain data in kN, m and kPa.

    Facets are flat triangles, counter-clockwise seen from above; every mesh node on a supported
    edge is pinned (translations only) where its support says nothing else. The superimposed dead
    load acts against the normal of the sheet, also where a facet overhangs (`dead_side`). No finite
    element mesh is given: the reader makes its own. The panels of an edge beam have fixed thickness
    and come last; they are listed as `self_weight_only_panels`, on which no other load acts.

    Parameters
    ----------
    mesh : arrays of mesh.npz
    panel_thickness : (P,) m, of the sized panels
    settings : those of the stage `crosscheck`
    compared : names of combinations under "strength" and "deflection"
    limits : what the criteria allow of quantities of primary.json
    """
    fixed = mesh.get("fixed_thickness", np.empty(0))
    sized = len(panel_thickness)
    edge_beam_panels = list(range(sized, sized + len(fixed)))
    return {
        "format": OWN_LOADS if has_own_loads(settings) else FORMAT,
        "design": design,
        "vertices_m": mesh["vertices"].tolist(),
        "facets": mesh["facets"].tolist(),
        "facet_panel": mesh["facet_panel"].tolist(),
        "panel_thickness_m": [*panel_thickness.tolist(), *fixed.tolist()],
        **({"self_weight_only_panels": edge_beam_panels} if edge_beam_panels else {}),
        "supports": [_describe_support(name, hold) for name, hold in list_holds(mesh).items()],
        "material": _describe_material(settings.material),
        **_describe_all_loads(settings),
        "compare": {kind: list(names) for kind, names in compared.items()},
        "limits": dict(limits),
    }


def has_own_loads(settings: StageSettings) -> bool:
    """Whether loads are not the paper's five cases as they stand in format 3."""
    return bool(settings.loads.rows) or settings.loads.sdl_direction == "vertical"


def _describe_all_loads(settings: StageSettings) -> Json:
    """Return loads and combinations; what strains and settles is left out with its combinations."""
    if not has_own_loads(settings):
        return {
            "loads_kn_m2": _describe_loads(settings.loads),
            "area_basis": settings.loads.area_basis,
            "combinations": settings.combinations.all,
        }
    cases = make_load_cases(settings.loads, settings.material.unit_weight)
    left = {one.case for one in cases if one.kind in (TEMPERATURE, SETTLEMENT)}
    return {
        "load_cases": [describe_own_load(one) for one in cases if one.case not in left],
        "combinations": {
            name: factors
            for name, factors in settings.combinations.all.items()
            if not left & factors.keys()
        },
    }


def describe_own_load(load: SurfaceLoad) -> Json:
    """Return a load as plain data in kN and m."""
    zone, found = load.zone, {}
    if zone.kind == "region":
        found = {"polygon_m": [list(corner) for corner in zone.region.corners]}
    elif zone.kind == "side":
        found = {"side": zone.side}
    elif zone.kind == "panels":
        numbers = [range(first, last + 1) for first, last in zone.panels]
        found = {"panels": sorted({number for part in numbers for number in part})}
    elif zone.points:
        found = {"points_m": [list(point) for point in zone.points]}
    plain: Json = {
        "case": load.case,
        "kind": load.kind,
        "value": load.value,
        "unit": unit_of(load),
        "direction": "against_normal" if load.direction is None else list(load.direction),
        "area": load.area,
        "zone": found,
    }
    if load.variation is not None:
        plain["variation"] = {
            "axis": "xyz"[load.variation.axis],
            "places_m": list(load.variation.places),
            "factors": list(load.variation.factors),
        }
    return plain


def _describe_support(name: str, hold: Hold) -> Json:
    """Return a support by what it holds; one that pins edges says no more than these."""
    found: Json = {"name": name}
    if len(hold.pairs):
        found["edges"] = hold.pairs.tolist()
    if len(hold.vertices):
        found["vertices"] = hold.vertices.tolist()
    if not hold.fix.all():
        found["fix"] = [axis for axis, fixed in zip(AXES, hold.fix, strict=True) if fixed]
    if hold.clamp:
        found["clamp"] = True
    if hold.spring.any():
        found["spring_kn_m2" if len(hold.pairs) else "spring_kn_m"] = hold.spring.tolist()
    return found


def _describe_material(material: Material) -> Json:
    return {
        "youngs_modulus_kpa": material.youngs_modulus,
        "poissons_ratio": material.poissons_ratio,
        "unit_weight_kn_m3": material.unit_weight,
        "strength_kpa": material.strength,
        "strength_tension_kpa": material.strength_tension,
        "criterion": material.criterion,
    }


def _describe_loads(loads: Loads) -> Json:
    return {
        "SDL": loads.superimposed_dead,
        "LL": loads.live,
        "W": loads.wind,
        "wind_fraction": loads.wind_fraction,
        "dead_side": "sheet",
    }
