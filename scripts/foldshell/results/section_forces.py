"""Membrane forces, moments and shear of panels as means, in axes that can be compared."""

import numpy as np

from foldshell.checks.strips import NO_EDGE, Strips, strip_means
from foldshell.results.combination_fields import basis_gradient
from foldshell.results.fields import facet_axes, rotate_forces
from foldshell.shell.reference import triangle_quadrature
from foldshell.shell.stiffness import ShellOperators
from foldshell.shell.stress import StressResultants

COMPONENTS = ("nx", "ny", "nxy", "mx", "my", "mxy", "vx", "vy")
UNITS = ("kN/m",) * 3 + ("kNm/m",) * 3 + ("kN/m",) * 2


def average_panels(
    operators: ShellOperators, strips: Strips, found: StressResultants
) -> np.ndarray:
    """Area means over panels of n, m and v = div M: (c, P, 8) kN/m, kNm/m, kN/m.

    x of a panel is global x projected on its facets.
    """
    rows = np.flatnonzero(strips.edge[:, 0] == NO_EDGE)
    frame, area, panel = strips.axes[rows], strips.area[rows], strips.panel[rows]
    axes = facet_axes(frame[:, 2])
    parts = [
        rotate_forces(strip_means(strips, one)[rows].transpose(0, 2, 1), frame, axes)
        for one in (found.force, found.moment)
    ]
    facet = operators.mesh.facet
    shear = _average_shear(operators, found.moment)
    turned = np.einsum("eax,ebx,ebc->eca", axes[facet][:, :2],
                       operators.geometry.frame[:, :2], shear)  # fmt: skip
    weight = operators.geometry.area
    sums = np.zeros((len(rows), *turned.shape[1:]))
    np.add.at(sums, facet, weight[:, None, None] * turned)
    parts.append(sums / np.bincount(facet, weight)[:, None, None])
    values = area[:, None, None] * np.concatenate(parts, axis=2)
    total = np.zeros((int(panel.max()) + 1, *values.shape[1:]))
    np.add.at(total, panel, values)
    return np.moveaxis(total / np.bincount(panel, area)[:, None, None], 1, 0)


def _average_shear(operators: ShellOperators, moment: np.ndarray) -> np.ndarray:
    """vx = mxx,x + mxy,y, vy = mxy,x + myy,y as means over elements: (E, 2, c) in their axes."""
    degree = operators.mesh.order - 1
    points, weights = triangle_quadrature(degree)
    slope = np.einsum("q,rqm->rm", weights, basis_gradient(degree, points))
    local = np.einsum("rm,era->eam", slope, operators.geometry.inverse)
    xx, yy, xy = np.einsum("eam,esmc->seac", local, moment, optimize=True)
    return np.stack([xx[:, 0] + xy[:, 1], xy[:, 0] + yy[:, 1]], axis=1)
