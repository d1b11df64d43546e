"""Steel, struts, moments and shear of a state on a mesh: for their mesh error, and the other code.

First order, so that both codes have the same forces to find; the strength combinations that they
compare; no least steel in the mass.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.envelope import take_means
from foldshell.checks.concrete.layout import lay_out, refuse_layout
from foldshell.checks.concrete.model import ConcreteModel, build_concrete_model
from foldshell.checks.concrete.quantities import sum_steel
from foldshell.checks.concrete.sampling import find_basis, sample, turn_resultants
from foldshell.checks.concrete.use import PanelUse, find_panel_use
from foldshell.records.analysis import AnalysisRecord
from foldshell.records.mesh_convergence import LaidRecord, ReinforcementStudy
from foldshell.results.governing import choose_combinations
from foldshell.settings.material import Material
from foldshell.settings.reinforcement import USES, Reinforcement
from foldshell.settings.stage import StageSettings
from foldshell.shell.analysis import AnalysisResult, ShellModel
from foldshell.shell.stress import StressResultants, stress_resultants


@dataclass(frozen=True)
class ConcreteAsked:
    """What is asked of a reinforced shell: its settings, the width (m) of strips, and the strength
    combinations that it is designed for."""

    asked: Reinforcement
    strip_width: float
    combinations: Sequence[str]


def ask_concrete(given: StageSettings, report: AnalysisRecord) -> ConcreteAsked:
    """Return what the settings ask for, under the strength combinations that are compared."""
    named = choose_combinations(given.crosscheck, given.combinations, report, given.loads)
    return ConcreteAsked(given.reinforcement, given.checks.strip_width, named["strength"])


def measure_reinforced(
    model: ShellModel,
    result: AnalysisResult,
    thickness: np.ndarray,
    material: Material,
    concrete: ConcreteAsked,
) -> dict[str, float]:
    """Return the quantities of `ReinforcementStudy` on one mesh; nothing where there is no design.

    thickness (P,) m of the sized panels; the state is that of first order.
    """
    if material.kind != "concrete" or concrete.asked.kind == "none":
        return {}
    if refuse_layout(concrete.asked, thickness):
        return {}
    columns = [result.names.index(name) for name in concrete.combinations]
    imposed = None if result.imposed is None else result.imposed[..., columns]
    found = stress_resultants(
        model.operators, result.first_order[:, columns], model.to_elements(thickness),
        material.youngs_modulus, imposed,
    )  # fmt: skip
    own = build_concrete_model(
        model.operators, model.sized_panels, concrete.asked, concrete.strip_width
    )
    use = find_panel_use(own, found, thickness, USES)
    return _list_quantities(own, use, found)


def _list_quantities(
    model: ConcreteModel, use: PanelUse, resultants: StressResultants
) -> dict[str, float]:
    steel, layout = use.steel, model.layout
    mass = sum_steel(steel.needed, model.area, layout.density) / model.area.sum()
    shares = dict(zip(use.names, use.shares.max(axis=0).tolist(), strict=True))
    shares["punching"] = float(use.shear.punching_use.max())
    return {
        "steel_kg_m2": float(mass),
        "steel_max_kn_m": float(steel.needed.max() * layout.strengths.fyd),
        "moment_max_knm_m": find_largest_moment(model, resultants),
        "shear_max_kn_m": float(use.shear.size.max()),
        "shear_over_share": float((use.shear.use > 1).mean()),
        **{f"use_{name}": share for name, share in shares.items()},
    }


def find_largest_moment(model: ConcreteModel, resultants: StressResultants) -> float:
    """Return the largest principal moment, either sign, of facet and strip means, kNm/m."""
    rows = np.flatnonzero(model.local.panel < model.panels)
    moment = sample(find_basis(model.operators, model.local),
                    turn_resultants(model.local, resultants)[1])  # fmt: skip
    x, y, xy = np.moveaxis(take_means(model.local, np.moveaxis(moment, 0, -1))[rows], -1, 0)
    return float((np.abs(x + y) / 2 + np.hypot((x - y) / 2, xy)).max())


def pair_reinforced(
    concrete: ConcreteAsked | None, coarse: Mapping[str, float], fine: Mapping[str, float]
) -> ReinforcementStudy | None:
    """Return the quantities on both meshes and what lies in the sheet, None for no design."""
    if concrete is None or not coarse or not fine:
        return None
    layout = lay_out(concrete.asked)
    laid = LaidRecord(
        level_m=layout.cover + layout.diameter,
        two_layers_from_m=layout.two_from if np.isfinite(layout.two_from) else None,
        central_lever_ratio=concrete.asked.central_lever_ratio,
        yield_kpa=layout.strengths.fyd,
        crush_kpa=layout.strengths.fcd,
        density_kg_m3=layout.density,
        strip_m=concrete.strip_width,
        shear_strip_m=concrete.asked.shear_strip_width,
        diagonals=concrete.asked.diagonals,
    )
    return ReinforcementStudy(
        combinations=tuple(concrete.combinations),
        laid=laid,
        quantities={name: (coarse[name], fine[name]) for name in coarse},
    )
