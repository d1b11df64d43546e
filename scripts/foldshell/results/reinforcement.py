"""Reinforced concrete of a final state: checks, columns of panels, totals, bars."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from foldshell.checks.concrete.detailing import crack_limit
from foldshell.checks.concrete.envelope import Envelope
from foldshell.checks.concrete.layout import describe_fit, refuse_layout
from foldshell.checks.concrete.model import ConcreteModel, build_concrete_model
from foldshell.checks.concrete.panel_cracks import find_crack_widths
from foldshell.checks.concrete.quantities import Quantities, sum_cost, sum_emissions, sum_steel
from foldshell.checks.concrete.schedule import make_schedule
from foldshell.checks.concrete.use import PanelUse, find_panel_use
from foldshell.checks.verdict import Found, hold_against
from foldshell.records.reinforcement import BarsRecord, ReinforcementRecord
from foldshell.results.engineering_state import EngineeringState
from foldshell.results.reinforcement_places import CHECKS, Places, find_places
from foldshell.settings.reinforcement import USES
from foldshell.settings.stage import StageSettings
from foldshell.shell.stress import StressResultants, stress_resultants
from foldshell.sizing.classes import group_thicknesses

WORDS = {
    "strut": "struts, EN 1992-1-1 Annex F, share of nu f_cd",
    "ratio": "steel of one direction over the largest ratio, 9.2.1.1 (3)",
    "shear": "shear over v_Rd,c, 6.2.2 (open: does not settle with the mesh beside folds)",
    "fit": "room for bars and covers, 4.4.1, 8.2",
    "crack": "crack width over its limit, 7.3.4",
    "punching": "punching at fold vertices, 6.4 (open: hangs on the mesh)",
}


@dataclass(frozen=True)
class Reinforced:
    """What is said of the reinforcement of a state; `refused` a sentence where nothing could be
    designed, `fit` what is said where bars do not fit; `columns` of sized panels by name."""

    refused: str
    fit: str
    record: ReinforcementRecord | None
    checks: Mapping[str, Any]
    columns: Mapping[str, np.ndarray]


def reinforce_state(
    state: EngineeringState, given: StageSettings, errors: Mapping[str, float] | None = None
) -> Reinforced | None:
    """Design the reinforcement of a final state; None where the material or the settings ask for
    none.

    Stages `size` and `checks` have the settings; `errors` are relative ones of the mesh, by the
    names of `ReinforcementStudy.quantities`.
    """
    asked = given.reinforcement
    if state.case.material.kind != "concrete" or asked.kind == "none" or state.resultants is None:
        return None
    panels = state.case.model.sized_panels
    first = np.unique(state.case.model.mesh.panel, return_index=True)[1][:panels]
    thickness = state.thickness[first]
    refused = refuse_layout(asked, thickness)
    if refused:
        return Reinforced(refused, "", None, {}, {})
    width = given.checks.strip_width
    model = build_concrete_model(state.case.model.operators, panels, asked, width)
    strength = state.resultants.columns(slice(state.strength_count))
    use = find_panel_use(model, strength, thickness, USES)
    cracks = find_crack_widths(
        model, _find_sustained(state, given.checks.creep_coefficient), use.steel
    )
    shares = _gather_shares(use, cracks, crack_limit(asked.exposure))
    names = list(state.combinations.strength)
    sustained = list(state.combinations.quasi_permanent)
    record = _describe(state, model, use, shares, given)
    places = find_places(model, use, cracks, names, sustained)
    columns = _list_columns(model, use, cracks, shares, places)
    fit = describe_fit(model.layout, thickness)
    return Reinforced("", fit, record, _hold(shares, places, find_mesh_errors(errors)), columns)


def _find_sustained(state: EngineeringState, creep: float) -> StressResultants:
    """Resultants of the quasi-permanent combinations; of the characteristic ones where the aged
    shell has no answer."""
    aged = state.long_term
    if aged is None or aged.state in ("unstable", "mechanism"):
        return state.resultants.columns(slice(state.strength_count, len(state.short.names)))
    material = state.case.material
    modulus = material.youngs_modulus / (1 + creep)
    return stress_resultants(
        state.case.model.operators, aged.displacement, state.thickness, modulus, aged.imposed
    )


def _gather_shares(use: PanelUse, cracks: Envelope, limit: float) -> np.ndarray:
    """Return the shares (P, 6) in the order of `CHECKS`."""
    widest = cracks.value.max(axis=1) / limit
    return np.column_stack([use.shares, widest, use.shear.punching_use])


def find_mesh_errors(errors: Mapping[str, float] | None) -> dict[str, float | None]:
    """Return the relative error of each check: of shear the larger of its size and its share,
    None for cracks, which are not studied, and for what is at its cap on both meshes."""
    known = errors or {}
    found = {name: known.get(f"use_{name}") or None for name in CHECKS}
    sizes = [known[name] for name in ("use_shear", "shear_max_kn_m") if name in known]
    return found | {"shear": max(sizes, default=None)}


def _hold(shares: np.ndarray, places: Places, errors: Mapping[str, float | None]):
    """Return each check by its name, where its largest share of all panels stands."""
    found = {}
    for k, name in enumerate(CHECKS):
        panel = int(shares[:, k].argmax())
        at = Found(float(shares[panel, k]), str(places.combination[panel, k]), panel)
        check = hold_against(WORDS[name], at, 1.0, mesh_error=errors[name])
        found[f"reinforced_{name}"] = replace(check, place=str(places.words[panel, k]))
    return found


def _describe(
    state: EngineeringState, model: ConcreteModel, use: PanelUse, shares, given: StageSettings
) -> ReinforcementRecord:
    steel, area, layout = use.steel, model.area, model.layout
    classes = group_thicknesses(steel.thickness, area, given.sizing.classes)
    bars = make_schedule(steel.area, steel.two_layers, classes.thickness, area, layout)
    concrete = float(area @ steel.thickness)
    mass = sum_steel(steel.area, area, layout.density)
    total = Quantities(concrete, mass, measure_creases(model), float(area.sum()),
                       layout.kind == "textile")  # fmt: skip
    emitted, cost = sum_emissions(total, given.co2), sum_cost(total, given.prices)
    governing = np.bincount(shares.argmax(axis=1), minlength=len(CHECKS)) / len(shares)
    over = (shares > 1).mean(axis=0)
    return ReinforcementRecord(
        kind=layout.kind,
        steel_kg_m2=mass / total.area,
        steel_kg_m3=mass / concrete,
        steel_needed_kg_m2=sum_steel(steel.needed, area, layout.density) / total.area,
        steel_kg=mass,
        steel_bars_kg=sum(row.mass for row in bars),
        concrete_m3=concrete,
        creases_m=total.creases,
        two_layers_share=float(steel.two_layers.mean()),
        governing_share=dict(zip(CHECKS, governing.tolist(), strict=True)),
        over_one_share=dict(zip(CHECKS, over.tolist(), strict=True)),
        co2_kg=emitted[0], co2_low_kg=emitted[1], co2_high_kg=emitted[2],
        cost=cost and cost[0], cost_low=cost and cost[1], cost_high=cost and cost[2],
        bars=tuple(
            BarsRecord(
                thickness_m=row.thickness, panels=row.panels, layer=row.layer,
                direction=row.direction, diameter_mm=1e3 * row.diameter,
                spacing_mm=None if row.spacing is None else round(1e3 * row.spacing, 6),
                area_cm2_m=1e4 * row.area, mass_kg=row.mass, use=row.use,
            )
            for row in bars
        ),
    )  # fmt: skip


def measure_creases(model: ConcreteModel) -> float:
    """Return the length of all folds between panels, in m; borders are none."""
    mesh, rows = model.mesh, model.shear_edge[:, 0] >= 0
    edges = model.shear_edge[rows]
    pairs, count = np.unique(edges, axis=0, return_counts=True)
    folds = pairs[count > 1]
    return float(np.linalg.norm(mesh.nodes[folds[:, 0]] - mesh.nodes[folds[:, 1]], axis=1).sum())


def find_bar_directions(model: ConcreteModel) -> tuple[np.ndarray, np.ndarray]:
    """Return unit vectors along the bars of x and of y in the first facet of each panel, (P, 3)."""
    first = np.unique(model.mesh.panel, return_index=True)[1][: model.panels]
    angle, frame = model.local.angle[first, None], model.operators.geometry.frame[first]
    cos, sin = np.cos(angle), np.sin(angle)
    return cos * frame[:, 0] + sin * frame[:, 1], cos * frame[:, 1] - sin * frame[:, 0]


def _list_columns(
    model: ConcreteModel, use: PanelUse, cracks: Envelope, shares: np.ndarray, places: Places
) -> dict[str, np.ndarray]:
    """Return the columns of panels: areas of steel, shares, places and combinations."""
    steel, shear = use.steel, use.shear
    area = steel.area.reshape(-1, 4)
    keys = [f"{layer}{axis}" for layer in ("RB", "RT") for axis in "XY"]
    found = {f"as_{key}_cm2_m": 1e4 * area[:, k] for k, key in enumerate(keys)}
    most = model.asked.ratio_max * steel.thickness
    found |= {key: area[:, k] / most for k, key in enumerate(keys)}
    found["SC"] = shear.use
    found |= {"CWB": 1e3 * cracks.value[:, 0], "CWT": 1e3 * cracks.value[:, 1]}
    found["shear_kn_m"] = shear.size
    found["layers"] = np.where(steel.two_layers, 2, 1)
    found |= {f"use_{name}": shares[:, k] for k, name in enumerate(CHECKS)}
    which, own = shares.argmax(axis=1), np.arange(len(shares))
    found["reinforced_check"] = np.array(CHECKS)[which]
    found["reinforced_place"] = places.words[own, which]
    found["reinforced_combination"] = places.combination[own, which]
    found["steel_place"] = places.words[:, CHECKS.index("ratio")]
    found["steel_combination"] = places.combination[:, CHECKS.index("ratio")]
    for axis, vectors in zip("xy", find_bar_directions(model), strict=True):
        found |= {f"bar_{axis}_{name}": vectors[:, k] for k, name in enumerate("xyz")}
    return found
