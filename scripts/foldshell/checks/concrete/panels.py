"""Steel, struts and their places in every panel, under all strength combinations."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.cracking import least_steel_area
from foldshell.checks.concrete.demand import find_demand, principal_tension
from foldshell.checks.concrete.detailing import bar_spacing
from foldshell.checks.concrete.envelope import (
    Envelope,
    find_envelope,
    split_combinations,
    take_means,
)
from foldshell.checks.concrete.layout import DIAMETERS, Layout
from foldshell.checks.concrete.model import ConcreteModel
from foldshell.checks.concrete.sampling import find_basis, sample, turn_resultants
from foldshell.shell.stress import StressResultants

BLOCK = 10_000
"""States of stress that are designed at a time."""


@dataclass(frozen=True)
class PanelSteel:
    """What P panels need, and get.

    Attributes
    ----------
    thickness : (P,) m
    two_layers, cracked : (P,) bool; where not two, one mesh stands in the place of the bottom
    needed : (P, 2, 2) m2/m, layers bottom and top, bars along x and y
    area : (P, 2, 2) m2/m with least steel
    strut_use, ratio_use, fit_use : (P,) shares of what is allowed
    envelope : of 4 components of steel in kN/m and of the strut's share
    """

    thickness: np.ndarray
    two_layers: np.ndarray
    cracked: np.ndarray
    needed: np.ndarray
    area: np.ndarray
    strut_use: np.ndarray
    ratio_use: np.ndarray
    fit_use: np.ndarray
    envelope: Envelope


def find_panel_steel(
    model: ConcreteModel, resultants: StressResultants, thickness: np.ndarray
) -> PanelSteel:
    """Largest of facet means and strip means of what the points need, over all combinations.

    Parameters
    ----------
    resultants : of c strength combinations, (E, 3, m, c) kN/m and kNm/m
    thickness : (P,) m of the sized panels
    """
    layout, asked = model.layout, model.asked
    own = np.append(thickness, 0.0)[np.minimum(model.mesh.panel, model.panels)]
    own = np.where(own > 0, own, 1.0)  # panels of an edge beam are left out at the end
    means, tension = [], np.zeros(len(own))
    for part in split_combinations(model.local, resultants, 5):
        found, torn = _design_points(model, part, own)
        means.append(take_means(model.local, found))
        tension = np.maximum(tension, torn)
    means = np.concatenate(means, axis=1)
    envelope = find_envelope(model.local.panel, means, model.panels)
    needed = envelope.value[:, :4].reshape(-1, 2, 2) / layout.strengths.fyd
    peak = np.zeros(model.mesh.panel.max() + 1)
    np.maximum.at(peak, model.mesh.panel, tension)
    cracked = peak[: model.panels] > layout.strengths.fctd
    two = layout.has_two_layers(thickness)
    area = add_least_steel(needed, thickness, cracked, two, layout)
    return PanelSteel(
        thickness=thickness,
        two_layers=two,
        cracked=cracked,
        needed=needed,
        area=area,
        strut_use=envelope.value[:, 4],
        ratio_use=area.sum(axis=1).max(axis=1) / (asked.ratio_max * thickness),
        fit_use=find_fit(area, thickness, two, layout),
        envelope=envelope,
    )


def _design_points(
    model: ConcreteModel, resultants: StressResultants, thickness: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return steel and share of the strut (E, q, c, 5) at the points, and the largest principal
    tension (E,) kPa; in blocks of elements that a processor's cache holds."""
    layout, ratio = model.layout, model.asked.central_lever_ratio
    points, columns = len(model.local.points), resultants.force.shape[-1]
    found = np.empty((len(thickness), points, columns, 5))
    tension = np.empty(len(thickness))
    size = max(1, BLOCK // (points * columns))
    basis = find_basis(model.operators, model.local)
    turned = turn_resultants(model.local, resultants)
    for start in range(0, len(thickness), size):
        part = slice(start, start + size)
        force, moment = (sample(basis, one[part]) for one in turned)
        demand = find_demand(force, moment, thickness[part], layout, ratio)
        found[part, ..., :4] = demand.steel.reshape(*demand.steel.shape[:3], 4)
        found[part, ..., 4] = demand.strut_use
        tension[part] = principal_tension(force, moment, thickness[part]).max(axis=(1, 2))
    return found, tension


def add_least_steel(
    needed: np.ndarray,
    thickness: np.ndarray,
    cracked: np.ndarray,
    two_layers: np.ndarray,
    layout: Layout,
) -> np.ndarray:
    """a_s = max(needed, a_s,min): (P, 2, 2) m2/m; least steel only in panels that crack.

    Half the least steel of a membrane lies in each of two layers, with f_ct,eff = f_ctm and
    sigma_s = f_yk (7.3.2 (2)); grids get their design strength.

    needed (P, 2, 2) m2/m, thickness (P,) m, cracked and two_layers (P,) bool.
    """
    strengths = layout.strengths
    stress = strengths.fyd if layout.kind == "textile" else strengths.fyk
    least = np.where(cracked, least_steel_area(thickness, strengths.fctm, stress), 0.0)
    share = np.where(two_layers[:, None], 0.5, [1.0, 0.0])
    return np.maximum(needed, (least[:, None] * share)[:, :, None])


def find_fit(
    area: np.ndarray, thickness: np.ndarray, two_layers: np.ndarray, layout: Layout
) -> np.ndarray:
    """Share (P,) of room that bars take: 1 where the best of the diameters just fits.

    Of a diameter, the larger of least clear distance over what is left between bars and of the
    depth that covers and crossing bars take over the thickness. Grids are bought as they are
    needed: of them only the depth counts.

    area (P, 2, 2) m2/m, thickness (P,) m, two_layers (P,) bool.
    """
    layers = np.where(two_layers, 2, 1)
    if layout.kind == "textile":
        return (2 * layout.cover + 2 * layers * layout.diameter) / thickness
    most = area.max(axis=(1, 2))
    best = np.full(len(thickness), np.inf)
    for diameter in np.unique(np.append(DIAMETERS, layout.diameter)):
        if diameter < layout.diameter - 1e-9:
            continue
        cover = max(layout.cover_needed, diameter)
        depth = (2 * cover + 2 * layers * diameter) / thickness
        room = (diameter + layout.clear) / bar_spacing(most, diameter)
        best = np.minimum(best, np.maximum(depth, room))
    return best
