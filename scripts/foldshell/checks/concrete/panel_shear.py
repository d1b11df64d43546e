"""Shear of panels, of their vertices, and what links pull; EN 1992-1-1:2004 6.2, 6.4."""

from dataclasses import dataclass

import numpy as np

from foldshell.checks.concrete.envelope import (
    Envelope,
    find_envelope,
    split_combinations,
    take_means,
)
from foldshell.checks.concrete.model import ConcreteModel
from foldshell.checks.concrete.panels import PanelSteel
from foldshell.checks.concrete.punching import PERIMETER, face_resistance, punching_resistance
from foldshell.checks.concrete.sampling import turn_components
from foldshell.checks.concrete.shear import (
    along_direction,
    principal_shear,
    ratio_along,
    resistance_of_struts,
    resistance_without_links,
)
from foldshell.checks.concrete.transverse_shear import shear_coefficients, turn_vectors
from foldshell.checks.concrete.vertex_shear import find_vertex_shear
from foldshell.shell.stress import StressResultants, evaluate

WORST = 99.0
"""Share that stands for a resistance of nothing, where the membrane pulls too hard."""


@dataclass(frozen=True)
class PanelShear:
    """Shear of P panels.

    `size` (P,) kN/m largest v_0; `use` (P,) its share of v_Rd,c, of v_Rd,max where links may lie;
    `envelope` its place; `links` (P,) bool; `punching_use` (P,) share at vertices,
    `vertex` (P,) where, `punching_combination` (P,) as a number.
    """

    size: np.ndarray
    use: np.ndarray
    envelope: Envelope
    links: np.ndarray
    punching_use: np.ndarray
    vertex: np.ndarray
    punching_combination: np.ndarray


def find_panel_shear(
    model: ConcreteModel, resultants: StressResultants, steel: PanelSteel
) -> PanelShear:
    """v_0 over v_Rd,c, of means with their sign over facets and strips; and across vertices.

    resultants (E, 3, m, c) kN/m and kNm/m.
    """
    sampling, strengths, asked = model.shear, model.layout.strengths, model.asked
    shear = shear_coefficients(model.operators, resultants.moment)
    parts = split_combinations(sampling, resultants, 5)
    means = np.concatenate([_mean_shear(model, part) for part in parts], axis=1)
    rows = np.flatnonzero(sampling.panel < model.panels)
    panel, means = sampling.panel[rows], means[rows]
    size, direction = principal_shear(means[..., :2])
    depth, ratio = effective_depth(steel, model)
    t = steel.thickness[panel][:, None]
    stress = along_direction(means[..., 2:], direction) / t
    at = depth[panel][:, None]
    plain = resistance_without_links(
        at, ratio_along(ratio[panel][:, None], direction), stress,
        strengths.fck, strengths.fcd, asked.gamma_c,
    )  # fmt: skip
    thick = t >= asked.links_from
    struts = resistance_of_struts(0.9 * at, stress, strengths.fck, strengths.fcd, asked.cot_theta)
    needs = thick & (size > plain)
    use = np.minimum(size / np.maximum(np.where(needs, struts, plain), size / WORST + 1e-12), WORST)
    links = np.zeros(model.panels, dtype=bool)
    links[panel[needs.any(axis=1)]] = True
    found = find_envelope(panel, np.stack([use, size], axis=-1), model.panels)
    punching = _find_punching(model, shear, resultants.force, depth, ratio, steel.thickness)
    return PanelShear(found.value[:, 1], found.value[:, 0], found, links, *punching)


def _mean_shear(model: ConcreteModel, resultants: StressResultants) -> np.ndarray:
    """Return the means (S, c, 5) kN/m of v_x, v_y and n in the axes of the bars."""
    sampling, points = model.shear, model.shear.points
    shear = shear_coefficients(model.operators, resultants.moment)
    force = evaluate(model.operators, turn_components(resultants.force, sampling.angle), points)
    at_points = turn_vectors(evaluate(model.operators, shear, points), sampling.angle)
    return take_means(sampling, np.concatenate([at_points, force], axis=-1))


def effective_depth(steel: PanelSteel, model: ConcreteModel) -> tuple[np.ndarray, np.ndarray]:
    """Return d (P,) m and rho (P, 2) of the layer with more steel in each direction.

    d is t minus the level of the layer, t / 2 for one mesh in the middle.
    """
    deep = steel.thickness - (model.layout.cover + model.layout.diameter)
    depth = np.where(steel.two_layers, deep, steel.thickness / 2)
    return depth, steel.area.max(axis=1) / depth[:, None]


def _find_punching(model: ConcreteModel, shear, force, depth, ratio, thickness):
    """Return the largest share (P,) at the vertices of each panel, vertex and combination (P,)."""
    strengths = model.layout.strengths
    element_depth = np.append(depth, depth.max())[np.minimum(model.mesh.panel, model.panels)]
    found = find_vertex_shear(model.operators, shear, force, PERIMETER * element_depth)
    rows = np.flatnonzero(found.panel < model.panels)
    panel = found.panel[rows]
    at, stress = depth[panel][:, None], found.force[rows] / thickness[panel][:, None]
    resistance = punching_resistance(
        at, ratio[panel][:, None], np.stack([stress, stress], axis=-1),
        strengths.fck, strengths.fcd, model.asked.gamma_c,
    )  # fmt: skip
    resistance = np.minimum(resistance, face_resistance(at, strengths.fck, strengths.fcd))
    own = found.shear[rows]
    use = np.minimum(own / np.maximum(resistance, own / WORST + 1e-12), WORST).max(axis=1)
    best = find_envelope(panel, use[:, None, None], model.panels)
    return best.value[:, 0], found.vertex[rows][best.row[:, 0]], best.combination[:, 0]
