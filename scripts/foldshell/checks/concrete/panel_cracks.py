"""Crack widths of panels under quasi-permanent loads, EN 1992-1-1:2004 7.3.4."""

import numpy as np

from foldshell.checks.concrete.cracking import (
    effective_depth_in_tension,
    inclined_spacing,
    largest_spacing,
    mean_strain,
)
from foldshell.checks.concrete.demand import find_demand
from foldshell.checks.concrete.envelope import (
    Envelope,
    find_envelope,
    split_combinations,
    take_means,
)
from foldshell.checks.concrete.model import ConcreteModel
from foldshell.checks.concrete.panels import PanelSteel
from foldshell.checks.concrete.sampling import find_basis, sample, turn_resultants
from foldshell.shell.stress import StressResultants

LEVER = 0.8
"""Of the thickness: by it the mean moments of a strip become forces, for the angle of cracks."""


def find_crack_widths(
    model: ConcreteModel, resultants: StressResultants, steel: PanelSteel
) -> Envelope:
    """w_k (P, 2) m at bottom and top, the largest of facets, strips and combinations.

    The steel stress in a crack is what the same sandwich needs under these loads over what lies
    there; cracks run across the principal tension of a cover. Nothing in panels that do not crack.

    resultants (E, 3, m, c) kN/m and kNm/m of quasi-permanent combinations.
    """
    own = np.append(steel.thickness, 1.0)[np.minimum(model.mesh.panel, model.panels)]
    parts = split_combinations(model.local, resultants, 10)
    means = np.concatenate([_mean_forces(model, part, own) for part in parts], axis=1)
    rows = np.flatnonzero(model.local.panel < model.panels)
    panel, means = model.local.panel[rows], means[rows]
    pulled = means[..., :4].reshape(*means.shape[:2], 2, 2)
    angle = _crack_angles(means[..., 4:7], means[..., 7:10], steel.thickness[panel])
    width = _widen(model, steel, panel, pulled, angle)
    return find_envelope(panel, width, model.panels)


def _mean_forces(
    model: ConcreteModel, resultants: StressResultants, thickness: np.ndarray
) -> np.ndarray:
    """Return the means (S, c, 10) of four forces of bars, and of n and m, kN/m and kNm/m.

    thickness (E,) m.
    """
    basis = find_basis(model.operators, model.local)
    force, moment = (sample(basis, one) for one in turn_resultants(model.local, resultants))
    demand = find_demand(force, moment, thickness, model.layout, model.asked.central_lever_ratio)
    flat = demand.steel.reshape(*demand.steel.shape[:3], 4)
    apart = [np.moveaxis(one, 0, -1) for one in (force, moment)]
    return take_means(model.local, np.concatenate([flat, *apart], axis=-1))


def _crack_angles(force: np.ndarray, moment: np.ndarray, thickness: np.ndarray) -> np.ndarray:
    """Return the angle (S, c, 2) rad, 0 to pi/2, of the principal tension of each cover to x."""
    bent = moment / (LEVER * thickness[:, None, None])
    cover = np.stack([force / 2 + bent, force / 2 - bent], axis=2)
    twice = np.arctan2(2 * np.abs(cover[..., 2]), cover[..., 0] - cover[..., 1])
    return twice / 2


def _widen(model: ConcreteModel, steel: PanelSteel, panel, pulled, angle) -> np.ndarray:
    """Return w_k (S, c, 2) m from the forces of bars (S, c, 2, 2) kN/m."""
    layout, strengths = model.layout, model.layout.strengths
    t, two = steel.thickness, steel.two_layers
    distance = layout.cover + layout.diameter
    depth = np.where(two, effective_depth_in_tension(t, distance), t)
    cover = np.where(two, layout.cover, t / 2 - layout.diameter)
    area = steel.area[panel][:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = area / depth[panel][:, None, None, None]
        stress = np.where(pulled > 0, pulled / area, 0.0)
        strain = mean_strain(stress, ratio, strengths.fctm, strengths.es, strengths.ecm)
        spacing = largest_spacing(cover[panel][:, None, None, None], layout.diameter, ratio)
        width = inclined_spacing(spacing, angle) * np.where(pulled > 0, strain, 0.0).max(axis=-1)
    width = np.where(pulled.max(axis=-1) > 0, width, 0.0)
    return np.where(steel.cracked[panel][:, None, None], width, 0.0)
